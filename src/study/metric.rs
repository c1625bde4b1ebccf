//! How far runs are from a reference.

use super::run::RunSample;
use super::watched::Watched;
use crate::analysis::{Sizes, scales};
use crate::system::Column;
use serde::{Deserialize, Serialize};

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

    /// Returns the largest and the root mean square relative difference of a quantity by its name.
    pub fn spread(&self, name: &str, values: &[f64]) -> Option<(f64, f64)> {
        let i = self.names.iter().position(|known| known == name)?;
        let own = self.rows.iter().map(|row| row[i]);
        let all: Vec<f64> = own.zip(values).map(|(own, other)| self.difference(i, own, *other)).collect();
        let squares: f64 = all.iter().map(|difference| difference * difference).sum();
        Some((all.iter().copied().fold(0.0, f64::max), (squares / all.len().max(1) as f64).sqrt()))
    }

    fn difference(&self, i: usize, own: f64, other: f64) -> f64 {
        (other - own).abs() / self.scales[i]
    }
}
