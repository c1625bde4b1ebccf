//! How far runs are from a reference.

use super::run::RunSample;
use super::watched::Watched;
use crate::analysis::{Sizes, scales};
use crate::scene::units::{Dimension, dimension_of};
use crate::system::Column;
use crate::tolerances;
use serde::{Deserialize, Serialize};

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

impl Norm {
    /// Returns the size of the values of an output.
    fn size(self, values: impl Iterator<Item = f64> + Clone) -> f64 {
        match self {
            Norm::Range => values.clone().fold(f64::MIN, f64::max) - values.fold(f64::MAX, f64::min),
            Norm::Rms => {
                let mean = values.clone().sum::<f64>() / values.clone().count().max(1) as f64;
                self.over(values.map(|value| value - mean))
            }
        }
    }

    /// Returns the difference of an output, from those at each time.
    fn over(self, differences: impl Iterator<Item = f64> + Clone) -> f64 {
        match self {
            Norm::Range => differences.fold(0.0, |most: f64, value| most.max(value.abs())),
            Norm::Rms => {
                let count = differences.clone().count().max(1) as f64;
                (differences.map(|value| value * value).sum::<f64>() / count).sqrt()
            }
        }
    }
}

/// Reference values, and the size of each quantity that errors are relative to.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct ErrorMetric {
    /// Names of the quantities.
    pub names: Vec<String>,
    /// Reference values, one row for each time.
    pub rows: Vec<Vec<f64>>,
    scales: Vec<f64>,
}

impl ErrorMetric {
    /// A metric with scales from the rows and the sizes of the motion.
    pub fn new(columns: &[Column], rows: Vec<Vec<f64>>, sizes: &Sizes) -> ErrorMetric {
        let names = columns.iter().map(|column| column.name.clone()).collect();
        ErrorMetric { names, scales: scales(columns, &rows, sizes), rows }
    }

    /// The metric of a completed run.
    pub(crate) fn of(watched: &Watched, run: &RunSample) -> ErrorMetric {
        ErrorMetric::new(&watched.columns, run.rows.clone(), &run.sizes)
    }

    /// A metric with scales by a norm. What hardly moves is measured in thousandths of the motion ([`scales`]); energies,
    /// whose zero is arbitrary, in the range of the kinetic energy.
    pub(crate) fn by(norm: Norm, columns: &[Column], rows: Vec<Vec<f64>>, sizes: &Sizes) -> ErrorMetric {
        let metric = ErrorMetric::new(columns, rows, sizes);
        let scale = |(i, column): (usize, &Column)| {
            let part = match dimension_of(&column.unit) {
                Some(Dimension::Energy) => 1.0,
                _ => tolerances::UNSEEN,
            };
            norm.size(metric.rows.iter().map(|row| row[i])).max(part * metric.scales[i])
        };
        let scales = columns.iter().enumerate().map(scale).collect();
        ErrorMetric { scales, ..metric }
    }

    /// Returns the largest relative difference, and the name of its quantity.
    pub fn error(&self, rows: &[Vec<f64>]) -> (f64, String) {
        let errors = self.errors(rows).into_iter().zip(&self.names);
        let worst = errors.reduce(|worst, next| if next.0 > worst.0 || next.0.is_nan() { next } else { worst });
        worst.map_or((0.0, String::new()), |(error, name)| (error, name.clone()))
    }

    /// Returns the largest relative difference of each quantity; infinite where rows are missing.
    pub fn errors(&self, rows: &[Vec<f64>]) -> Vec<f64> {
        let of = |i: usize| {
            // Where the reference is not defined, there is nothing to compare.
            let pairs = self.rows.iter().zip(rows).filter(|(own, _)| own[i].is_finite());
            let differences = pairs.map(|(own, other)| self.difference(i, own[i], other[i]));
            differences.fold(0.0, |most: f64, one| if one > most || one.is_nan() { one } else { most })
        };
        let is_whole = rows.len() == self.rows.len();
        (0..self.names.len()).map(|i| if is_whole { of(i) } else { f64::INFINITY }).collect()
    }

    /// Returns the relative difference of each quantity between two runs by a norm, infinite where a value is not
    /// defined; none where rows are missing.
    pub(crate) fn differences(&self, norm: Norm, one: &[Vec<f64>], other: &[Vec<f64>]) -> Option<Vec<f64>> {
        let of = |i: usize| {
            let differences = one.iter().zip(other).map(|(one, other)| other[i] - one[i]);
            if differences.clone().all(f64::is_finite) {
                norm.over(differences) / self.scales[i]
            } else {
                f64::INFINITY
            }
        };
        (one.len() == other.len()).then(|| (0..self.names.len()).map(of).collect())
    }

    /// Returns the largest and the root mean square relative difference of a quantity by its name.
    pub fn spread(&self, name: &str, values: &[f64]) -> Option<(f64, f64)> {
        let i = self.names.iter().position(|known| known == name)?;
        let own = self.rows.iter().map(|row| row[i]);
        let differences = own.zip(values).map(|(own, other)| self.difference(i, own, *other));
        Some((Norm::Range.over(differences.clone()), Norm::Rms.over(differences)))
    }

    fn difference(&self, i: usize, own: f64, other: f64) -> f64 {
        (other - own).abs() / self.scales[i]
    }
}
