//! The promise: how near the watched outputs of a model are to those of the richest.

use crate::analysis::{Sizes, scales};
use crate::scene::units::{Dimension, dimension_of};
use crate::system::Column;
use crate::tolerances::report as tolerances;
use serde::Serialize;

/// Size that the difference of an output is relative to, and how it is taken over time.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize)]
#[serde(rename_all = "snake_case")]
pub enum Norm {
    /// The largest difference over the range of the output, max - min.
    #[default]
    Range,
    /// The root mean square of the difference over that of the output about its mean.
    Rms,
}

/// Outputs of the full model, and what differences from them are relative to.
#[derive(Clone, Debug)]
pub struct Promise {
    /// The watched outputs.
    pub columns: Vec<Column>,
    /// The allowed difference of each, such as 0.1.
    pub within: f64,
    norm: Norm,
    rows: Vec<Vec<f64>>,
    scales: Vec<f64>,
}

impl Promise {
    /// Promise about outputs with these values over the motion of the full model. What hardly moves is measured in
    /// thousandths of the motion ([`scales`]); energies, whose zero is arbitrary, in the swing of the kinetic energy.
    pub fn new((within, norm): (f64, Norm), columns: &[Column], rows: Vec<Vec<f64>>, sizes: &Sizes) -> Promise {
        let sizes = scales(columns, &rows, sizes);
        let scale = |i: usize| {
            let values = || rows.iter().map(move |row: &Vec<f64>| row[i]);
            let part = match dimension_of(&columns[i].unit) {
                Some(Dimension::Energy) => 1.0,
                _ => tolerances::ZERO_BY_SYMMETRY,
            };
            norm.size(values()).max(part * sizes[i])
        };
        let scales = (0..columns.len()).map(scale).collect();
        Promise { columns: columns.to_vec(), within, norm, scales, rows }
    }

    /// The same promise about another motion of the full model.
    pub fn about(&self, rows: Vec<Vec<f64>>, sizes: &Sizes) -> Promise {
        Promise::new((self.within, self.norm), &self.columns, rows, sizes)
    }

    /// Names of the watched outputs.
    pub fn names(&self) -> Vec<String> {
        self.columns.iter().map(|column| column.name.clone()).collect()
    }

    /// The relative difference of each output, infinite where one is no number; `None` where rows are missing.
    pub fn errors(&self, rows: &[Vec<f64>]) -> Option<Vec<f64>> {
        self.differences(&self.rows, rows)
    }

    /// The largest relative difference between the outputs of two models; `None` where rows are missing.
    pub fn difference(&self, one: &[Vec<f64>], other: &[Vec<f64>]) -> Option<f64> {
        Some(self.differences(one, other)?.into_iter().fold(0.0, f64::max))
    }

    fn differences(&self, one: &[Vec<f64>], other: &[Vec<f64>]) -> Option<Vec<f64>> {
        let of = |i: usize| {
            let differences = one.iter().zip(other).map(|(one, other)| other[i] - one[i]);
            if differences.clone().all(f64::is_finite) {
                self.norm.difference(differences) / self.scales[i]
            } else {
                f64::INFINITY
            }
        };
        (one.len() == other.len()).then(|| (0..self.columns.len()).map(of).collect())
    }
}

impl Norm {
    /// Size of the values of an output.
    fn size(self, values: impl Iterator<Item = f64> + Clone) -> f64 {
        match self {
            Norm::Range => values.clone().fold(f64::MIN, f64::max) - values.fold(f64::MAX, f64::min),
            Norm::Rms => {
                let mean = values.clone().sum::<f64>() / values.clone().count().max(1) as f64;
                self.difference(values.map(|value| value - mean))
            }
        }
    }

    fn difference(self, values: impl Iterator<Item = f64> + Clone) -> f64 {
        match self {
            Norm::Range => values.fold(0.0, |most: f64, value| most.max(value.abs())),
            Norm::Rms => {
                let count = values.clone().count().max(1) as f64;
                (values.map(|value| value * value).sum::<f64>() / count).sqrt()
            }
        }
    }
}
