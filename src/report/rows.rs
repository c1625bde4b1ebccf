//! Files with a line for each output row, written as the rows come.

use super::files::{Folder, Stream};
use super::tables::{header, line};
use crate::analysis::{OutputRow, Record};
use crate::error::{Error, Result};
use crate::simulate::Stop;

/// `trajectory.csv`: t, coordinates, velocities, multipliers and outputs at full precision; `drift.csv`: t and the
/// largest |phi|, |phi'| and |phi''|; `energy.csv`: t, kinetic and potential energy, work and the error of the
/// balance, J.
pub struct RowFiles {
    trajectory: Option<Stream>,
    drift: Stream,
    energy: Option<Stream>,
}

impl RowFiles {
    /// The files in a folder: of a trajectory with these headings, if there is one, and of energies, if there are.
    pub fn new(folder: &mut Folder, headings: Option<Vec<&str>>, has_energy: bool) -> Result<Self> {
        let mut file = |name: &str, headings: Vec<&str>| {
            let mut file = folder.stream(name)?;
            file.append(&header(headings)?);
            Ok::<_, Error>(file)
        };
        Ok(RowFiles {
            trajectory: headings.map(|headings| file("trajectory.csv", headings)).transpose()?,
            drift: file("drift.csv", vec!["t", "position", "velocity", "acceleration"])?,
            energy: has_energy
                .then(|| file("energy.csv", vec!["t", "kinetic", "potential", "work", "error"]))
                .transpose()?,
        })
    }

    pub fn add(&mut self, row: &OutputRow) {
        let Some(&t) = row.values.first() else { return };
        self.trajectory.iter_mut().for_each(|file| line(file, row.values));
        let [position, velocity, acceleration] = row.drift;
        line(&mut self.drift, &[t, position, velocity, acceleration]);
        for (file, ledger) in self.energy.iter_mut().zip(&row.ledger) {
            line(file, &[t, ledger.kinetic, ledger.potential, ledger.work, ledger.error]);
        }
    }

    /// Appends all rows of a record that keeps them.
    pub fn add_all(&mut self, record: &Record) {
        for (i, (values, &drift)) in record.trajectory.rows.iter().zip(&record.drift_rows).enumerate() {
            self.add(&OutputRow { values, drift, ledger: record.ledger_rows.get(i).copied() });
        }
    }

    /// Returns the reason to end the run if a file could not be written; [`finish`](Self::finish) says why.
    pub fn stop(&self) -> Option<Stop> {
        let has_failed = [Some(&self.drift), self.trajectory.as_ref(), self.energy.as_ref()]
            .into_iter()
            .flatten()
            .any(Stream::has_failed);
        has_failed.then(|| Stop { reason: "its rows cannot be written".to_string(), hint: String::new() })
    }

    pub fn finish(self) -> Result<()> {
        [self.trajectory, Some(self.drift), self.energy].into_iter().flatten().try_for_each(Stream::finish)
    }
}
