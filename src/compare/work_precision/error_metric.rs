//! Quantities of a motion that are compared, and their error metric.

use crate::analysis::{Sizes, scales};
use crate::error::{Result, find};
use crate::simulate::Observation;
use crate::system::{Column, MechanicalSystem, OperatingPoint, Scratch};
use crate::trajectory::{on_pieces, recorded, values};
use serde::{Deserialize, Serialize};

/// The quantities that are compared: outputs, or all coordinates of a system without outputs.
#[derive(Clone, Debug)]
pub struct Watched {
    /// Names and units.
    pub columns: Vec<Column>,
    /// Number of outputs of the system, and indices of the compared ones; none for coordinates.
    outputs: Option<(usize, Vec<usize>)>,
}

impl Watched {
    /// The outputs with these names, all where none is named.
    ///
    /// # Errors
    /// A name that is not an output of the system.
    pub fn new(system: &dyn MechanicalSystem, names: &[String]) -> Result<Watched> {
        let known = recorded(system);
        if known.is_empty() && names.is_empty() {
            let coordinate = |name| Column { name, unit: String::new() };
            return Ok(Watched { columns: system.names().q.into_iter().map(coordinate).collect(), outputs: None });
        }
        let place = |name: &String| find("output", name, known.iter().map(|column| column.name.as_str()));
        let places: Vec<usize> = match names {
            [] => (0..known.len()).collect(),
            names => names.iter().map(place).collect::<Result<_>>()?,
        };
        let columns = places.iter().map(|place| known[*place].clone()).collect();
        Ok(Watched { columns, outputs: Some((known.len(), places)) })
    }

    /// Returns their values at a row of a run.
    pub fn read_row(&self, system: &dyn MechanicalSystem, state: &Observation, scratch: &mut Scratch) -> Vec<f64> {
        on_pieces(state, scratch, |scratch| self.read(system, (state.loaded(), state.works), scratch))
    }

    /// Returns their values at a state with its works.
    pub fn read(&self, system: &dyn MechanicalSystem, at: (OperatingPoint, &[f64]), scratch: &mut Scratch) -> Vec<f64> {
        let Some((count, places)) = &self.outputs else { return at.0.q.to_vec() };
        let all = values(system, at, *count, scratch);
        places.iter().map(|place| all[*place]).collect()
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
