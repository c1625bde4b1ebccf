//! Matrices of a model against measured ones, entry by entry.

use super::limit::Limit;
use crate::linearize::Matrix;
use crate::tolerances::{HALF_OF_THE_DIGITS, ROUND_OFF_OF_PHI};
use serde::Serialize;
use std::ops::Range;

/// An entry whose uncertainty is more than this part of it, and of the largest of its row, is not judged. Unit: `[1]`.
/// Why: the force of a stiff hinge near zero turns round over the least perturbation; terms that matter are larger.
/// Test: `what_is_hardly_known_is_not_judged`.
const VAGUE: f64 = 0.03;

/// An output whose largest response is below this many times its round-off is not known to respond at all: its response
/// counts as uncertainty. Unit: `[1]`. Why: round-off differs by decades from one perturbation to another, and the energy
/// of a beam at rest is nothing else. Test: `what_rounding_leaves_of_an_output_condemns_nothing`.
const ABOVE_ROUND_OFF: f64 = 1e3;

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
    pub entry: MatrixEntry,
    /// True if all entries agree within three uncertainties.
    pub is_right: bool,
}

/// An entry of a matrix, by the names of its row and column.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct MatrixEntry {
    /// State or output.
    pub row: String,
    /// State or input.
    pub column: String,
    /// Value of the model.
    pub model: f64,
    /// Measured value.
    pub measured: f64,
}

/// A row of which an entry is not judged.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Unjudged {
    /// State or output.
    pub row: String,
    /// State or input of the first such entry.
    pub column: String,
    /// Why it is not judged.
    pub reason: Reason,
}

/// Why an entry is not judged.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize)]
#[serde(rename_all = "snake_case")]
pub enum Reason {
    /// Its slopes on both sides of the state differ.
    Kink,
    /// Rounding, curvature or a singular state nearby hides it.
    Hidden,
}

/// Measured values and their uncertainties: infinite where the two sides of the state differ, with no number where
/// too few perturbed states exist.
#[derive(Clone, Debug)]
pub struct MatrixLimits {
    pub values: Matrix,
    pub uncertainties: Matrix,
}

impl MatrixLimits {
    /// Zeros to be [`set`](Self::set).
    pub fn new(rows: usize, columns: usize) -> Self {
        MatrixLimits { values: Matrix::zeros(rows, columns), uncertainties: Matrix::zeros(rows, columns) }
    }

    /// Sets an entry.
    pub fn set(&mut self, entry: (usize, usize), limit: Limit) {
        self.values[entry] = limit.value;
        self.uncertainties[entry] = limit.uncertainty;
    }
}

/// [A B; C D] of a model against measured values. Columns begin with the states.
pub struct Comparison {
    model: Matrix,
    measured: MatrixLimits,
    /// Scale of each row and of each column: entries times that of the column over that of the row are 1 at most.
    scales: [Vec<f64>; 2],
    /// Response of each output that is not known to respond, in the scale of the columns; 0 for all other rows.
    unknown: Vec<f64>,
}

impl Comparison {
    /// The comparison of a model with `k` displacements among its `n` states, and the `rate` of its velocities, 1/s.
    pub fn new(model: Matrix, measured: MatrixLimits, k: usize, n: usize, rate: f64) -> Self {
        let state = |i: usize| if i < k { 1.0 } else { rate };
        let largest = |sizes: &mut dyn Iterator<Item = f64>| sizes.filter(|x| x.is_finite()).fold(0.0, f64::max);
        let entries = (0..n).flat_map(|i| (0..n).map(move |j| (i, j)));
        let fastest = largest(&mut entries.map(|(i, j)| (model[(i, j)] * state(j) / state(i)).abs())).max(rate);
        let input = |j: usize| {
            let size = largest(&mut (0..n).map(|i| (model[(i, j)] / state(i)).abs()));
            if size > 0.0 { fastest / size } else { 1.0 }
        };
        let columns: Vec<f64> = (0..model.ncols()).map(|j| if j < n { state(j) } else { input(j) }).collect();
        let mut rows: Vec<f64> = (0..n).map(|i| state(i) * fastest).collect();
        let mut unknown = vec![0.0; n];
        for i in n..model.nrows() {
            let size = largest(&mut (0..model.ncols()).map(|j| (measured.values[(i, j)] * columns[j]).abs()));
            let round_off = largest(&mut (0..model.ncols()).map(|j| measured.uncertainties[(i, j)] * columns[j]));
            let is_known = size > ABOVE_ROUND_OFF * round_off;
            // What is not known is told in the unit of the output.
            rows.push(if is_known { size } else { 1.0 });
            unknown.push(if is_known { 0.0 } else { size });
        }
        Comparison { model, measured, scales: [rows, columns], unknown }
    }

