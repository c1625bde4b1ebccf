//! Invariant spaces of the eigenvalues nearest to a shift.

use super::Quadratic;
use super::shifted::Shifted;
use crate::math::eigen::{Complex64, Matrix, Options, Partial, Scalar, Unsolved, nearest};
use crate::math::kkt::Singular;
use crate::tolerances;

/// The shift for the slowest modes, off the eigenvalues 0 of rigid bodies. Unit: `[1]` of the last of them.
const SHIFT_OF_SLOWEST: f64 = 0.02;

/// A real basis of an invariant space of the pencil in (p, s p).
pub struct Space {
    pub p: Matrix,
    pub u: Matrix,
}

/// The right and left spaces of the same eigenvalues, and the operator by which they were found.
pub struct Found<'a> {
    pub right: Space,
    pub left: Space,
    pub operator: Operator<'a>,
}

/// (A - sigma E)^-1 E of a real or a complex shift sigma.
pub enum Operator<'a> {
    Real(Shifted<'a, f64>),
    Complex(Shifted<'a, Complex64>),
}

impl Operator<'_> {
    /// Returns |op x - theta x| / |theta x| of x in the coordinates of the equations and theta = 1 / (value - sigma).
    pub fn residual(&mut self, value: Complex64, x: impl Iterator<Item = Complex64>) -> Result<f64, Unsolved> {
        let (sigma, scale) = match self {
            Operator::Real(operator) => (Complex64::from(operator.sigma), &operator.scale),
            Operator::Complex(operator) => (operator.sigma, &operator.scale),
        };
        let x: Vec<Complex64> = x.zip(scale).map(|(x, scale)| x * *scale).collect();
        let mut image = vec![Complex64::ZERO; x.len()];
        match self {
            Operator::Complex(operator) => operator.apply(&x, &mut image)?,
            Operator::Real(operator) => {
                let mut part = vec![0.0; x.len()];
                let mut of_part = vec![0.0; x.len()];
                for unit in [Complex64::ONE, Complex64::I] {
                    part.iter_mut().zip(&x).for_each(|(part, x)| *part = (unit.conj() * x).re);
                    operator.apply(&part, &mut of_part)?;
                    image.iter_mut().zip(&of_part).for_each(|(image, of_part)| *image += unit * *of_part);
                }
            }
        }
        let theta = (value - sigma).inv();
        let norm = |all: &mut dyn Iterator<Item = Complex64>| all.map(|x| x.norm_sqr()).sum::<f64>().sqrt();
        let off = norm(&mut image.iter().zip(&x).map(|(image, x)| image - theta * x));
        Ok(off / (theta.norm() * norm(&mut x.iter().copied())).max(f64::MIN_POSITIVE))
    }
}

/// Finds eigenvalues that include the `count` modes nearest to `shift` (im >= 0).
pub fn find<'a>(equations: [&'a Quadratic; 2], count: usize, shift: Complex64) -> Result<Found<'a>, Unsolved> {
    let each = if shift.im > 0.0 { 1 } else { 2 };
    let mut wanted = (each * count + count / 8 + 6).min(equations[0].finite);
    let (sigma, rate) = if shift.norm() > 0.0 {
        (shift + tolerances::UNSEEN * shift.norm(), shift.norm())
    } else {
        slowest(equations[0], &mut wanted)?
    };
    if sigma.im == 0.0 {
        let operator = beside(equations[0], sigma.re, rate)?;
        let ([right, left], operator) = spaces(equations[1], operator, count, wanted, shift, rate)?;
        return Ok(Found { right, left, operator: Operator::Real(operator) });
    }
    let operator = beside(equations[0], sigma, rate)?;
    let ([right, left], operator) = spaces(equations[1], operator, count, wanted, shift, rate)?;
    Ok(Found { right, left, operator: Operator::Complex(operator) })
}

/// Returns the right and the left space of `count` modes; `wanted` eigenvalues are tried first.
fn spaces<'a, T: Scalar + Into<Complex64>>(
    adjoint: &Quadratic,
    mut operator: Shifted<'a, T>,
    count: usize,
    mut wanted: usize,
    shift: Complex64,
    rate: f64,
) -> Result<([Space; 2], Shifted<'a, T>), Unsolved> {
    let total = adjoint.finite;
    let sigma = operator.sigma;
    let (right, cut) = loop {
        let partial = run(&mut operator, wanted, false)?;
        let cut = cut(&partial, wanted == total);
        match cut.filter(|cut| *cut >= total || modes(&partial, *cut, sigma.into(), shift) >= count) {
            Some(cut) => break (partial, cut),
            None => wanted = (2 * wanted).min(total),
        }
    };
    let left = run(&mut Shifted::new(adjoint, sigma, rate)?, wanted, false)?;
    let right = real(&right, cut, &operator.scale);
    let left = real(&left, cut, &operator.scale);
    Ok(([right, left], operator))
}

/// Runs Krylov-Schur to rounding, with multiple eigenvalues; or roughly (`is_first`).
fn run<T: Scalar>(operator: &mut Shifted<T>, count: usize, is_first: bool) -> Result<Partial<T>, Unsolved> {
    let (tolerance, restarts) = if is_first { (1e-2, 5) } else { (1e-12, 300) };
    let subspace = Some(count + count / 3 + 16);
    let options = Options { subspace, tolerance, restarts, filter: 2, repeats: !is_first };
    let n = operator.scale.len();
    nearest(n, count, |x, y| operator.apply(x, y), options)
}

