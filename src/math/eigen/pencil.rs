//! A x = lambda E x by the QZ algorithm.

use super::balance::{Balanced, balance};
use super::conjugates::{self, Unit};
use super::{Complex, ComplexMatrix, Matrix, Unsolved, dense};
use crate::tolerances;
use faer::diag::Diag;
use faer::dyn_stack::{MemBuffer, MemStack};
use faer::linalg::gevd::{ComputeEigenvectors, GevdParams, gevd_real, gevd_scratch};
use faer::linalg::temp_mat_scratch;
use faer::{Mat, Par, Spec};

/// Eigenvalues alpha / beta of a pencil, see [`generalized`].
#[derive(Clone, Debug, PartialEq)]
pub struct Generalized {
    /// Numerators in order of descending finiteness; exact conjugates are neighbours.
    pub alpha: Vec<Complex<f64>>,
    /// Denominators, not negative; zero for an infinite eigenvalue, up to rounding.
    pub beta: Vec<f64>,
    /// Right vectors, beta A x = alpha E x, in columns of norm 1; zero if not found, mostly of infinite eigenvalues.
    pub right: ComplexMatrix,
    /// beta / |(alpha, beta)| in the units of the balanced pencil: 0 for infinite, 1 for zero eigenvalues.
    pub finiteness: Vec<f64>,
}

/// The finite eigenvalues, separated from the infinite ones.
#[derive(Clone, Debug, PartialEq)]
pub struct Split {
    /// Finite eigenvalues by magnitude, then real, then imaginary part.
    pub values: Vec<Complex<f64>>,
    /// Right vectors, in columns of norm 1; zero if there is none (defective eigenvalues).
    pub right: ComplexMatrix,
    /// Least finiteness of the finite eigenvalues over the largest of the infinite ones.
    pub gap: f64,
}

/// All eigenvalues, finite and infinite, by QZ on the balanced pencil; about 70 n^3 operations.
///
/// Rounding moves an infinite eigenvalue in a Jordan block of size k to about 1/eps^(1/k): [`Generalized::split`].
/// A pencil with det(A - s E) = 0 for every s is not always detected; `deflate` detects it.
///
/// # Errors
/// Matrices that are not square, of equal size and finite; no convergence; a singular pencil if it is detected.
pub fn generalized(a: &Matrix, e: &Matrix) -> Result<Generalized, Unsolved> {
    let n = dense::square(&[a, e])?;
    let balanced = balance(a, e);
    let (mut found, right) = decompose(&balanced)?;
    check(&balanced, &found)?;
    let finiteness = |unit: &(Unit, f64)| unit.1 / unit.0.value.norm().hypot(unit.1);
    found.sort_by(|a, b| finiteness(b).total_cmp(&finiteness(a)).then(conjugates::compare(&a.0.value, &b.0.value)));
    let mut units: Vec<Unit> = found.iter().map(|unit| unit.0).collect();
    let vectors: Vec<_> = found.iter().map(|(unit, beta)| vector(&balanced, unit, *beta, &right)).collect();
    let mut right = conjugates::matrix(&units, &vectors, n);
    dense::normalize(&mut right);
    units.iter_mut().for_each(|unit| unit.value *= balanced.time);
    let each = |of: &dyn Fn(&(Unit, f64)) -> f64| {
        found.iter().flat_map(|unit| std::iter::repeat_n(of(unit), 1 + usize::from(unit.0.is_pair()))).collect()
    };
    Ok(Generalized {
        alpha: conjugates::values(&units),
        beta: each(&|unit| unit.1),
        right,
        finiteness: each(&finiteness),
    })
}

type Decomposed = (Vec<(Unit, f64)>, Mat<f64>);

