//! Response of v' and lambda of a formulation to changes of the state and to inputs.

use super::variation::at_state;
use super::{Changes, Matrix, Variation};
use crate::error::Result;
use crate::system::OutputTangent;

/// dv' = `vdot` x + `driven_vdot` u and dlambda = `lambda` x + `driven_lambda` u, one column for each requested change
/// of the state and for each input.
#[derive(Clone, Debug)]
pub struct Response {
    /// dv' of each change, n_v rows.
    pub vdot: Matrix,
    /// dlambda of each change, n_c rows.
    pub lambda: Matrix,
    /// dv' of each input, n_v x n_u.
    pub driven_vdot: Matrix,
    /// dlambda of each input, n_c x n_u.
    pub driven_lambda: Matrix,
}

impl Response {
    /// Response of the equations with phi'' = 0: one back-substitution per column.
    pub fn exact(variation: &mut Variation, changes: &Changes) -> Result<Self> {
        Self::held(variation, changes, [0.0; 2])
    }

    /// Response of the equations with phi'' + c1 phi' + c0 phi = 0, c = [c1, c0].
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

/// Returns C and D for a response to changes of the state.
pub(super) fn observe(outputs: &OutputTangent, changes: &Changes, response: &Response) -> [Matrix; 2] {
    let OutputTangent { q, v, vdot, lambda, u } = outputs;
    let c = q * &changes.q + v * &changes.v + vdot * &response.vdot + lambda * &response.lambda;
    [c, u + vdot * &response.driven_vdot + lambda * &response.driven_lambda]
}
