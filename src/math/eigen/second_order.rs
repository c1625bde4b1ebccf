//! Eigenvalues of x'' + K x = 0 with a symmetric K.

use super::{Complex, ComplexMatrix, Eigen, Matrix, Unsolved, conjugates, dense};
use crate::tolerances;
use faer::{Par, Side};

/// Rows of A from which on the second-order form is used. Unit: `[rows]`. Why: smaller ones take less than a
/// millisecond, and keep the digits of slow modes among fast ones. Test: `an_undamped_chain_by_its_stiffness`.
const SECOND_ORDER_ROWS: usize = 100;

/// Returns the eigenvalues of A = [0 I; -K 0] by those of K = V diag(s) V^T, a tenth of the work of A and without
/// rounding in the real parts; `None` for any other matrix, and for a small one, where the algorithm for A is as fast.
///
/// ```text
/// lambda = +-sqrt(-s),   x = (v, lambda v),   y = (lambda v, v) / 2 lambda conjugate
/// ```
///
/// # Errors
/// No convergence.
pub fn second_order(a: &Matrix) -> Result<Option<Eigen>, Unsolved> {
    let n = a.nrows();
    let k = n / 2;
    if n < SECOND_ORDER_ROWS || n % 2 == 1 || !is_undamped(a, k) {
        return Ok(None);
    }
    faer::set_global_parallelism(Par::Seq);
    // Only the lower triangle is read: the mean of both.
    let stiffness = Matrix::from_fn(k, k, |i, j| -0.5 * (a[(k + i, j)] + a[(k + j, i)]));
    let failed = Unsolved::NotConverged { converged: 0, wanted: n };
    let found = dense::view(&stiffness).self_adjoint_eigen(Side::Lower).map_err(|_| failed)?;
    let squares = found.S().column_vector();
    let largest = (0..k).map(|i| squares[i].abs()).fold(0.0, f64::max);
    let mut modes: Vec<(Complex<f64>, usize)> = (0..k).flat_map(|i| roots(squares[i]).map(|root| (root, i))).collect();
    modes.sort_by(|a, b| conjugates::compare(&a.0, &b.0));
    let shape = |i: usize, column: usize| found.U()[(i % k, column)];
    let upper = |i: usize| i < k;
    let right = ComplexMatrix::from_fn(n, n, |i, j| {
        let (value, column) = modes[j];
        let length = (1.0 + value.norm_sqr()).sqrt();
        let factor = if upper(i) { Complex::from(1.0) } else { value };
        factor * (shape(i, column) / length)
    });
    let left = ComplexMatrix::from_fn(n, n, |i, j| {
        let (value, column) = modes[j];
        let length = (1.0 + value.norm_sqr()).sqrt();
        let factor = if upper(i) { Complex::from(0.5) } else { (value.conj() * 2.0).inv() };
        if is_zero(value, largest) { Complex::ZERO } else { factor * (shape(i, column) * length) }
    });
    let rate = largest.sqrt();
    let condition = |value: &Complex<f64>| {
        if is_zero(*value, largest) {
            f64::INFINITY
        } else {
            (largest + value.norm_sqr()) / (2.0 * rate * value.norm())
        }
    };
    let error = |value: &Complex<f64>| {
        let change = tolerances::QR_BACKWARD_ERROR * largest;
        (change / (2.0 * value.norm())).min(change.sqrt())
    };
    let values: Vec<Complex<f64>> = modes.into_iter().map(|(value, _)| value).collect();
    Ok(Some(Eigen {
        conditioning: conditioning(&values, largest),
        errors: values.iter().map(error).collect(),
        conditions: values.iter().map(condition).collect(),
        values,
        right,
        left,
    }))
}

/// True for [0 I; -K 0] with a K that is symmetric to rounding.
fn is_undamped(a: &Matrix, k: usize) -> bool {
    let is_plain = (0..k).all(|j| {
        (0..k).all(|i| a[(i, j)] == 0.0 && a[(k + i, k + j)] == 0.0 && a[(i, k + j)] == f64::from(u8::from(i == j)))
    });
    let stiffness = a.view((k, 0), (k, k));
    let slack = tolerances::ROUND_OFF_OF_SOLUTIONS * stiffness.amax();
    is_plain && (0..k).all(|j| (0..j).all(|i| (stiffness[(i, j)] - stiffness[(j, i)]).abs() <= slack))
}

/// lambda^2 = -s, the one with im < 0 or re < 0 first.
fn roots(square: f64) -> [Complex<f64>; 2] {
    let root = square.abs().sqrt();
    let at = |root: f64| if square > 0.0 { Complex::new(0.0, root) } else { Complex::new(root, 0.0) };
    [at(-root), at(root)]
}

/// A double zero has one vector, to rounding.
fn is_zero(value: Complex<f64>, largest: f64) -> bool {
    value.norm_sqr() <= f64::EPSILON * largest * tolerances::HALF_OF_THE_DIGITS
}

/// Condition number of the vectors. Those of one s are orthogonal to those of any other; two of one s have the singular
/// values sqrt(2 / (1 + |s|)) and sqrt(2 |s| / (1 + |s|)).
fn conditioning(values: &[Complex<f64>], largest: f64) -> f64 {
    let squares = values.iter().map(|value| value.norm_sqr());
    let sizes = squares.flat_map(|s| [2.0 / (1.0 + s), 2.0 * s / (1.0 + s)]);
    let (least, most) = crate::math::bounds(sizes);
    if values.iter().any(|value| is_zero(*value, largest)) { f64::INFINITY } else { (most / least).sqrt() }
}
