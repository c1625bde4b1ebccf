//! A few eigenvalues of a large operator.

mod ritz;
mod schur;
mod space;

use super::{Complex64, Unsolved};
use crate::math::kkt::Field;
use crate::tolerances;
use nalgebra::{DMatrix, DVector};
use ritz::Ritz;
use schur::Ordered;
use space::Krylov;

/// `f64` or `c64`, the numbers of an operator.
pub trait Scalar: Field + faer::traits::ComplexField<Real = f64> + nalgebra::ComplexField<RealField = f64> {
    /// Returns a basis of the spaces of the vectors, in their order, and the sizes of their blocks: for a real matrix
    /// the real and the imaginary part of one vector of a pair, of size two.
    #[doc(hidden)]
    fn columns(ritz: &Ritz) -> (Vec<DVector<Self>>, Vec<usize>);
}

impl Scalar for Complex64 {
    fn columns(ritz: &Ritz) -> (Vec<DVector<Complex64>>, Vec<usize>) {
        let columns: Vec<_> = ritz.vectors.column_iter().map(|column| column.clone_owned()).collect();
        let sizes = vec![1; columns.len()];
        (columns, sizes)
    }
}

impl Scalar for f64 {
    fn columns(ritz: &Ritz) -> (Vec<DVector<f64>>, Vec<usize>) {
        let mut columns = Vec::new();
        let mut sizes = Vec::new();
        for (value, vector) in ritz.values.iter().zip(ritz.vectors.column_iter()).filter(|(value, _)| value.im >= 0.0) {
            let size = if value.im > 0.0 { 2 } else { 1 };
            columns.extend([vector.map(|x| x.re), vector.map(|x| x.im)].into_iter().take(size));
            sizes.push(size);
        }
        (columns, sizes)
    }
}

/// Options of [`nearest`].
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Options {
    /// Size of the subspace; at least `count` + 2 are taken, at most n.
    pub subspace: Option<usize>,
    /// |apply(x) - theta x| of a converged pair, over the largest |theta|.
    pub tolerance: f64,
    /// Largest number of restarts.
    pub restarts: usize,
    /// Applications of the operator to a start vector before it is used. One less than the rows of the largest Jordan
    /// block of theta = 0 remove the components of infinite eigenvalues of a pencil.
    pub filter: usize,
    /// True to repeat from other start vectors until nothing new is found: one alone gives one vector of each
    /// eigenvalue. Costs the applications of a restart or more.
    pub repeats: bool,
}

impl Default for Options {
    fn default() -> Self {
        Options { subspace: None, tolerance: 1e-12, restarts: 300, filter: 0, repeats: false }
    }
}

/// Some eigenvalues of an operator, see [`nearest`].
#[derive(Clone, Debug, PartialEq)]
pub struct Partial<T: Scalar> {
    /// Eigenvalues theta of largest magnitude, largest first; of a real operator both of a pair.
    pub values: Vec<Complex64>,
    /// Orthonormal Schur vectors: the leading k span the space of the first k values, for defective ones too, unless
    /// that parts a pair of a real operator.
    pub basis: DMatrix<T>,
}

/// The `count` eigenvalues theta of largest magnitude of the operator y = `apply`(x) of dimension n.
///
/// With `apply` = (A - sigma E)^-1 E these belong to the eigenvalues lambda = sigma + 1/theta of A x = lambda E x
/// nearest to sigma, with the same vectors. Infinite eigenvalues have theta = 0 and do not disturb. Real pencils and
/// shifts have a real operator, of which all is computed in real numbers, at half the cost or less.
///
/// Krylov-Schur method (Stewart, "A Krylov-Schur algorithm for large eigenproblems", SIAM J. Matrix Anal. Appl. 23,
/// 2001), from a fixed start vector. Each step costs an application and 8 n m operations, m the size of the subspace;
/// memory is n m numbers. faer's `partial_eigen` gives vectors only, which coincide where an eigenvalue is defective, as
/// that of a free motion is, passes on no error of `apply`, and does not end where the space closes in itself (y = 2 x
/// of 500 rows).
///
/// # Errors
/// Errors of `apply`; no convergence within the restarts, with the number that converged; results that are not finite.
pub fn nearest<T: Scalar>(
    n: usize,
    count: usize,
    apply: impl FnMut(&[T], &mut [T]) -> Result<(), Unsolved>,
    options: Options,
) -> Result<Partial<T>, Unsolved> {
    let count = count.min(n);
    let m = options.subspace.unwrap_or(2 * count + 20).max(count + 2).min(n);
    if count == 0 {
        return Ok(Partial { values: Vec::new(), basis: DMatrix::zeros(n, 0) });
    }
    let mut space = Krylov::new(n, m, options.filter, apply)?;
    let mut converged = 0;
    let mut known = None;
    for _ in 0..=options.restarts {
        space.extend()?;
        let ritz = Ritz::of(&space.h)?;
        converged = ritz.converged(count, space.rest, options.tolerance);
        if converged == count {
            let size: f64 = ritz.values[..count].iter().map(|theta| theta.norm()).sum();
            if !options.repeats
                || count == n
                || known.is_some_and(|before: f64| size - before <= tolerances::ROOT_OF_ROUND_OFF * size)
            {
                return space.finish(ritz, count);
            }
            known = Some(size);
            space.renew(&Ordered::of(&space.h, &ritz)?, count)?;
            continue;
        }
        // More than the wanted ones are kept, which speeds up convergence; those that have converged count as kept.
        let kept = (count + (m - count) / 3 + converged / 2).min(m.saturating_sub(2));
        space.contract(&Ordered::of(&space.h, &ritz)?, kept);
    }
    Err(Unsolved::NotConverged { converged, wanted: count })
}
