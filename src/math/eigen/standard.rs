//! The eigenvalue problem A x = lambda x.

use super::conjugates::{self, Unit};
use super::inverse::{self, ComplexVector, residual};
use super::second_order::second_order;
use super::{Complex, ComplexMatrix, Eigen, Matrix, Unsolved, dense};
use crate::tolerances;
use faer::diag::Diag;
use faer::dyn_stack::{MemBuffer, MemStack};
use faer::linalg::evd::{ComputeEigenvectors, evd_real, evd_scratch};
use faer::prelude::Solve;
use faer::{Mat, Par};
use nalgebra::linalg::balancing::balance_parlett_reinsch;
use std::f64::consts::SQRT_2;

/// All eigenvalues with left and right vectors: balancing (Parlett and Reinsch, by powers of two), then the QR
/// algorithm. About 30 n^3 operations.
///
/// # Errors
/// A matrix that is not square or not finite; no convergence.
pub fn eigen(a: &Matrix) -> Result<Eigen, Unsolved> {
    let n = dense::square(&[a])?;
    if let Some(found) = second_order(a)? {
        return Ok(found);
    }
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
    let basis = real_basis(&units, &right);
    let conditioning = dense::condition(&basis)?;
    let left = biorthogonal(&units, &right, &basis, left, conditioning);
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
    let mut right = Mat::zeros(n, n);
    let mut left = Mat::zeros(n, n);
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

/// Right and left vectors of each unit. faer does not report failure to converge, and its back substitution loses the
/// vectors of defective eigenvalues.
fn vectors(
    a: &Matrix,
    units: &[Unit],
    right: &Mat<f64>,
    left: &Mat<f64>,
) -> Result<Vec<(ComplexVector, ComplexVector)>, Unsolved> {
    let mut converged = 0;
    let mut found = Vec::new();
    let all: Vec<ComplexVector> = units.iter().map(|unit| unit.vector(right.as_ref())).collect();
    let before = residuals(a, units, &all, false);
    for ((unit, mut x), mut off) in units.iter().zip(all).zip(before) {
        let mut y = unit.vector(left.as_ref());
        if !(off <= tolerances::ROUND_OFF_OF_FACTORS && y.iter().all(|y| y.is_finite())) {
            let complex = dense::complex(a);
            (x, y) = inverse::vectors(&complex, unit.value, unit.column as u64, tolerances::ROUND_OFF_OF_FACTORS)?;
            off = residual(&complex, unit.value, &x);
        }
        converged += if off <= tolerances::ROOT_OF_ROUND_OFF { 1 + usize::from(unit.is_pair()) } else { 0 };
        found.push((x, y));
    }
    let wanted = a.nrows();
    if converged == wanted { Ok(found) } else { Err(Unsolved::NotConverged { converged, wanted }) }
}

/// See [`Eigen::conditions`].
fn conditions(units: &[Unit], vectors: &[(ComplexVector, ComplexVector)]) -> Vec<f64> {
    let mut conditions = Vec::new();
    for (unit, (x, y)) in units.iter().zip(vectors) {
        let product: Complex<f64> = x.iter().zip(y).map(|(x, y)| y.conj() * x).sum();
        let norm = |x: &ComplexVector| x.iter().map(|x| x.norm_sqr()).sum::<f64>().sqrt();
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

/// |A x - lambda x| / (|A| |x|) of each unit, or that of the adjoint and of left vectors, by one product of real matrices.
fn residuals(a: &Matrix, units: &[Unit], vectors: &[ComplexVector], is_adjoint: bool) -> Vec<f64> {
    let n = a.nrows();
    let part = |i: usize, j: usize| if j.is_multiple_of(2) { vectors[j / 2][i].re } else { vectors[j / 2][i].im };
    let parts = Matrix::from_fn(n, 2 * vectors.len(), part);
    let matrix = if is_adjoint { dense::view(a).transpose() } else { dense::view(a) };
    let product = dense::product(matrix, dense::view(&parts));
    let size = a.norm();
    let of = |(j, (unit, x)): (usize, (&Unit, &ComplexVector))| {
        let value = if is_adjoint { unit.value.conj() } else { unit.value };
        let rows = product.column(2 * j).into_iter().zip(product.column(2 * j + 1)).zip(x);
        let off = rows.map(|((re, im), x)| (Complex::new(*re, *im) - x * value).norm_sqr()).sum::<f64>().sqrt();
        let length = x.iter().map(|x| x.norm_sqr()).sum::<f64>().sqrt();
        if off == 0.0 { 0.0 } else { off / (size * length) }
    };
    units.iter().zip(vectors).enumerate().map(of).collect()
}

/// Recomputes poor vectors in the unbalanced matrix: round-off in place of zeros, such as 1e-30, makes balancing choose
/// scales that magnify the round-off in a vector.
fn mend(a: &Matrix, units: &[Unit], right: &mut [ComplexVector], left: &mut [ComplexVector]) -> Result<(), Unsolved> {
    let of_right = residuals(a, units, right, false);
    let of_left = residuals(a, units, left, true);
    for (j, unit) in units.iter().enumerate() {
        let before = of_right[j].max(of_left[j]);
        // A thousand times the round-off of factors.
        if before > 1e-10 {
            let complex = dense::complex(a);
            let (x, y) = inverse::vectors(&complex, unit.value, unit.column as u64, tolerances::ROUND_OFF_OF_FACTORS)?;
            let of_adjoint = residual(&complex.adjoint(), unit.value.conj(), &y);
            if residual(&complex, unit.value, &x).max(of_adjoint) < before {
                (right[j], left[j]) = (x, y);
            }
        }
    }
    Ok(())
}

/// A real W with X = W U and a unitary U: the vector of a real eigenvalue, the real and the imaginary part of that of a
/// pair times the root of 2. Its singular values are those of X.
fn real_basis(units: &[Unit], right: &ComplexMatrix) -> Matrix {
    let mut basis = Matrix::zeros(right.nrows(), right.ncols());
    let mut column = 0;
    for unit in units {
        if unit.is_pair() {
            let x = right.column(column + 1) * Complex::from(SQRT_2);
            basis.column_mut(column).copy_from(&x.map(|x| x.re));
            basis.column_mut(column + 1).copy_from(&x.map(|x| x.im));
            column += 2;
        } else {
            basis.column_mut(column).copy_from(&right.column(column).map(|x| x.re));
            column += 1;
        }
    }
    basis
}

/// X^-H = W^-T U of X = W U.
fn biorthogonal(
    units: &[Unit],
    right: &ComplexMatrix,
    basis: &Matrix,
    mut left: ComplexMatrix,
    conditioning: f64,
) -> ComplexMatrix {
    if conditioning < 1.0 / tolerances::ROOT_OF_ROUND_OFF {
        let n = basis.nrows();
        faer::set_global_parallelism(Par::Seq);
        let inverse = dense::view(basis).transpose().partial_piv_lu().solve(Mat::<f64>::identity(n, n));
        let mut column = 0;
        for unit in units {
            let part = |j: usize| inverse.col(j).iter();
            if unit.is_pair() {
                for (i, (re, im)) in part(column).zip(part(column + 1)).enumerate() {
                    let y = Complex::new(*re, *im) / SQRT_2;
                    (left[(i, column)], left[(i, column + 1)]) = (y.conj(), y);
                }
                column += 2;
            } else {
                part(column).enumerate().for_each(|(i, y)| left[(i, column)] = Complex::from(*y));
                column += 1;
            }
        }
        return left;
    }
    for (mut y, x) in left.column_iter_mut().zip(right.column_iter()) {
        let product = y.dotc(&x);
        let factor = if product.norm() > tolerances::HALF_OF_THE_DIGITS { product.conj().inv() } else { Complex::ZERO };
        y.iter_mut().for_each(|y| *y *= factor);
    }
    left
}
