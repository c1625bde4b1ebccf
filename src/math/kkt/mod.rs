//! The saddle-point (KKT) system of constrained motion,
//!
//! ```text
//! [M  G^T] [a     ]   [r1]        M symmetric n x n, positive definite on the null space of G,
//! [G  0  ] [lambda] = [r2]        G m x n.
//! ```
//!
//! [`SaddlePoint`] does the symbolic work once, then factors and solves any number of times:
//!
//! 1. L D L^T without pivoting in an order that makes this safe (`order`), over the blocks of bodies and joints (`blocks`)
//!    or, where L fills, over faer's (`supernodal`). Each pivot is compared with its size before
//!    elimination.
//! 2. When a pivot collapses: the same with dependent rows dropped, those that are named or copies of others before the
//!    factorization (`saddle::kept`), others in it (`redundant_rows`), if it is clear which these are. Multipliers are
//!    then those of least norm, and contradicting right sides get a least-squares solution, unless very many are dropped.
//! 3. Else, and not too large: a dense pivoted QR (`rank_revealing`). [`Reduced`] is this alone; [`CorrectionChart`]
//!    moves states to the constraints along the directions that it finds.
//!
//! [`Unsymmetric`] solves the systems of implicit methods, which add stiffness and damping to M, and of half-explicit
//! ones, whose two G differ.

mod alike;
mod analysis;
mod blocks;
mod dependence;
mod ldlt;
mod order;
mod orthonormal;
mod parts;
mod pattern;
mod pivot;
mod rank_revealing;
mod redundant_rows;
mod saddle;
mod supernodal;
mod system;
#[cfg(test)]
mod tests;
mod unsymmetric;

pub use analysis::Analysis;
pub use dependence::{Dependence, DependentRow, dependent_rows};
pub use pattern::{Lever, Pattern};
pub use rank_revealing::{CorrectionChart, Reduced};
pub use redundant_rows::has_least_norm;
pub use saddle::SaddlePoint;
pub use unsymmetric::{Field, Places, Unsymmetric};

/// Reason why a saddle-point system cannot be solved.
#[derive(Clone, Copy, Debug, PartialEq, Eq, thiserror::Error)]
pub enum Singular {
    /// A direction of motion has neither mass nor constraint; `coordinate` moves most along it.
    #[error("the motion is not determined: coordinate {coordinate} has neither mass nor constraint along a direction")]
    Undetermined {
        /// Index of the velocity.
        coordinate: usize,
    },
    /// The matrix or a solution is not finite.
    #[error("the saddle-point system or its solution is not finite")]
    NotFinite,
    /// The matrix of an implicit step is singular: other constraints are dependent than at the start.
    #[error(
        "the matrix of an implicit step is singular: the rank of the constraints changes, or the motion is not determined"
    )]
    Collapsed,
    /// Lengths of values or right sides are not those of the patterns.
    #[error("the values do not fit the saddle-point system's patterns")]
    Shape,
    /// The last factorization failed, or there was none.
    #[error("the saddle-point system is not factored")]
    NotFactored,
    /// Constraints at two states, one for the reactions and one for the motion, have nothing in common.
    #[error("the constraints at the ends of a stage are too far apart for its equations to be solved")]
    Apart,
}
