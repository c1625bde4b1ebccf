//! The exponential of a matrix.

use super::{Matrix, Unsolved, dense};
use crate::tolerances::math as tolerances;

/// exp(A) by scaling and squaring of Pade approximants of order up to 13 (Al-Mohy and Higham, "A new scaling and
/// squaring algorithm for the matrix exponential", SIAM J. Matrix Anal. Appl. 31, 2009). About 20 n^3 operations, and
/// 2 n^3 for each doubling of |A| above 4.
///
/// # Errors
/// A matrix that is not square or not finite; overflow of exp(A).
pub fn expm(a: &Matrix) -> Result<Matrix, Unsolved> {
    let n = dense::square(&[a])?;
    if n == 0 {
        return Ok(a.clone());
    }
    let mut halvings = 0;
    let mut scaled = a.clone();
    while scaled.amax() > tolerances::EXPONENTIAL_OVERFLOW {
        scaled /= 2.0;
        halvings += 1;
    }
    let mut exponential = scaled.exp();
    for _ in 0..halvings {
        exponential = &exponential * &exponential;
    }
    if dense::is_finite(&exponential) { Ok(exponential) } else { Err(Unsolved::Overflow) }
}

/// (Phi, Gamma) of x(t + h) = Phi x(t) + Gamma u for x' = A x + B u with constant u:
/// Phi = exp(A h), Gamma = integral from 0 to h of exp(A s) ds B, the blocks of exp([A B; 0 0] h) (Van Loan, 1978), so
/// for singular A too. A is n x n, B n x k.
///
/// # Errors
/// As [`expm`].
pub fn expm_with_input(a: &Matrix, b: &Matrix, h: f64) -> Result<(Matrix, Matrix), Unsolved> {
    let (n, k) = (a.nrows(), b.ncols());
    if a.ncols() != n || b.nrows() != n {
        return Err(Unsolved::Shape);
    }
    let mut block = Matrix::zeros(n + k, n + k);
    block.view_mut((0, 0), (n, n)).copy_from(&(a * h));
    block.view_mut((0, n), (n, k)).copy_from(&(b * h));
    let exponential = expm(&block)?;
    Ok((exponential.view((0, 0), (n, n)).into_owned(), exponential.view((0, n), (n, k)).into_owned()))
}
