//! The exponential of a matrix.

use super::{Matrix, Unsolved, dense};

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
    // Its powers, which choose the order, would overflow.
    while scaled.amax() > 1e20 {
        scaled /= 2.0;
        halvings += 1;
    }
    let mut exponential = scaled.exp();
    for _ in 0..halvings {
        exponential = &exponential * &exponential;
    }
    if dense::is_finite(&exponential) { Ok(exponential) } else { Err(Unsolved::Overflow) }
}
