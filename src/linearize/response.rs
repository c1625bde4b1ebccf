//! Response of v' and lambda of a formulation to changes of the state and of the inputs.

use super::perturbation::{Parts, Perturbation};
use super::variation::at_state;
use super::{Matrix, Variation};
use crate::error::Result;
use crate::system::OutputTangent;

/// dv' and dlambda of a formulation, one column for each change of a [`Perturbation`].
#[derive(Clone, Debug)]
pub struct Response {
    /// dv' of each change, n_v rows.
    pub vdot: Matrix,
    /// dlambda of each change, n_c rows.
    pub lambda: Matrix,
}

impl Response {
    /// Response of the equations with phi'' = 0: one back-substitution per column.
    pub fn exact(variation: &mut Variation, perturbation: &Perturbation) -> Result<Self> {
        Self::held(variation, perturbation, [0.0; 2])
    }

    /// Response of the equations with phi'' + c1 phi' + c0 phi = 0, c = [c1, c0].
    pub fn held(variation: &mut Variation, perturbation: &Perturbation, c: [f64; 2]) -> Result<Self> {
        let t = variation.point.t;
        let (mut vdot, mut lambda) = (perturbation.force(variation), perturbation.rows(variation, c));
        variation.push_all(&mut vdot, &mut lambda).map_err(|halt| at_state(t, &halt))?;
        Ok(Response { vdot, lambda })
    }
}

/// Returns dy of each change.
pub(super) fn observe(outputs: &OutputTangent, perturbation: &Perturbation, response: &Response) -> Parts {
    let OutputTangent { q, v, vdot, lambda, u, udot } = outputs;
    let Perturbation { changes, u: [du, rate, _], .. } = perturbation;
    let states = q * &changes.q + v * &changes.v + vdot * &response.vdot + lambda * &response.lambda;
    perturbation.split(&(states + u * du + udot * rate))
}
