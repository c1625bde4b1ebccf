//! Arrays of numbers in scenes and files.

use crate::body::Build;
use crate::error::{Error, Result};
use crate::math::expression::Number;
use schemars::JsonSchema;
use serde::{Deserialize, Serialize, Serializer};

/// A number, a list of them, or lists of lists.
#[derive(Serialize, Deserialize, JsonSchema, Clone, Debug, PartialEq)]
#[serde(untagged, expecting = "expected a number, an expression such as \"E*b*h\", or lists of these")]
pub enum Table {
    /// A number, or an expression over the parameters.
    Number(Number),
    /// A list of numbers or of lists.
    List(Vec<Table>),
}

/// Numbers with the lengths of their nested lists; the last index runs fastest.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Array {
    /// Lengths of the nested lists, outermost first; empty for a single number.
    pub shape: Vec<usize>,
    /// Entries in row-major order.
    pub values: Vec<f64>,
}

impl Table {
    /// # Errors
    /// Bad input: numbers that have no finite value, or lists of different lengths.
    pub fn resolve<const D: usize>(&self, field: &str, build: &Build<D>) -> Result<Array> {
        let list = match self {
            Table::Number(number) => {
                return Ok(Array { shape: Vec::new(), values: vec![build.number(field, number)?] });
            }
            Table::List(list) => list,
        };
        let mut array = Array { shape: vec![list.len()], values: Vec::new() };
        for (i, part) in list.iter().enumerate() {
            let part = part.resolve(&format!("{field}[{i}]"), build)?;
            if i == 0 {
                array.shape.extend(&part.shape);
            } else if array.shape[1..] != part.shape {
                let expected = in_words(&array.shape[1..]);
                let message = format!("expected {expected} as before it, found {}", in_words(&part.shape));
                return Err(Error::input(message).under(format!("{field}[{i}]")));
            }
            array.values.extend(part.values);
        }
        Ok(array)
    }
}

impl Array {
    /// Array of a single number, of empty shape.
    pub fn number(value: f64) -> Self {
        Array { shape: Vec::new(), values: vec![value] }
    }

    /// The values, if the shape is `shape`; lengths of 1 in either are ignored.
    ///
    /// # Errors
    /// Bad input that says what was found and expected.
    pub fn fit(&self, field: &str, shape: &[usize]) -> Result<&[f64]> {
        let long = |shape: &[usize]| -> Vec<usize> { shape.iter().copied().filter(|length| *length != 1).collect() };
        if long(&self.shape) == long(shape) {
            return Ok(&self.values);
        }
        Err(Error::input(format!("expected {}, found {}", in_words(shape), in_words(&self.shape))).under(field))
    }

    /// The value of an array of one number.
    pub fn scalar(&self, field: &str) -> Result<f64> {
        self.fit(field, &[])?.first().copied().ok_or_else(|| Error::input("expected a number").under(field))
    }
}

impl Serialize for Array {
    fn serialize<S: Serializer>(&self, out: S) -> std::result::Result<S::Ok, S::Error> {
        self.table(&self.shape, &self.values).serialize(out)
    }
}

impl Array {
    fn table(&self, shape: &[usize], values: &[f64]) -> Table {
        match shape.split_first() {
            None => Table::Number(Number::Value(values.first().copied().unwrap_or(f64::NAN))),
            Some((length, rest)) => {
                let size: usize = rest.iter().product();
                let part = |i: usize| self.table(rest, &values[i * size..(i + 1) * size]);
                Table::List((0..*length).map(part).collect())
            }
        }
    }
}

/// The shape in a message, such as `3 x 4 numbers`.
fn in_words(shape: &[usize]) -> String {
    match shape {
        [] => "one number".to_string(),
        [n] => format!("{n} numbers"),
        _ => format!("{} numbers", shape.iter().map(usize::to_string).collect::<Vec<_>>().join(" x ")),
    }
}
