//! A named value in a file for Python or MATLAB.

use nalgebra::Complex;

/// Numbers or texts. The last index of `shape` runs fastest; no index is a single number.
#[derive(Clone, Debug, PartialEq)]
pub enum Array {
    /// A logical value.
    Flag(bool),
    /// Real numbers in row-major order.
    Real {
        /// Lengths of the dimensions; empty for a single number.
        shape: Vec<usize>,
        /// Entries, the last index fastest.
        values: Vec<f64>,
    },
    /// Complex numbers in row-major order.
    Complex {
        /// Lengths of the dimensions; empty for a single number.
        shape: Vec<usize>,
        /// Entries, the last index fastest.
        values: Vec<Complex<f64>>,
    },
    /// One text.
    Text(String),
    /// A list of texts.
    Texts(Vec<String>),
}

impl Array {
    /// A single real number, of empty shape.
    pub fn number(value: f64) -> Self {
        Array::Real { shape: Vec::new(), values: vec![value] }
    }

    /// A vector of real numbers.
    pub fn vector(values: &[f64]) -> Self {
        Array::Real { shape: vec![values.len()], values: values.to_vec() }
    }

    /// A vector of complex numbers.
    pub fn complex(values: Vec<Complex<f64>>) -> Self {
        Array::Complex { shape: vec![values.len()], values }
    }
}