/// Returns the operator at sigma, or a little further off where sigma is an eigenvalue.
fn beside<T: Scalar>(equations: &Quadratic, mut sigma: T, rate: f64) -> Result<Shifted<'_, T>, Unsolved> {
    for _ in 0..8 {
        match Shifted::new(equations, sigma, rate) {
            Err(Unsolved::Operator(Singular::Collapsed)) => sigma += T::from_real(2.0 * sigma.real()),
            other => return other,
        }
    }
    Err(Unsolved::Operator(Singular::Collapsed))
}

/// A shift a little above zero and the rate of the last of the `count` slowest eigenvalues, from a search that starts
/// far below the fastest. `count` grows until they are not all zero.
fn slowest(equations: &Quadratic, count: &mut usize) -> Result<(Complex64, f64), Unsolved> {
    let fastest = equations.fastest();
    let mut sigma = 1e-5 * fastest;
    for _ in 0..10 {
        let mut operator = beside(equations, sigma, 100.0 * sigma)?;
        let used = operator.sigma;
        let partial = match run(&mut operator, *count, true) {
            Err(Unsolved::NotConverged { .. }) => {
                sigma = 0.03 * used;
                continue;
            }
            other => other?,
        };
        let rates = partial.values.iter().map(|theta| (used + theta.inv()).norm());
        let last = rates.fold(0.0, f64::max);
        if last < tolerances::HALF_OF_THE_DIGITS * fastest && *count < equations.finite {
            *count = (2 * *count).min(equations.finite);
            continue;
        }
        let next = (SHIFT_OF_SLOWEST * last).max(tolerances::HALF_OF_THE_DIGITS * fastest);
        if used <= last && used >= 1e-4 * last || next >= used && sigma < used {
            return Ok((Complex64::from(next), last.max(next)));
        }
        sigma = next;
    }
    Ok((Complex64::from(sigma), sigma / SHIFT_OF_SLOWEST))
}

/// Returns the number of values to keep: up to the widest gap among the last ones, so that no pair is parted and both
/// sides keep the same. None without a gap.
fn cut<T: Scalar>(partial: &Partial<T>, is_all: bool) -> Option<usize> {
    let count = partial.values.len();
    if is_all {
        return Some(count);
    }
    let size = |k: usize| partial.values[k].norm();
    let gap = |k: usize| size(k - 1) / size(k);
    let last = (count.saturating_sub(5).max(1)..count).max_by(|&a, &b| gap(a).total_cmp(&gap(b)))?;
    (gap(last) > 1.0 + tolerances::EIGENVALUES_AGREE).then_some(last)
}

/// Returns the number of modes that are certainly nearest to `shift` when all within the radius of the first `cut`
/// values about sigma are known. A pair is one; so are two real eigenvalues, which may be a double zero.
fn modes<T: Scalar>(partial: &Partial<T>, cut: usize, sigma: Complex64, shift: Complex64) -> usize {
    let radius = (1.0 + tolerances::EIGENVALUES_AGREE) / partial.values[cut - 1].norm() - (sigma - shift).norm();
    let values = partial.values.iter().take(cut).map(|theta| (sigma + theta.inv(), theta.norm().recip()));
    let inside = values.filter(|(value, _)| (value - shift).norm() <= radius);
    let halves = inside.map(|(value, far)| match value.im {
        // Real double eigenvalues split by the root of the residual.
        im if im.abs() <= 1e-5 * far => 1,
        im if im > 0.0 => 2,
        _ => 0,
    });
    halves.sum::<usize>() / 2
}

/// Returns a real basis of the space of the first `cut` Schur vectors and of their conjugates, which are among them
/// where these are real.
fn real<T: Scalar>(partial: &Partial<T>, cut: usize, scale: &[f64]) -> Space {
    let q = partial.basis.columns(0, cut);
    let count = if T::IS_REAL { cut } else { 2 * cut };
    let part = |i: usize, j: usize| if j < cut { q[(i, j)].real() } else { q[(i, j - cut)].imaginary() };
    let parts = Matrix::from_fn(q.nrows(), count, part);
    let gram = (parts.transpose() * &parts).symmetric_eigen();
    // A conjugate adds a real vector that is new, or its round-off, squared.
    let mut kept: Vec<usize> = (0..count).filter(|&j| gram.eigenvalues[j] > 1e-6).collect();
    kept.sort_by(|&i, &j| gram.eigenvalues[j].total_cmp(&gram.eigenvalues[i]));
    let weights =
        Matrix::from_fn(count, kept.len(), |i, j| gram.eigenvectors[(i, kept[j])] / gram.eigenvalues[kept[j]].sqrt());
    let mut basis = parts * weights;
    basis.row_iter_mut().zip(scale).for_each(|(mut row, scale)| row /= *scale);
    let n = scale.len() / 2;
    Space { p: basis.rows(0, n).clone_owned(), u: basis.rows(n, n).clone_owned() }
}
