//! Eigenvectors of known eigenvalues, by inverse iteration.

use super::{Complex, ComplexMatrix, Unsolved, dense};
use faer::Par;
use faer::prelude::Solve;

/// Dense complex vector.
pub type ComplexVector = Vec<Complex<f64>>;

/// |A x - lambda x| / (|A| |x|); NaN if x has one.
pub fn residual(a: &ComplexMatrix, value: Complex<f64>, x: &[Complex<f64>]) -> f64 {
    let x = ComplexMatrix::from_column_slice(x.len(), 1, x);
    let residual = (a * &x - &x * value).norm();
    if residual == 0.0 { 0.0 } else { residual / (a.norm() * x.norm()) }
}

/// Right and left vectors by a step of inverse iteration, from different starts for different seeds, so that equal
/// eigenvalues get different vectors. If it overflows, along the long chains of defective eigenvalues, by the smallest
/// singular value.
pub fn vectors(
    a: &ComplexMatrix,
    value: Complex<f64>,
    seed: u64,
    accuracy: f64,
) -> Result<(ComplexVector, ComplexVector), Unsolved> {
    let n = a.nrows();
    faer::set_global_parallelism(Par::Seq);
    // Shifted from the eigenvalue by round-off, so that there is an inverse.
    let near = value + a.norm() * f64::EPSILON;
    let shifted = a - ComplexMatrix::from_diagonal_element(n, n, near);
    let start = ComplexMatrix::from_iterator(n, 1, dense::direction(n, seed).map(Complex::from));
    let lu = dense::view(&shifted).partial_piv_lu();
    let right = dense::copy(lu.solve(dense::view(&start)).as_ref());
    let left = dense::copy(lu.solve_adjoint(dense::view(&start)).as_ref());
    let of_adjoint = a.adjoint();
    let is_good = residual(a, value, right.as_slice()) <= accuracy
        && residual(&of_adjoint, value.conj(), left.as_slice()) <= accuracy;
    let (right, left) = if is_good { (right, left) } else { null_vectors(&shifted)? };
    Ok((right.as_slice().to_vec(), left.as_slice().to_vec()))
}

fn null_vectors(matrix: &ComplexMatrix) -> Result<(ComplexMatrix, ComplexMatrix), Unsolved> {
    let n = matrix.ncols();
    let svd = dense::view(matrix).svd().map_err(|_| Unsolved::NotConverged { converged: 0, wanted: n })?;
    Ok((dense::copy(svd.V().subcols(n - 1, 1)), dense::copy(svd.U().subcols(n - 1, 1))))
}
