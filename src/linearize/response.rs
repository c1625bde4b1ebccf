//! How v' and lambda of a formulation answer to changes of the state and to inputs.

use super::variation::at_state;
use super::{Changes, Matrix, Variation};
use crate::error::Result;
use crate::system::OutputTangent;

/// dv' = `vdot` x + `driven_vdot` u and dlambda = `lambda` x + `driven_lambda` u, a column each for the changes of the
/// state that were asked for and for the inputs.
#[derive(Clone, Debug)]
pub struct Response {
    pub vdot: Matrix,
    pub lambda: Matrix,
    pub driven_vdot: Matrix,
    pub driven_lambda: Matrix,
}

impl Response {
    /// Of the equations themselves, phi'' = 0: a back-substitution for each column.
    pub fn exact(variation: &mut Variation, changes: &Changes) -> Result<Self> {
        Self::held(variation, changes, [0.0; 2])
    }

    /// Of phi'' + c1 phi' + c0 phi = 0.
    pub fn held(variation: &mut Variation, changes: &Changes, c: [f64; 2]) -> Result<Self> {
        let t = variation.point.t;
        let (mut vdot, mut lambda) = (variation.force(changes), variation.rows(changes, c));
        variation.push_all(&mut vdot, &mut lambda).map_err(|halt| at_state(t, &halt))?;
        let mut driven_vdot = variation.inputs();
        let mut driven_lambda = Matrix::zeros(lambda.nrows(), driven_vdot.ncols());
        variation.push_all(&mut driven_vdot, &mut driven_lambda).map_err(|halt| at_state(t, &halt))?;
        Ok(Response { vdot, lambda, driven_vdot, driven_lambda })
    }
}

/// C and D of what answers to changes of the state.
pub(super) fn observe(outputs: &OutputTangent, changes: &Changes, response: &Response) -> [Matrix; 2] {
    let OutputTangent { q, v, vdot, lambda, u } = outputs;
    let c = q * &changes.q + v * &changes.v + vdot * &response.vdot + lambda * &response.lambda;
    [c, u + vdot * &response.driven_vdot + lambda * &response.driven_lambda]
}
