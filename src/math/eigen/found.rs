//! The eigenvalues and eigenvectors of a matrix.

use super::{Complex, ComplexMatrix};

/// Eigenvalues and eigenvectors of a real matrix, see [`eigen`](super::eigen).
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
