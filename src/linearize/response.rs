//! Response of v' and lambda of a formulation to changes of the state and of the inputs.

use super::perturbation::{ColumnBlocks, Perturbation};
use super::variation::at_state;
use super::{Matrix, Variation};
use crate::error::Result;
use crate::system::OutputTangent;
use crate::tolerances;

/// dv' and dlambda of a formulation, one column for each change of a perturbation.
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
        let mut vdot = perturbation.force(variation);
        let mut lambda = perturbation.rows(variation, c);
        variation.push_all(&mut vdot, &mut lambda).map_err(|halt| at_state(t, &halt))?;
        Ok(Response { vdot, lambda })
    }
}

/// Returns dy of each change. What is round-off of the products that add up to it is zero.
pub(super) fn observe(outputs: &OutputTangent, perturbation: &Perturbation, response: &Response) -> ColumnBlocks {
    let OutputTangent { q, v, vdot, lambda, u, udot } = outputs;
    let Perturbation { changes, u: [du, rate, _], .. } = perturbation;
    let products =
        [(q, &changes.q), (v, &changes.v), (vdot, &response.vdot), (lambda, &response.lambda), (u, du), (udot, rate)];
    let mut dy = Matrix::zeros(q.nrows(), changes.q.ncols());
    let mut sizes = dy.clone();
    for (rows, columns) in products {
        dy += rows * columns;
        let lengths: Vec<f64> = columns.column_iter().map(|column| column.norm()).collect();
        for (i, row) in rows.row_iter().enumerate() {
            let size = row.norm();
            sizes.row_mut(i).iter_mut().zip(&lengths).for_each(|(sum, length)| *sum += size * length);
        }
    }
    let clean = |value: f64, size: f64| if value.abs() < tolerances::ROUND_OFF_OF_FACTORS * size { 0.0 } else { value };
    perturbation.split(&dy.zip_map(&sizes, clean))
}
