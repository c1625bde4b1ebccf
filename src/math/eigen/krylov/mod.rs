//! A few eigenvalues of a large operator.

mod ritz;
mod schur;
mod space;

use super::{Complex, ComplexMatrix, Unsolved};
use crate::tolerances::math as tolerances;
use ritz::Ritz;
use schur::Ordered;
use space::Krylov;

type C = Complex<f64>;

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
pub struct Partial {
    /// Eigenvalues theta of largest magnitude, largest first.
    pub values: Vec<C>,
    /// Q and T with apply(Q) = Q T, orthonormal Q and triangular T, the values on its diagonal: a basis of the space of
    /// the vectors that is well conditioned for defective eigenvalues too.
    pub schur: [ComplexMatrix; 2],
}

/// The `count` eigenvalues theta of largest magnitude of the operator y = `apply`(x) of dimension n.
///
/// With `apply` = (A - sigma E)^-1 E these belong to the eigenvalues lambda = sigma + 1/theta of A x = lambda E x
/// nearest to sigma, with the same vectors. Infinite eigenvalues have theta = 0 and do not disturb.
///
/// Krylov-Schur method (Stewart, "A Krylov-Schur algorithm for large eigenproblems", SIAM J. Matrix Anal. Appl. 23,
/// 2001), from a fixed start vector. Each step costs an application and 8 n m operations, m the size of the subspace;
/// memory is n m numbers. faer's `partial_eigen` gives vectors only, which coincide where an eigenvalue is defective, as
/// that of a free motion is, passes on no error of `apply`, and does not end where the space closes in itself (y = 2 x
/// of 500 rows).
///
/// # Errors
/// Errors of `apply`; no convergence within the restarts, with the number that converged; results that are not finite.
pub fn nearest(
    n: usize,
    count: usize,
    apply: impl FnMut(&[C], &mut [C]) -> Result<(), Unsolved>,
    options: Options,
) -> Result<Partial, Unsolved> {
    let count = count.min(n);
    let m = options.subspace.unwrap_or(2 * count + 20).max(count + 2).min(n);
    if count == 0 {
        return Ok(Partial { values: Vec::new(), schur: [ComplexMatrix::zeros(n, 0), ComplexMatrix::zeros(0, 0)] });
    }
    let mut space = Krylov::new(n, m, options.filter, apply)?;
    let (mut converged, mut known) = (0, None);
    for _ in 0..=options.restarts {
        space.extend()?;
        let ritz = Ritz::of(&space.h, space.rest, count)?;
        converged = ritz.converged(options.tolerance);
        if converged == count {
            let size: f64 = ritz.values.iter().map(|theta| theta.norm()).sum();
            if !options.repeats
                || count == n
                || known.is_some_and(|before: f64| size - before <= tolerances::KRYLOV_NEW * size)
            {
                return space.finish(ritz.values);
            }
            known = Some(size);
            space.renew(&Ordered::of(&space.h)?, count)?;
            continue;
        }
        // More than the wanted ones are kept, which speeds up convergence; those that have converged count as kept.
        let kept = (count + (m - count) / 3 + converged / 2).min(m - 1);
        space.contract(&Ordered::of(&space.h)?, kept);
    }
    Err(Unsolved::NotConverged { converged, wanted: count })
}
