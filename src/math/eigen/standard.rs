//! The eigenvalue problem A x = lambda x.

use super::conjugates::{self, Unit};
use super::inverse::{self, residual};
use super::{Complex, ComplexMatrix, Matrix, Unsolved, dense};
use crate::tolerances::math as tolerances;
use faer::diag::Diag;
use faer::dyn_stack::{MemBuffer, MemStack};
use faer::linalg::evd::{ComputeEigenvectors, evd_real, evd_scratch};
use faer::{Mat, Par};
use nalgebra::linalg::balancing::balance_parlett_reinsch;

/// Eigenvalues and eigenvectors of a real matrix, see [`eigen`].
#[derive(Clone, Debug, PartialEq)]
pub struct Eigen {
    /// Eigenvalues by magnitude, then real, then imaginary part; exact conjugates are neighbours.
    pub values: Vec<Complex<f64>>,
    /// Right vectors, A x = lambda x, in columns of norm 1.
    pub right: ComplexMatrix,
    /// Left vectors, y^H A = lambda y^H, in columns with y^H x = 1; zero if x is orthogonal to y to rounding
    /// (a defective eigenvalue).
    pub left: ComplexMatrix,
    /// Condition number of `right`; infinite if it is singular to rounding.
    pub conditioning: f64,
    /// |change| of each value, to first order, by the backward error of the QR algorithm: eps ||A|| / |y^H x| with x and
    /// y of norm 1, in the balanced matrix (Wilkinson, The Algebraic Eigenvalue Problem, section 2.9). A double zero
    /// with one vector is moved to +-s with |y^H x| of the size of s, so that s is of the size of its own error. At such a
    /// value y^H x may vanish: the change of a double one is at most the root of eps times ||A||.
    pub errors: Vec<f64>,
    /// 1 / |y^H x| of each value, with x and y of norm 1 in the balanced matrix.
    pub conditions: Vec<f64>,
}

/// All eigenvalues with left and right vectors: balancing (Parlett and Reinsch, by powers of two), then the QR
/// algorithm. About 30 n^3 operations.
///
/// # Errors
/// A matrix that is not square or not finite; no convergence.
pub fn eigen(a: &Matrix) -> Result<Eigen, Unsolved> {
    let n = dense::square(&[a])?;
    let (balanced, scale, size) = balance(a);
    let (mut units, right, left) = decompose(&balanced)?;
    units.sort_by(|a, b| conjugates::compare(&a.value, &b.value));
    let vectors = vectors(&balanced, &units, &right, &left)?;
    let conditions = conditions(&units, &vectors);
    let errors = errors(&conditions, size * balanced.norm());
    let (mut x, mut y): (Vec<_>, Vec<_>) = vectors.into_iter().unzip();
    x.iter_mut().flatten().zip(scale.iter().cycle()).for_each(|(x, d)| *x *= *d);
    y.iter_mut().flatten().zip(scale.iter().cycle()).for_each(|(y, d)| *y /= *d);
    mend(&(a / size), &units, &mut x, &mut y)?;
    let mut right = conjugates::matrix(&units, &x, n);
    let mut left = conjugates::matrix(&units, &y, n);
    dense::normalize(&mut right);
    dense::normalize(&mut left);
    let conditioning = dense::condition(&right)?;
    let left = biorthogonal(&right, left, conditioning);
    units.iter_mut().for_each(|unit| unit.value *= size);
    let values = conjugates::values(&units);
    if values.iter().all(|value| value.is_finite()) {
        Ok(Eigen { values, right, left, conditioning, errors, conditions })
    } else {
        Err(Unsolved::Overflow)
    }
}

/// D^-1 A D / size, the diagonal of D, and a power of two `size` that makes the result about 1, as thresholds of the
/// QR algorithm assume.
fn balance(a: &Matrix) -> (Matrix, Vec<f64>, f64) {
    let before = magnitude(a);
    let mut balanced = a / before;
    let scale = balance_parlett_reinsch(&mut balanced);
    let after = magnitude(&balanced);
    (balanced / after, scale.iter().copied().collect(), before * after)
}

/// A power of two near the largest entry.
fn magnitude(a: &Matrix) -> f64 {
    let largest = a.amax();
    if largest > 0.0 { dense::power_of_two(largest.clamp(f64::MIN_POSITIVE, 1e300)) } else { 1.0 }
}

type Decomposed = (Vec<Unit>, Mat<f64>, Mat<f64>);

