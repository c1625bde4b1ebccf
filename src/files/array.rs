//! A named value in a file for Python or MATLAB.

use nalgebra::Complex;
use serde::{Serialize, Serializer};

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

/// Nested lists of numbers; null where a number is not finite, and complex numbers as pairs.
impl Serialize for Array {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        match self {
            Array::Flag(flag) => flag.serialize(serializer),
            Array::Real { shape, values } => Nested { shape, values }.serialize(serializer),
            Array::Complex { shape, values } => {
                let parts: Vec<f64> = values.iter().flat_map(|value| [value.re, value.im]).collect();
                Nested { shape: &[&shape[..], &[2]].concat(), values: &parts }.serialize(serializer)
            }
            Array::Text(text) => text.serialize(serializer),
            Array::Texts(texts) => texts.serialize(serializer),
        }
    }
}

/// The entries of an array, or of a part of it.
struct Nested<'a> {
    shape: &'a [usize],
    values: &'a [f64],
}

impl Serialize for Nested<'_> {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        match self.shape {
            [] => self.values.first().serialize(serializer),
            [_] => self.values.serialize(serializer),
            [count, shape @ ..] => {
                let size: usize = shape.iter().product();
                serializer.collect_seq((0..*count).map(|i| Nested { shape, values: &self.values[i * size..][..size] }))
            }
        }
    }
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
