//! Ritz values and vectors of a Krylov space.

use super::super::{ComplexMatrix, Unsolved, conjugates, dense};
use super::C;

/// Eigenvalues of H, largest first.
pub struct Ritz {
    pub values: Vec<C>,
    pub vectors: ComplexMatrix,
    /// Residuals |apply(x) - theta x|.
    residuals: Vec<f64>,
}

impl Ritz {
    pub fn of(h: &ComplexMatrix, rest: f64, count: usize) -> Result<Ritz, Unsolved> {
        let m = h.nrows();
        faer::set_global_parallelism(faer::Par::Seq);
        let eigen = dense::view(h).eigen().map_err(|_| Unsolved::NotConverged { converged: 0, wanted: count })?;
        let all: Vec<C> = eigen.S().column_vector().iter().copied().collect();
        let mut order: Vec<usize> = (0..m).collect();
        order.sort_by(|&i, &j| conjugates::compare(&all[j], &all[i]));
        order.truncate(count);
        let mut vectors = ComplexMatrix::from_fn(m, count, |i, j| eigen.U()[(i, order[j])]);
        dense::normalize(&mut vectors);
        let residuals = (0..count).map(|j| rest * vectors[(m - 1, j)].norm()).collect();
        Ok(Ritz { values: order.iter().map(|&j| all[j]).collect(), vectors, residuals })
    }

    pub fn converged(&self, tolerance: f64) -> usize {
        let size = self.values.first().map_or(0.0, |theta| theta.norm());
        self.residuals.iter().filter(|residual| **residual <= tolerance * size).count()
    }
}