/// Returns eigenvalues, and right and left vectors in the columns of real matrices.
fn decompose(a: &Matrix) -> Result<Decomposed, Unsolved> {
    let n = a.nrows();
    let mut re = Diag::<f64>::zeros(n);
    let mut im = Diag::<f64>::zeros(n);
    let mut right = dense::zeros(n);
    let mut left = dense::zeros(n);
    let options = Default::default();
    let yes = ComputeEigenvectors::Yes;
    let mut memory = MemBuffer::new(evd_scratch::<f64>(n, yes, yes, Par::Seq, options));
    evd_real(
        dense::view(a),
        re.as_mut(),
        im.as_mut(),
        Some(left.as_mut()),
        Some(right.as_mut()),
        Par::Seq,
        MemStack::new(&mut memory),
        options,
    )
    .map_err(|_| Unsolved::NotConverged { converged: 0, wanted: n })?;
    Ok((conjugates::units(|j| re[j], |j| im[j], n), right, left))
}

type Vector = Vec<Complex<f64>>;

/// Right and left vectors of each unit. faer does not report failure to converge, and its back substitution loses the
/// vectors of defective eigenvalues.
fn vectors(a: &Matrix, units: &[Unit], right: &Mat<f64>, left: &Mat<f64>) -> Result<Vec<(Vector, Vector)>, Unsolved> {
    let complex = dense::complex(a);
    let mut converged = 0;
    let mut found = Vec::new();
    for unit in units {
        let mut x = unit.vector(right.as_ref());
        let mut y = unit.vector(left.as_ref());
        if !(residual(&complex, unit.value, &x) <= tolerances::ROUND_OFF_OF_FACTORS && y.iter().all(|y| y.is_finite()))
        {
            (x, y) = inverse::vectors(&complex, unit.value, unit.column as u64, tolerances::ROUND_OFF_OF_FACTORS)?;
        }
        converged += if residual(&complex, unit.value, &x) <= tolerances::EIGENVALUE_FAILED {
            1 + usize::from(unit.is_pair())
        } else {
            0
        };
        found.push((x, y));
    }
    let wanted = a.nrows();
    if converged == wanted { Ok(found) } else { Err(Unsolved::NotConverged { converged, wanted }) }
}

/// See [`Eigen::conditions`].
fn conditions(units: &[Unit], vectors: &[(Vector, Vector)]) -> Vec<f64> {
    let mut conditions = Vec::new();
    for (unit, (x, y)) in units.iter().zip(vectors) {
        let product: Complex<f64> = x.iter().zip(y).map(|(x, y)| y.conj() * x).sum();
        let norm = |x: &Vector| x.iter().map(|x| x.norm_sqr()).sum::<f64>().sqrt();
        let condition = norm(x) * norm(y) / product.norm();
        conditions.extend(std::iter::repeat_n(condition, 1 + usize::from(unit.is_pair())));
    }
    conditions
}

/// See [`Eigen::errors`]; `size` is ||A||.
fn errors(conditions: &[f64], size: f64) -> Vec<f64> {
    let most = tolerances::QR_BACKWARD_ERROR.sqrt() * size;
    conditions.iter().map(|condition| (tolerances::QR_BACKWARD_ERROR * size * condition).min(most)).collect()
}

/// Recomputes poor vectors in the unbalanced matrix: round-off in place of zeros, such as 1e-30, makes balancing choose
/// scales that magnify the round-off in a vector.
fn mend(a: &Matrix, units: &[Unit], right: &mut [Vector], left: &mut [Vector]) -> Result<(), Unsolved> {
    let complex = dense::complex(a);
    let of_adjoint = complex.adjoint();
    for ((unit, x), y) in units.iter().zip(right).zip(left) {
        let poor =
            |x: &Vector, y: &Vector| residual(&complex, unit.value, x).max(residual(&of_adjoint, unit.value.conj(), y));
        let before = poor(x, y);
        if before > tolerances::EIGENVECTOR_REPEATED {
            let found = inverse::vectors(&complex, unit.value, unit.column as u64, tolerances::ROUND_OFF_OF_FACTORS)?;
            if poor(&found.0, &found.1) < before {
                (*x, *y) = found;
            }
        }
    }
    Ok(())
}

fn biorthogonal(right: &ComplexMatrix, mut left: ComplexMatrix, conditioning: f64) -> ComplexMatrix {
    if conditioning < tolerances::WELL_CONDITIONED_VECTORS
        && let Some(inverse) = right.clone().try_inverse()
    {
        return inverse.adjoint();
    }
    for (mut y, x) in left.column_iter_mut().zip(right.column_iter()) {
        let product = y.dotc(&x);
        let factor = if product.norm() > tolerances::DEFECTIVE { product.conj().inv() } else { Complex::ZERO };
        y.iter_mut().for_each(|y| *y *= factor);
    }
    left
}
