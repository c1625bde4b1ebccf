//! Least, greatest and mean values of the outputs over the rows of a run.

use crate::system::Column;
use serde::Serialize;

/// Extremes of one output over the rows where it has a value.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Extremes {
    /// Name of the output.
    #[serde(skip)]
    pub name: String,
    /// Its unit; empty where it is not known.
    pub unit: String,
    /// Least value; none where the output has no value at any row.
    pub min: Option<f64>,
    /// Time of the first row with the least value, s.
    pub t_min: Option<f64>,
    /// Greatest value.
    pub max: Option<f64>,
    /// Time of the first row with the greatest value, s.
    pub t_max: Option<f64>,
    /// Root of the mean square over time, of a curve that is linear between the rows.
    pub rms: Option<f64>,
    /// The last row with a value.
    #[serde(skip)]
    last: Option<(f64, f64)>,
    /// Integral of the square, and the time it covers, s.
    #[serde(skip)]
    squares: (f64, f64),
}

impl Extremes {
    /// Before the first row.
    pub fn of(column: &Column) -> Self {
        let name = column.name.clone();
        let unit = column.unit.clone();
        Self { name, unit, min: None, t_min: None, max: None, t_max: None, rms: None, last: None, squares: (0.0, 0.0) }
    }

    /// Adds the value at a row. One that is not finite ends the interval before it.
    pub fn add(&mut self, t: f64, value: f64) {
        if !value.is_finite() {
            self.last = None;
            return;
        }
        if self.min.is_none_or(|min| value < min) {
            self.min = Some(value);
            self.t_min = Some(t);
        }
        if self.max.is_none_or(|max| value > max) {
            self.max = Some(value);
            self.t_max = Some(t);
        }
        if let Some((before, from)) = self.last {
            self.squares.0 += (t - before) * (from * from + from * value + value * value) / 3.0;
            self.squares.1 += t - before;
        }
        self.last = Some((t, value));
        let (sum, covered) = self.squares;
        self.rms = Some(if covered > 0.0 { (sum / covered).sqrt() } else { value.abs() });
    }
}
