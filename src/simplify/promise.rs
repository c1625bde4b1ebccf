//! The promise: how near the watched outputs of a model are to those of the richest.

use crate::analysis::Sizes;
use crate::study::{ErrorMetric, Norm};
use crate::system::Column;

/// Outputs of the full model, and what differences from them are relative to.
#[derive(Clone, Debug)]
pub struct Promise {
    /// The watched outputs.
    pub columns: Vec<Column>,
    /// The allowed difference of each, such as 0.1.
    pub within: f64,
    norm: Norm,
    metric: ErrorMetric,
}

impl Promise {
    /// Promise about outputs with these values over the motion of the full model.
    pub fn new(within: f64, norm: Norm, columns: &[Column], rows: Vec<Vec<f64>>, sizes: &Sizes) -> Promise {
        Promise { columns: columns.to_vec(), within, norm, metric: ErrorMetric::by(norm, columns, rows, sizes) }
    }

    /// The same promise about another motion of the full model.
    pub fn about(&self, rows: Vec<Vec<f64>>, sizes: &Sizes) -> Promise {
        Promise::new(self.within, self.norm, &self.columns, rows, sizes)
    }

    /// Names of the watched outputs.
    pub fn names(&self) -> Vec<String> {
        self.metric.names.clone()
    }

    /// The relative difference of each output, infinite where one is no number; `None` where rows are missing.
    pub fn errors(&self, rows: &[Vec<f64>]) -> Option<Vec<f64>> {
        self.metric.differences(self.norm, &self.metric.rows, rows)
    }

    /// The largest relative difference between the outputs of two models; `None` where rows are missing.
    pub fn difference(&self, one: &[Vec<f64>], other: &[Vec<f64>]) -> Option<f64> {
        Some(self.metric.differences(self.norm, one, other)?.into_iter().fold(0.0, f64::max))
    }
}
