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
//! 2. When a pivot collapses: the same with dependent rows dropped (`redundant_rows`), if it is clear which these are.
//!    Rows that are known to be dependent, or are found so among rows of the same coordinates (`alike`), are not
//!    factored (`kept`).
//! 3. Else, and not too large: a dense rank-revealing factorization (`null_space`).
//!
//! [`PseudoInverse`] and [`Reduced`] solve the same system densely in other ways, for comparison. [`Chart`] moves
//! states to the constraints along fixed directions. [`Unsymmetric`] solves the system of implicit methods, which adds
//! stiffness and damping to M.
//!
//! Redundant rows get multipliers of least norm, and contradicting right sides a least-squares solution (`least`), by
//! one more sparse factorization for any number of them.

mod alike;
mod analysis;
mod blocks;
mod chart;
mod condition;
mod dependence;
mod kept;
mod ldlt;
mod least;
mod nearly;
mod null_space;
mod order;
mod pattern;
mod pivot;
mod pivoted;
mod pseudo_inverse;
mod reduced;
mod redundant_rows;
mod saddle;
mod supernodal;
mod symbolic;
mod system;
#[cfg(test)]
mod tests;
mod two_jacobian;
mod unsymmetric;

pub use analysis::Analysis;
pub use chart::Chart;
pub use condition::condition_number;
pub use dependence::{Dependence, DependentRow, dependent_rows};
pub use pattern::Pattern;
pub use pseudo_inverse::PseudoInverse;
pub use reduced::Reduced;
pub use saddle::SaddlePoint;
pub use two_jacobian::TwoJacobianGmres;
pub use unsymmetric::{Field, Unsymmetric};

/// A solver of the system: factor once, then solve any number of times.
pub trait Solver {
    /// Factors with these values at the places of M and G. Near singular states rows count as dependent below 1e-4 of
    /// `reference`, the rank indicator at regular states; zero if that is not known.
    fn factor(&mut self, mass: &[f64], g: &[f64], reference: f64) -> Result<(), Singular>;

    /// Rank indicator of G at the last factorization, without dropped rows; in a metric of the solver's own.
    fn rank_indicator(&self) -> f64;

    /// Solves in place: (r1, r2) -> (a, lambda).
    fn solve(&mut self, top: &mut [f64], bottom: &mut [f64]) -> Result<(), Singular>;

    /// Drops these rows from the next factorization on, if the solver can be misled by them: see
    /// [`SaddlePoint::drop_rows`].
    fn drop_rows(&mut self, _rows: &[usize]) {}

    /// True if rows of G were dependent at the last factorization.
    fn is_rank_deficient(&self) -> bool;

    /// [`SaddlePoint::rank_indicator`]; `None` if the solver does not compute it.
    fn row_indicator(&self) -> Option<f64> {
        None
    }
}

/// Reason why a saddle-point system cannot be solved.
#[derive(Clone, Copy, Debug, PartialEq, Eq, thiserror::Error)]
pub enum Singular {
    /// A direction of motion has neither mass nor constraint; `coordinate` moves most along it.
    #[error("the motion is not determined: coordinate {coordinate} has neither mass nor constraint along a direction")]
    Undetermined {
        /// Index of the velocity.
        coordinate: usize,
    },
    /// M is singular where a method needs its inverse; `coordinate` moves most along the direction without mass.
    #[error("the mass matrix is singular: coordinate {coordinate} has no mass along a direction")]
    Massless {
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
    /// The iteration of [`TwoJacobianGmres`], between constraints at two states, does not converge.
    #[error("the constraints at the ends of a stage are too far apart for its equations to be solved")]
    Apart,
}
