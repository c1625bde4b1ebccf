//! The matrices of linear models.

/// A dense real matrix.
pub type Matrix = nalgebra::DMatrix<f64>;
