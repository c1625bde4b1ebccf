//! Natural modes of small dense systems, and their symmetric matrices.

use faer::linalg::triangular_solve::{solve_lower_triangular_in_place, solve_upper_triangular_in_place};
use faer::{Mat, MatRef, Par, Side};

/// A symmetric sparse matrix: entries (i, j, value) with i >= j, each place once.
pub type Symmetric = Vec<(usize, usize, f64)>;

/// Natural modes: K phi = omega^2 M phi.
pub struct Modes {
    /// omega^2, ascending, 1/s^2.
    pub squares: Vec<f64>,
    /// Modes phi in columns, with phi^T M phi = 1.
    pub vectors: Mat<f64>,
}

impl Modes {
    /// Modes by the eigenvalues 1/omega^2 of L^-1 M L^-T with K = L L^T. The largest are the most accurate, which are
    /// those of the lowest modes; with M = L L^T these would have the round-off of the highest mode. `None` if K is not
    /// positive definite, or M not to rounding.
    pub fn of(stiffness: MatRef<f64>, mass: MatRef<f64>) -> Option<Modes> {
        let n = stiffness.nrows();
        faer::set_global_parallelism(Par::Seq);
        let factor = stiffness.llt(Side::Lower).ok()?;
        let l = factor.L();
        let mut inner = mass.to_owned();
        solve_lower_triangular_in_place(l, inner.as_mut(), Par::Seq);
        let mut inner = inner.transpose().to_owned();
        solve_lower_triangular_in_place(l, inner.as_mut(), Par::Seq);
        let eigen = inner.self_adjoint_eigen(Side::Lower).ok()?;
        let inverse: Vec<f64> = eigen.S().column_vector().iter().rev().copied().collect();
        if inverse.iter().any(|value| value.is_nan() || *value <= 0.0) {
            return None;
        }
        let mut vectors = Mat::from_fn(n, n, |i, j| eigen.U()[(i, n - 1 - j)] / inverse[j].sqrt());
        solve_upper_triangular_in_place(l.transpose(), vectors.as_mut(), Par::Seq);
        (0..n).for_each(|j| point_up(&mut vectors, j));
        Some(Modes { squares: inverse.iter().map(|value| value.recip()).collect(), vectors })
    }

    /// The lowest `count` modes.
    #[must_use]
    pub fn truncated(mut self, count: usize) -> Modes {
        self.squares.truncate(count);
        let kept = self.squares.len();
        self.vectors = self.vectors.subcols(0, kept).to_owned();
        self
    }
}

/// Makes the largest component of a mode positive, so that its sign does not depend on round-off.
fn point_up(vectors: &mut Mat<f64>, column: usize) {
    let mut largest: f64 = 0.0;
    for i in 0..vectors.nrows() {
        // The first of components that are equal to 1e-6.
        if vectors[(i, column)].abs() > largest.abs() * (1.0 + 1e-6) {
            largest = vectors[(i, column)];
        }
    }
    if largest < 0.0 {
        (0..vectors.nrows()).for_each(|i| vectors[(i, column)] *= -1.0);
    }
}

/// The symmetric matrix as a dense one, with both triangles.
pub fn dense(n: usize, matrix: &Symmetric) -> Mat<f64> {
    let mut dense = Mat::zeros(n, n);
    for &(i, j, value) in matrix {
        dense[(i, j)] = value;
        dense[(j, i)] = value;
    }
    dense
}

/// The nonzero entries of a symmetric dense matrix.
pub fn entries(matrix: MatRef<f64>) -> Symmetric {
    let lower = (0..matrix.nrows()).flat_map(|i| (0..=i).map(move |j| (i, j)));
    lower.map(|(i, j)| (i, j, (matrix[(i, j)] + matrix[(j, i)]) / 2.0)).filter(|entry| entry.2 != 0.0).collect()
}

/// The first row of a positive semidefinite matrix that depends on those before it: its pivot in Cholesky's
/// factorization is less than `tolerance` of its diagonal.
pub fn first_dependent(matrix: MatRef<f64>, tolerance: f64) -> Option<usize> {
    let n = matrix.nrows();
    let mut l = Mat::<f64>::zeros(n, n);
    for i in 0..n {
        for j in 0..i {
            let inner: f64 = (0..j).map(|k| l[(i, k)] * l[(j, k)]).sum();
            l[(i, j)] = (matrix[(i, j)] - inner) / l[(j, j)];
        }
        let pivot = matrix[(i, i)] - (0..i).map(|k| l[(i, k)] * l[(i, k)]).sum::<f64>();
        if pivot.is_nan() || pivot <= tolerance * matrix[(i, i)] {
            return Some(i);
        }
        l[(i, i)] = pivot.sqrt();
    }
    None
}
