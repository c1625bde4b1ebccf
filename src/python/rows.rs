//! Output rows in memory that becomes an array of NumPy.

use crate::analysis::{OutputRow, Record};
use numpy::PyArray2;
use numpy::ndarray::Array2;
use pyo3::exceptions::PyValueError;
use pyo3::prelude::*;
use pyo3::types::PyDict;

/// Rows, one after the other.
#[derive(Default)]
struct RowTable {
    columns: usize,
    values: Vec<f64>,
}

impl RowTable {
    fn add(&mut self, row: &[f64]) {
        self.columns = row.len();
        self.values.extend_from_slice(row);
    }

    /// Returns the array whose memory is that of the rows: nothing is copied.
    fn array(self, py: Python<'_>) -> PyResult<Bound<'_, PyArray2<f64>>> {
        let count = self.values.len().checked_div(self.columns).unwrap_or(0);
        let array = Array2::from_shape_vec((count, self.columns), self.values);
        array
            .map(|array| PyArray2::from_owned_array(py, array))
            .map_err(|error| PyValueError::new_err(error.to_string()))
    }
}

/// The rows of a run, with the drift and the energies at each.
#[derive(Default)]
pub struct RunRows {
    values: RowTable,
    drift: RowTable,
    energy: RowTable,
}

impl RunRows {
    pub fn add(&mut self, row: &OutputRow) {
        self.values.add(row.values);
        self.drift.add(&row.drift);
        if let Some(ledger) = row.ledger {
            self.energy.add(&[ledger.kinetic, ledger.potential, ledger.work, ledger.error]);
        }
    }

    /// Adds all rows of a record that keeps them.
    pub fn add_all(&mut self, record: &Record) {
        for (i, (values, &drift)) in record.trajectory.rows.iter().zip(&record.drift_rows).enumerate() {
            self.add(&OutputRow { values, drift, ledger: record.ledger_rows.get(i).copied() });
        }
    }

    /// Puts the arrays into a dictionary; energies are left out where the system defines no potential.
    pub fn put_into(self, found: &Bound<'_, PyDict>) -> PyResult<()> {
        let py = found.py();
        let has_energy = self.energy.columns > 0;
        found.set_item("rows", self.values.array(py)?)?;
        found.set_item("drift", self.drift.array(py)?)?;
        let energy = if has_energy { Some(self.energy.array(py)?) } else { None };
        found.set_item("energy", energy)
    }
}