/// Returns alpha as units, each with its beta, and the right vectors in the columns of a real matrix.
fn decompose(pencil: &Balanced) -> Result<Decomposed, Unsolved> {
    let n = pencil.a.nrows();
    let mut re = Diag::<f64>::zeros(n);
    re.as_mut().column_vector_mut().fill(f64::NAN);
    let mut im = Diag::<f64>::zeros(n);
    let mut beta = re.clone();
    let mut right = Mat::zeros(n, n);
    let mut options = Spec::<GevdParams, f64>::default();
    // The blocked algorithm does not get along with many infinite eigenvalues: seconds for a hundred rows.
    options.config.schur.blocking_threshold = 10 * n.max(8);
    let no = ComputeEigenvectors::No;
    let yes = ComputeEigenvectors::Yes;
    // faer's scratch size omits a few columns for the vectors.
    let memory = gevd_scratch::<f64>(n, no, yes, Par::Seq, options).and(temp_mat_scratch::<f64>(n + 8, 16));
    let mut memory = MemBuffer::new(memory);
    gevd_real(
        dense::view(&pencil.a).to_owned().as_mut(),
        dense::view(&pencil.e).to_owned().as_mut(),
        re.as_mut(),
        im.as_mut(),
        beta.as_mut(),
        None,
        Some(right.as_mut()),
        Par::Seq,
        MemStack::new(&mut memory),
        options,
    )
    .map_err(|_| Unsolved::NotConverged { converged: 0, wanted: n })?;
    // The beta of a pair is that of its first value: faer copies it to the second.
    let units = conjugates::units(|j| re[j], |j| im[j], n);
    Ok((units.into_iter().map(|unit| (unit, beta[unit.column])).collect(), right))
}

/// An error if values are NaN, faer's only sign that it did not converge, and for 0/0.
fn check(pencil: &Balanced, found: &[(Unit, f64)]) -> Result<(), Unsolved> {
    let size_a = pencil.a.norm();
    let size_e = pencil.e.norm();
    let count = |of: &dyn Fn(&(Unit, f64)) -> bool| {
        found.iter().filter(|unit| of(unit)).map(|unit| 1 + usize::from(unit.0.is_pair())).sum()
    };
    let wanted = pencil.a.nrows();
    let converged = count(&|(unit, beta)| unit.value.is_finite() && beta.is_finite());
    let dependent = count(&|(unit, beta)| {
        beta.abs() <= tolerances::ROUND_OFF_OF_FACTORS * size_e
            && unit.value.norm() <= tolerances::ROUND_OFF_OF_FACTORS * size_a
    });
    match (converged < wanted, dependent) {
        (true, _) => Err(Unsolved::NotConverged { converged, wanted }),
        (_, 1..) => Err(Unsolved::SingularPencil { dependent }),
        _ => Ok(()),
    }
}

/// The vector of a unit; zero if back substitution failed.
fn vector(pencil: &Balanced, unit: &Unit, beta: f64, right: &Mat<f64>) -> Vec<Complex<f64>> {
    let n = pencil.a.nrows();
    let x = ComplexMatrix::from_vec(n, 1, unit.vector(right.as_ref()));
    let product = |matrix: &Matrix| {
        let re = x.map(|x| x.re);
        let im = x.map(|x| x.im);
        (matrix * re).zip_map(&(matrix * im), Complex::new)
    };
    let residual = (product(&pencil.a) * Complex::from(beta) - product(&pencil.e) * unit.value).norm();
    let size = pencil.a.norm() * beta.abs() + pencil.e.norm() * unit.value.norm();
    if residual <= tolerances::ROUND_OFF_OF_SOLUTIONS * size * x.norm() {
        x.iter().zip(&pencil.cols).map(|(x, d)| *x * *d).collect()
    } else {
        vec![Complex::ZERO; n]
    }
}

impl Generalized {
    /// The finite eigenvalues, given the number of `infinite` ones.
    ///
    /// # Errors
    /// More infinite eigenvalues than there are; finite and infinite ones too close to be separated.
    pub fn split(&self, infinite: usize) -> Result<Split, Unsolved> {
        let finite = self.alpha.len().checked_sub(infinite).ok_or(Unsolved::Shape)?;
        let least = finite.checked_sub(1).map_or(1.0, |last| self.finiteness[last]);
        let largest = self.finiteness.get(finite).copied().unwrap_or(f64::MIN_POSITIVE).max(f64::MIN_POSITIVE);
        let gap = (least / largest).min(f64::MAX);
        if infinite > 0 && gap < tolerances::RANK_GAP || least == 0.0 {
            return Err(Unsolved::Doubtful { gap });
        }
        let values: Vec<_> = (0..finite).map(|i| self.alpha[i] / self.beta[i]).collect();
        let mut order: Vec<usize> = (0..finite).collect();
        order.sort_by(|&i, &j| conjugates::compare(&values[i], &values[j]));
        let right = self.right.select_columns(&order);
        Ok(Split { values: order.iter().map(|&i| values[i]).collect(), right, gap })
    }
}
