//! What stands under a name in a file for Python or MATLAB.

use nalgebra::Complex;

/// Numbers or texts. The last index of `shape` runs fastest; no index is a single number.
#[derive(Clone, Debug, PartialEq)]
pub enum Array {
    Flag(bool),
    Real { shape: Vec<usize>, values: Vec<f64> },
    Complex { shape: Vec<usize>, values: Vec<Complex<f64>> },
    Text(String),
    Texts(Vec<String>),
}

impl Array {
    pub fn number(value: f64) -> Self {
        Array::Real { shape: Vec::new(), values: vec![value] }
    }

    pub fn vector(values: &[f64]) -> Self {
        Array::Real { shape: vec![values.len()], values: values.to_vec() }
    }

    pub fn complex(values: Vec<Complex<f64>>) -> Self {
        Array::Complex { shape: vec![values.len()], values }
    }
}
