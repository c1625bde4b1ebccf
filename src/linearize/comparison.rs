//! Comparison of several methods at one state.

use super::{Complex, Kind, LinearModel};
use crate::tolerances;
use serde::Serialize;

/// Accuracy and cost of one method at a state.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Comparison {
    /// Method with its options, as on the command line.
    pub method: String,
    /// Chart of its coordinates.
    pub chart: String,
    /// Largest relative distance of the physical eigenvalues from those of the reference; none without a reference, or
    /// where their numbers differ or the model is not comparable.
    pub error: Option<f64>,
    /// Number of physical eigenvalues.
    pub physical: usize,
    /// Number of spurious eigenvalues.
    pub spurious: usize,
    /// Number of infinite eigenvalues.
    pub infinite: usize,
    /// Part of the motion off the directions that the constraints allow, in [0, 1]: largest of the physical modes,
    /// least of the spurious ones.
    pub off_constraints: Option<[f64; 2]>,
    /// Condition number of the eigenvector matrix; none where the eigenvectors are dependent.
    pub conditioning: Option<f64>,
    /// Rows and columns of A.
    pub size: usize,
    /// Time to assemble the matrices, microseconds.
    pub assembly_microseconds: f64,
    /// Time to compute the eigenvalues, microseconds.
    pub eigen_microseconds: f64,
}

/// Compares the physical eigenvalues of models of one state with known ones.
pub fn compare<'a>(models: impl IntoIterator<Item = &'a LinearModel>, reference: &[Complex<f64>]) -> Vec<Comparison> {
    models.into_iter().map(|model| one(model, reference)).collect()
}

fn one(model: &LinearModel, reference: &[Complex<f64>]) -> Comparison {
    let count = |kind: Kind| model.modes.iter().filter(|mode| mode.kind == kind).count();
    let physical: Vec<Complex<f64>> =
        model.modes.iter().filter(|mode| mode.kind == Kind::Physical).map(|mode| mode.value).collect();
    let cost = &model.cost;
    Comparison {
        method: model.method.clone(),
        chart: model.chart.clone(),
        error: largest_error(&physical, reference).filter(|_| model.is_comparable()),
        physical: physical.len(),
        spurious: count(Kind::Spurious),
        infinite: count(Kind::Infinite),
        off_constraints: cost.off_constraints,
        conditioning: Some(cost.conditioning).filter(|condition| condition.is_finite()),
        size: cost.size,
        assembly_microseconds: 1e6 * cost.assembly_seconds,
        eigen_microseconds: 1e6 * cost.eigen_seconds,
    }
}

/// Each reference value is compared with the nearest of the eigenvalues not yet used.
fn largest_error(found: &[Complex<f64>], reference: &[Complex<f64>]) -> Option<f64> {
    if reference.is_empty() || found.len() != reference.len() {
        return None;
    }
    let largest = reference.iter().map(|value| value.norm()).fold(0.0, f64::max);
    let mut left = found.to_vec();
    let mut worst: f64 = 0.0;
    for known in reference {
        let distance = |value: &Complex<f64>| (value - known).norm();
        let (at, _) = left.iter().enumerate().min_by(|a, b| distance(a.1).total_cmp(&distance(b.1)))?;
        let size = if known.norm() > tolerances::SAME * largest { known.norm() } else { largest };
        let error = distance(&left.swap_remove(at));
        worst = worst.max(if size > 0.0 { error / size } else { error });
    }
    worst.is_finite().then_some(worst)
}
