//! Another method of a run, by its names.

use super::Run;
use crate::error::Result;
use crate::integrator::{self, Steps};
use crate::simulate::{Choice, Method};

impl Run<'_> {
    /// Another formulation, integrator and projection, by their names: `"ggl + radau_iia"`. Own ones are those of the
    /// scene's [`Elements`](crate::parts::Elements). Tolerances stay, and the fixed step where the integrator needs one.
    pub fn method(mut self, names: &str) -> Self {
        match self.named_method(names) {
            Ok(method) => self.choice = Choice::One(Box::new(method)),
            Err(error) => self.refused = Some(error),
        }
        self.unless_begun("a method is given")
    }

    fn named_method(&self, names: &str) -> Result<Method> {
        let named = names.parse::<Method>()?.knowing(&self.own_methods);
        let is_fixed = integrator::find(&named.integrator).is_ok_and(|entry| entry.steps == Steps::Fixed);
        Ok(match &self.choice {
            Choice::One(known) => {
                Method { rtol: known.rtol, atol: known.atol, step: known.step.filter(|_| is_fixed), ..named }
            }
            &Choice::Automatic(rtol, atol) => Method { rtol, atol, ..named },
        })
    }
}
