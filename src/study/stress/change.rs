//! Differences of a cell from the scene as it is.

use super::parameters::{StressParameter, baumgarte};
use super::subject::Case;
use crate::error::Result;
use crate::integrator::{Steps, find};
use crate::method_spec::MethodSpec;

/// One change that a cell of a map makes.
#[derive(Clone)]
pub enum CellChange {
    /// A stress parameter and its value.
    StressParameter(&'static StressParameter, f64),
    /// A parameter of the scene.
    Parameter(String, f64),
    /// Another integrator.
    Integrator(MethodSpec),
    /// Formulation and projection.
    Stabilization(MethodSpec, MethodSpec),
    /// Baumgarte's pair (2/h, 1/h^2), which depends on the step h.
    OwnGains,
}

impl CellChange {
    /// Makes the change.
    ///
    /// # Errors
    /// The scene has nothing of the kind to change.
    pub fn apply(&self, case: &mut Case) -> Result<()> {
        let typical_step = case.typical.step;
        let method = &mut case.method;
        match self {
            CellChange::StressParameter(parameter, value) => return (parameter.apply)(case, *value),
            CellChange::Parameter(name, value) => case.set.push((name.clone(), *value)),
            CellChange::Integrator(integrator) => {
                let is_fixed = find(integrator)?.steps == Steps::Fixed;
                method.step = if is_fixed { method.step.or(Some(typical_step)) } else { None };
                method.integrator = integrator.clone();
            }
            CellChange::Stabilization(formulation, projection) => {
                (method.formulation, method.projection) = (formulation.clone(), projection.clone());
            }
            CellChange::OwnGains => {
                (method.formulation, method.projection) =
                    (baumgarte(1.0 / method.step.unwrap_or(typical_step)), MethodSpec::named("none"));
            }
        }
        Ok(())
    }

    /// True if the exact motion stays the same.
    pub fn keeps_motion(&self) -> bool {
        match self {
            CellChange::StressParameter(parameter, _) => parameter.keeps_motion,
            CellChange::Parameter(..) => false,
            _ => true,
        }
    }
}
