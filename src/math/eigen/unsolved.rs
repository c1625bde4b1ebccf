//! Errors of eigenvalue problems and other linear algebra.

use crate::math::kkt::Singular;

/// Reason why a problem of linear algebra has no answer.
#[derive(Clone, Copy, Debug, PartialEq, thiserror::Error)]
pub enum Unsolved {
    /// Matrices are not square or not of equal size.
    #[error("the matrices of an eigenvalue problem do not have the same size")]
    Shape,
    /// Entries are infinite or not a number.
    #[error("a matrix has entries that are not finite")]
    NotFinite,
    /// Only `converged` of `wanted` eigenvalues (or singular values) were found.
    #[error("eigenvalues do not converge: {converged} of {wanted} found")]
    NotConverged {
        /// Number found.
        converged: usize,
        /// Number asked for.
        wanted: usize,
    },
    /// det(A - s E) = 0 for every s, by `dependent` equations that follow from others.
    #[error(
        "A x = s E x has a solution for every s, so no eigenvalues: {dependent} equations depend on others, as those of \
         redundant constraints do"
    )]
    SingularPencil {
        /// Number of dependent equations.
        dependent: usize,
    },
    /// Finite and infinite eigenvalues, or nonzero and zero singular values, differ only by a factor of `gap`.
    #[error(
        "finite and infinite eigenvalues cannot be told apart: only a factor of {gap:.1} lies between them; the equations \
         are badly scaled or nearly redundant"
    )]
    Doubtful {
        /// Ratio of the smallest value taken for nonzero to the largest taken for zero.
        gap: f64,
    },
    /// The solution is too large for floating-point numbers.
    #[error("the solution is too large for a floating-point number")]
    Overflow,
    /// Applying an operator failed.
    #[error(transparent)]
    Operator(#[from] Singular),
}
