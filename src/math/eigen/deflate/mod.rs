//! The finite part of a pencil A - lambda E with a singular E.

mod gsvd;
mod level;
mod null_space;

use super::balance::balance;
use super::{Complex, ComplexMatrix, Matrix, Unsolved, dense, eigen};
use crate::tolerances;
use level::{Level, Ranks};

/// Method of removing the infinite eigenvalues, one level (one for each size of their Jordan blocks) after the other.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Deflation {
    /// Left null space of E: the algebraic equations U^T A x = 0, U^T E = 0, restrict x. Orthogonal transformations
    /// only.
    NullSpace,
    /// Generalized singular values of (A, E), infinite ones being the right null space of E: these x follow from the
    /// others. Ranks do not depend on the scale of rows of A against rows of E.
    Gsvd,
}

/// The finite part of a pencil with r finite eigenvalues, see [`deflate`]:
///
/// ```text
/// A V = E V F,   W A = F W E,   W E V = I
/// ```
///
/// so that E x' = A x + B u has the motions x = V z, z = W E x, z' = F z + W B u, plus the direct response to u.
#[derive(Clone, Debug, PartialEq)]
pub struct Deflated {
    /// A_r = W_0 A V of the remaining pencil A_r - lambda E_r, r x r.
    pub a: Matrix,
    /// E_r = W_0 E V, r x r, regular.
    pub e: Matrix,
    /// F = E_r^-1 A_r, r x r.
    pub rate: Matrix,
    /// V, n x r: basis of the finite motions.
    pub basis: Matrix,
    /// W = E_r^-1 W_0, r x n.
    pub left: Matrix,
    /// Number of infinite eigenvalues removed at each level.
    pub levels: Vec<usize>,
    /// Least ratio of a singular value taken for nonzero to one taken for zero (or to rounding).
    pub gap: f64,
}

impl Deflated {
    /// Number of infinite eigenvalues.
    pub fn infinite(&self) -> usize {
        self.levels.iter().sum()
    }
}

/// Removes the infinite eigenvalues, by a staircase of rank decisions (Van Dooren, "The computation of Kronecker's
/// canonical form of a singular pencil", Linear Algebra Appl. 27, 1979). For equations of index 3 these are m at each
/// of three levels. Singular values of the balanced pencil below `tolerance` (see `tolerances::RANK`) are
/// zero. About 30 n^3 operations for each level.
///
/// # Errors
/// Matrices that are not square, of equal size and finite; a singular pencil, det(A - s E) = 0 for every s; a rank that
/// cannot be decided.
pub fn deflate(a: &Matrix, e: &Matrix, by: Deflation, tolerance: f64) -> Result<Deflated, Unsolved> {
    dense::square(&[a, e])?;
    let pencil = balance(a, e);
    let mut a = pencil.a;
    let mut e = pencil.e;
    let mut ranks = Ranks::new(tolerance);
    let mut levels = Vec::new();
    while let Some(level) = match by {
        Deflation::NullSpace => null_space::level(&a, &e, &mut ranks)?,
        Deflation::Gsvd => gsvd::level(&a, &e, &mut ranks)?,
    } {
        (a, e) = (level.a.clone(), level.e.clone());
        levels.push(level);
    }
    let lifted = lift(&levels, &a, &e)?;
    let columns = Matrix::from_fn(lifted.basis.nrows(), a.nrows(), |i, j| lifted.basis[(i, j)] * pencil.cols[i]);
    let rows = Matrix::from_fn(a.nrows(), lifted.left.ncols(), |i, j| lifted.left[(i, j)] * pencil.rows[j]);
    let found = Deflated {
        a: a * pencil.time,
        e,
        rate: lifted.rate * pencil.time,
        basis: columns,
        left: rows,
        levels: levels.iter().map(Level::size).collect(),
        gap: ranks.gap()?,
    };
    let parts = [&found.a, &found.rate, &found.basis, &found.left];
    if parts.into_iter().all(dense::is_finite) { Ok(found) } else { Err(Unsolved::Overflow) }
}

struct Lifted {
    rate: Matrix,
    basis: Matrix,
    left: Matrix,
}

/// Transforms the bases of the innermost pencil back through all levels.
fn lift(levels: &[Level], a: &Matrix, e: &Matrix) -> Result<Lifted, Unsolved> {
    let r = a.nrows();
    let lu = e.clone().full_piv_lu();
    let solve = |right: &Matrix| if r == 0 { Some(right.clone()) } else { lu.solve(right) };
    let singular = Unsolved::Doubtful { gap: 1.0 };
    let rate = solve(a).ok_or(singular)?;
    let inverse = solve(&Matrix::identity(r, r)).ok_or(singular)?;
    let mut basis = Matrix::identity(r, r);
    let mut left = inverse;
    for level in levels.iter().rev() {
        basis = level.lift(&basis, &rate).ok_or(singular)?;
        left = level.lift_left(&left, &rate).ok_or(singular)?;
    }
    Ok(Lifted { rate, basis, left })
}

/// The finite eigenvalues of a pencil, see [`finite`].
#[derive(Clone, Debug, PartialEq)]
pub struct Finite {
    /// Eigenvalues by magnitude, then real, then imaginary part; exact conjugates are neighbours.
    pub values: Vec<Complex<f64>>,
    /// Right vectors, A x = lambda E x, in columns of norm 1.
    pub right: ComplexMatrix,
    /// Left vectors, y^H A = lambda y^H E, in columns with y^H E x = 1; zero if there is none (a defective eigenvalue).
    pub left: ComplexMatrix,
    /// Condition number of `right`; infinite if its columns are dependent to rounding.
    pub conditioning: f64,
    /// Changes of the values by rounding, as [`Eigen::errors`](super::Eigen::errors) of the finite part.
    pub errors: Vec<f64>,
    /// Conditions of the values, as [`Eigen::conditions`](super::Eigen::conditions) of the finite part.
    pub conditions: Vec<f64>,
    /// The finite part of the pencil, from which they are computed.
    pub deflated: Deflated,
}

/// The finite eigenvalues of A x = lambda E x by [`deflate`] and [`eigen`].
///
/// # Errors
/// Those of [`deflate`] and [`eigen`].
pub fn finite(a: &Matrix, e: &Matrix, by: Deflation) -> Result<Finite, Unsolved> {
    let deflated = deflate(a, e, by, tolerances::RANK)?;
    let inner = eigen(&deflated.rate)?;
    let mut right = dense::times(&deflated.basis, &inner.right);
    let lengths: Vec<f64> = right.column_iter().map(|column| column.norm()).collect();
    dense::normalize(&mut right);
    let mut left = dense::times(&deflated.left.transpose(), &inner.left);
    left.column_iter_mut().zip(lengths).for_each(|(mut y, length)| y.iter_mut().for_each(|y| *y *= length));
    let conditioning = dense::condition(&right)?;
    let errors = inner.errors;
    let conditions = inner.conditions;
    Ok(Finite { values: inner.values, errors, conditions, right, left, conditioning, deflated })
}
