//! Eigenvalues and matrix functions for linear models: dense matrices of a few hundred rows, and operators of any size.
//!
//! - [`eigen`]: A x = lambda x with left and right vectors; [`generalized`]: A x = lambda E x with a singular E, by QZ.
//! - `deflate`, `finite`: the finite part of such a pencil, by deflation of its infinite eigenvalues.
//! - [`nearest`]: a few eigenvalues of an operator that is given by its product with a vector.
//! - [`expm`]: exp(A). [`assign`]: the assignment problem, for pairing modes.

mod assignment;
mod balance;
mod conjugates;
mod deflate;
mod dense;
mod exponential;
mod found;
mod inverse;
mod krylov;
mod pencil;
mod second_order;
mod standard;
#[cfg(test)]
mod tests;
mod unsolved;

pub use assignment::assign;
pub use deflate::{Deflated, Deflation, Finite, deflate, finite};
pub use dense::{singular_values, times};
pub use exponential::expm;
pub use found::Eigen;
pub use krylov::{Options, Partial, Scalar, nearest};
pub use pencil::{Generalized, Split, generalized};
pub use standard::eigen;
pub use unsolved::Unsolved;

pub use nalgebra::Complex;
use nalgebra::DMatrix;

/// Complex number.
pub type Complex64 = Complex<f64>;
/// Dense real matrix.
pub type Matrix = DMatrix<f64>;
/// Dense complex matrix.
pub type ComplexMatrix = DMatrix<Complex<f64>>;