    /// Returns the entry that is farthest off in a block: of those beyond three uncertainties, if there are any; none
    /// where nothing is known of the block. `names` are those of all rows and columns.
    pub fn worst(&self, rows: Range<usize>, columns: Range<usize>, names: [&[String]; 2]) -> Option<Deviation> {
        let mut worst: Option<Deviation> = None;
        let mut largest_uncertainty = 0.0f64;
        for (i, j) in rows.flat_map(|i| columns.clone().map(move |j| (i, j))) {
            let Ok(deviation) = self.deviation(i, j, names) else { continue };
            largest_uncertainty = largest_uncertainty.max(deviation.relative_uncertainty);
            let is_worse =
                |other: &Deviation| (!deviation.is_right, deviation.relative) > (!other.is_right, other.relative);
            if worst.as_ref().is_none_or(is_worse) {
                worst = Some(deviation);
            }
        }
        worst.map(|worst| Deviation { relative_uncertainty: largest_uncertainty, ..worst })
    }

    /// Returns the rows of which an entry is not judged, with the first one of each. `names` are as above.
    pub fn unjudged(&self, names: [&[String]; 2]) -> Vec<Unjudged> {
        let [rows, columns] = names;
        let first = |i: usize| {
            let mut entries = columns.iter().enumerate();
            let (column, reason) = entries.find_map(|(j, name)| Some((name, self.deviation(i, j, names).err()?)))?;
            Some(Unjudged { row: rows[i].clone(), column: column.clone(), reason })
        };
        (0..rows.len()).filter_map(first).collect()
    }

    /// Returns the deviation of an entry with its own uncertainty, or why it is not judged.
    fn deviation(&self, i: usize, j: usize, names: [&[String]; 2]) -> Result<Deviation, Reason> {
        let scale = self.scales[1][j] / self.scales[0][i];
        let model = self.model[(i, j)];
        let measured = self.measured.values[(i, j)];
        // The entry of the model has round-off, too, as its constraints may nearly depend on each other.
        let round_off = ROUND_OFF_OF_PHI / scale;
        let uncertainty = self.measured.uncertainties[(i, j)] + round_off + self.unknown[i] / self.scales[1][j];
        let is_vague = uncertainty > VAGUE * model.abs().max(measured.abs());
        if uncertainty.is_infinite() && measured.is_finite() {
            return Err(Reason::Kink);
        }
        if uncertainty.is_infinite() || is_vague && uncertainty * scale > VAGUE {
            return Err(Reason::Hidden);
        }
        let difference = (model - measured).abs();
        let relative = if difference.is_nan() { 0.0 } else { difference * scale };
        // The usual three.
        let is_near = difference <= 3.0 * uncertainty || difference <= HALF_OF_THE_DIGITS * model.abs();
        let entry = MatrixEntry { row: names[0][i].clone(), column: names[1][j].clone(), model, measured };
        let relative_uncertainty = uncertainty * scale;
        let is_right = difference.is_nan() || is_near;
        Ok(Deviation { difference, uncertainty, relative, relative_uncertainty, entry, is_right })
    }
}

#[cfg(test)]
mod tests {
    use super::{Comparison, Deviation, MatrixLimits, Reason, Unjudged};
    use crate::linearize::Matrix;

    /// x'' = -4 x with one output, whose row is compared.
    fn output(model: [f64; 2], measured: [f64; 2], uncertainty: f64) -> (Option<Deviation>, Vec<Unjudged>) {
        let whole = |row: [f64; 2]| Matrix::from_row_slice(3, 2, &[0.0, 1.0, -4.0, 0.0, row[0], row[1]]);
        let uncertainties = Matrix::from_fn(3, 2, |i, _| if i == 2 { uncertainty } else { 1e-12 });
        let limits = MatrixLimits { values: whole(measured), uncertainties };
        let rows = ["x", "x'", "y"].map(str::to_string);
        let comparison = Comparison::new(whole(model), limits, 1, 2, 2.0);
        let names: [&[String]; 2] = [&rows, &rows[..2]];
        (comparison.worst(2..3, 0..2, names), comparison.unjudged(names))
    }

    #[test]
    fn what_is_hardly_known_is_not_judged() {
        // A small entry beside a large one is judged by its own uncertainty.
        assert!(output([100.0, 0.0], [100.0, 0.0], 0.02).0.unwrap().is_right);
        let small = output([100.0, 1.0], [100.0, 0.0], 0.02).0.unwrap();
        assert!(!small.is_right && small.entry.column == "x'" && small.difference == 1.0, "{small:?}");
        let named = |reason| vec![Unjudged { row: "y".to_string(), column: "x".to_string(), reason }];
        assert_eq!(output([2e10, 2e10], [1e10, 1e10], 2e10), (None, named(Reason::Hidden)));
        assert_eq!(output([1.0, 1.0], [1.0, 1.0], f64::INFINITY), (None, named(Reason::Kink)));
    }

    #[test]
    fn what_rounding_leaves_of_an_output_condemns_nothing() {
        let found = output([0.0, 0.0], [4e-10, 1e-10], 1e-12).0.unwrap();
        assert!(found.is_right && found.relative < 1e-9, "{found:?}");
        let spoilt = output([0.0, 1e-5], [4e-10, 1e-10], 1e-12).0.unwrap();
        assert!(!spoilt.is_right && (spoilt.difference - 1e-5).abs() < 1e-9, "{spoilt:?}");
    }
}
