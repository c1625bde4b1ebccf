//! Matrices of a model against measured ones, entry by entry.

use super::limit::Limit;
use crate::linearize::Matrix;
use crate::tolerances::ROUND_OFF_OF_PHI;
use serde::Serialize;
use std::ops::Range;

/// A measured entry that is off by more of its uncertainty is wrong. Unit: `[uncertainties]`. Why: the usual three.
/// Test: `spoilt_terms_are_condemned_with_their_size`.
const BEYOND_UNCERTAINTY: f64 = 3.0;

/// An entry whose uncertainty is more than this part of it is not judged. Unit: `[1]`. Why: the force of a stiff hinge
/// turns round over the least perturbation, and the energy of a beam at rest is round-off.
const VAGUE: f64 = 0.01;

/// An entry that is right to this is not wrong. Unit: `[1]`. Why: no term is missing whose part is below the rounding of
/// the perturbed states.
const SAME_ENTRY: f64 = 1e-7;

/// The entry of a matrix of the model that is farthest from what was measured.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Deviation {
    /// |model - measured| of the entry, in its unit.
    pub difference: f64,
    /// Uncertainty of the measured entry, in its unit.
    pub uncertainty: f64,
    /// The same difference as a part of the largest entry, with states and inputs scaled to one unit.
    pub relative: f64,
    /// The largest uncertainty of all entries in that scale.
    pub relative_uncertainty: f64,
    /// The entry.
    pub entry: Entry,
    /// True if all entries agree within three uncertainties.
    pub is_right: bool,
}

/// An entry of a matrix, by the names of its row and column.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Entry {
    /// State or output.
    pub row: String,
    /// State or input.
    pub column: String,
    /// Value of the model.
    pub model: f64,
    /// Measured value.
    pub measured: f64,
}

/// Measured values and their uncertainties.
#[derive(Clone, Debug)]
pub struct Limits {
    pub values: Matrix,
    pub uncertainties: Matrix,
}

impl Limits {
    /// Zeros to be [`set`](Self::set).
    pub fn new(rows: usize, columns: usize) -> Self {
        Limits { values: Matrix::zeros(rows, columns), uncertainties: Matrix::zeros(rows, columns) }
    }

    /// Sets an entry.
    pub fn set(&mut self, place: (usize, usize), found: Limit) {
        self.values[place] = found.value;
        self.uncertainties[place] = found.uncertainty;
    }
}

/// [A B; C D] of a model against measured values. Columns begin with the states.
pub struct Comparison {
    model: Matrix,
    measured: Limits,
    /// Scale of each row and of each column: entries times that of the column over that of the row are 1 at most.
    scales: [Vec<f64>; 2],
}

impl Comparison {
    /// The comparison of a model with `k` displacements among its `n` states, and the `rate` of its velocities, 1/s.
    pub fn new(model: Matrix, measured: Limits, (k, n): (usize, usize), rate: f64) -> Self {
        let state = |i: usize| if i < k { 1.0 } else { rate };
        let largest = |found: &mut dyn Iterator<Item = f64>| found.filter(|x| x.is_finite()).fold(0.0, f64::max);
        let scaled = |i: usize, j: usize| (model[(i, j)] * state(j) / state(i)).abs();
        let fastest = largest(&mut (0..n).flat_map(|i| (0..n).map(move |j| (i, j))).map(|(i, j)| scaled(i, j)));
        let fastest = fastest.max(rate);
        let input = |j: usize| {
            let size = largest(&mut (0..n).map(|i| (model[(i, j)] / state(i)).abs()));
            if size > 0.0 { fastest / size } else { 1.0 }
        };
        let columns: Vec<f64> = (0..model.ncols()).map(|j| if j < n { state(j) } else { input(j) }).collect();
        let output = |i: usize| {
            let size = largest(&mut (0..model.ncols()).map(|j| (model[(i, j)] * columns[j]).abs()));
            // What is below its own round-off is measured in the unit of the output.
            let known = largest(&mut (0..model.ncols()).map(|j| measured.uncertainties[(i, j)] * columns[j]));
            if size > 1e3 * known { size } else { 1.0 }
        };
        let rows = (0..model.nrows()).map(|i| if i < n { state(i) * fastest } else { output(i) }).collect();
        Comparison { model, measured, scales: [rows, columns] }
    }

    /// Returns the entry that is farthest off in a block: of those beyond three uncertainties, if there are any; none
    /// where the block is empty. `names` are those of all rows and columns.
    pub fn worst(&self, rows: Range<usize>, columns: Range<usize>, names: [&[String]; 2]) -> Option<Deviation> {
        let mut worst: Option<Deviation> = None;
        let mut largest_uncertainty = 0.0f64;
        for (i, j) in rows.flat_map(|i| columns.clone().map(move |j| (i, j))) {
            let scale = self.scales[1][j] / self.scales[0][i];
            let model = self.model[(i, j)];
            let measured = self.measured.values[(i, j)];
            // The entry of the model has round-off, too, as its constraints may nearly depend on each other.
            if self.measured.uncertainties[(i, j)].is_infinite() {
                continue;
            }
            let uncertainty = self.measured.uncertainties[(i, j)] + ROUND_OFF_OF_PHI / scale;
            let difference = (model - measured).abs();
            // Below are entries that rounding of the state makes up, or that change over the least perturbation.
            let is_vague = uncertainty > VAGUE * model.abs().max(measured.abs());
            let is_near = difference <= BEYOND_UNCERTAINTY * uncertainty || difference <= SAME_ENTRY * model.abs();
            let is_right = difference.is_nan() || is_vague || is_near;
            largest_uncertainty = largest_uncertainty.max(uncertainty * scale);
            let relative = if difference.is_nan() { 0.0 } else { difference * scale };
            let is_worse = |other: &Deviation| (!is_right, relative) > (!other.is_right, other.relative);
            if worst.as_ref().is_none_or(is_worse) {
                let entry = Entry { row: names[0][i].clone(), column: names[1][j].clone(), model, measured };
                worst =
                    Some(Deviation { difference, uncertainty, relative, relative_uncertainty: 0.0, entry, is_right });
            }
        }
        worst.map(|found| Deviation { relative_uncertainty: largest_uncertainty, ..found })
    }
}
