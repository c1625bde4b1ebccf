//! Ritz values and vectors of a Krylov space.

use super::super::{ComplexMatrix, Unsolved, conjugates, dense};
use super::{Complex64, Scalar};
use nalgebra::DMatrix;

/// Eigenvalues and unit vectors of H, largest first.
pub struct Ritz {
    pub values: Vec<Complex64>,
    pub vectors: ComplexMatrix,
}

impl Ritz {
    pub fn of<T: Scalar>(h: &DMatrix<T>) -> Result<Ritz, Unsolved> {
        let m = h.nrows();
        faer::set_global_parallelism(faer::Par::Seq);
        let eigen = dense::view(h).eigen().map_err(|_| Unsolved::NotConverged { converged: 0, wanted: m })?;
        let all: Vec<Complex64> = eigen.S().column_vector().iter().copied().collect();
        let mut order: Vec<usize> = (0..m).collect();
        order.sort_by(|&i, &j| conjugates::compare(&all[j], &all[i]));
        let mut vectors = ComplexMatrix::from_fn(m, m, |i, j| eigen.U()[(i, order[j])]);
        dense::normalize(&mut vectors);
        Ok(Ritz { values: order.iter().map(|&j| all[j]).collect(), vectors })
    }

    /// Returns how many of the largest `count` have a residual |apply(x) - theta x| within the tolerance.
    pub fn converged(&self, count: usize, rest: f64, tolerance: f64) -> usize {
        let size = self.values.first().map_or(0.0, |theta| theta.norm());
        let last = self.vectors.row(self.values.len() - 1);
        last.iter().take(count).filter(|x| rest * x.norm() <= tolerance * size).count()
    }
}
