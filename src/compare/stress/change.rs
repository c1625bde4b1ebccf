//! What sets a cell apart from the scene as it is.

use super::parameters::{StressParameter, baumgarte};
use super::subject::Case;
use crate::error::Result;
use crate::integrator::{Steps, find};
use crate::method_spec::MethodSpec;

/// One thing that a place in a map changes.
#[derive(Clone)]
pub enum Change {
    StressParameter(&'static StressParameter, f64),
    /// A parameter of the scene.
    Parameter(String, f64),
    Integrator(MethodSpec),
    /// Formulation and projection.
    Stabilization(MethodSpec, MethodSpec),
    /// Baumgarte's pair (2/h, 1/h^2), which follows the step.
    OwnGains,
}

impl Change {
    /// Makes the change.
    ///
    /// # Errors
    /// A scene that has nothing of the kind to change.
    pub fn apply(&self, case: &mut Case) -> Result<()> {
        let typical_step = case.typical.step;
        let method = &mut case.method;
        match self {
            Change::StressParameter(parameter, value) => return (parameter.apply)(case, *value),
            Change::Parameter(name, value) => case.set.push((name.clone(), *value)),
            Change::Integrator(integrator) => {
                let is_fixed = find(integrator)?.steps == Steps::Fixed;
                method.step = if is_fixed { method.step.or(Some(typical_step)) } else { None };
                method.integrator = integrator.clone();
            }
            Change::Stabilization(formulation, projection) => {
                (method.formulation, method.projection) = (formulation.clone(), projection.clone());
            }
            Change::OwnGains => {
                (method.formulation, method.projection) =
                    (baumgarte(1.0 / method.step.unwrap_or(typical_step)), MethodSpec::named("none"));
            }
        }
        Ok(())
    }

    /// Whether the motion that is to be computed stays the same.
    pub fn keeps_motion(&self) -> bool {
        match self {
            Change::StressParameter(parameter, _) => parameter.keeps_motion,
            Change::Parameter(..) => false,
            _ => true,
        }
    }
}
