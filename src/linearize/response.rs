//! How v' and lambda of a formulation answer to changes of the state and to inputs.

use super::variation::at_state;
use super::{Matrix, Variation};
use crate::error::Result;

/// dv' = `vdot` x + `driven_vdot` u and dlambda = `lambda` x + `driven_lambda` u, a column each for the changes of the
/// state that were asked for and for the inputs.
#[derive(Clone, Debug)]
pub struct Response {
    pub vdot: Matrix,
    pub lambda: Matrix,
    pub driven_vdot: Matrix,
    pub driven_lambda: Matrix,
}

/// Changes of the state, a column each.
#[derive(Clone, Debug)]
pub struct Changes {
    /// Along the velocity directions.
    pub q: Matrix,
    pub v: Matrix,
}

impl Changes {
    /// Of no column.
    pub fn none(n: usize) -> Self {
        Changes { q: Matrix::zeros(n, 0), v: Matrix::zeros(n, 0) }
    }

    /// Each direction of q, then each of v.
    pub fn all(n: usize) -> Self {
        let (unit, none) = (Matrix::identity(n, n), Matrix::zeros(n, n));
        Changes { q: beside([&unit, &none]), v: beside([&none, &unit]) }
    }
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

/// [left right]
pub(super) fn beside([left, right]: [&Matrix; 2]) -> Matrix {
    let mut both = left.clone().resize_horizontally(left.ncols() + right.ncols(), 0.0);
    both.columns_mut(left.ncols(), right.ncols()).copy_from(right);
    both
}
