//! Comma-separated tables that open in Python, MATLAB and a spreadsheet.

use crate::error::{Error, Result};
use crate::measure::Record;
use crate::trajectory::Trajectory;

/// `t`, coordinates, velocities, multipliers, outputs: one row an output time, at full precision.
pub fn trajectory_table(trajectory: &Trajectory) -> Result<Vec<u8>> {
    write(trajectory.headings(), trajectory.rows.iter().map(Vec::as_slice))
}

/// `t` and the largest |phi|, |phi'| and |phi''| at the output times.
pub fn drift_table(record: &Record) -> Result<Vec<u8>> {
    let times = record.trajectory.times();
    let rows: Vec<[f64; 4]> = times.zip(&record.drift_rows).map(|(t, [p, v, a])| [t, *p, *v, *a]).collect();
    write(vec!["t", "position", "velocity", "acceleration"], rows.iter().map(<[f64; 4]>::as_slice))
}

/// `t`, kinetic and potential energy, work put in and the error of the balance at the output times, J.
pub fn energy_table(record: &Record) -> Result<Vec<u8>> {
    let times = record.trajectory.times();
    let rows: Vec<[f64; 5]> = times
        .zip(&record.ledger_rows)
        .map(|(t, ledger)| [t, ledger.kinetic, ledger.potential, ledger.work, ledger.error])
        .collect();
    write(vec!["t", "kinetic", "potential", "work", "error"], rows.iter().map(<[f64; 5]>::as_slice))
}

fn write<'a>(headings: Vec<&str>, rows: impl Iterator<Item = &'a [f64]>) -> Result<Vec<u8>> {
    let failed = |error: csv::Error| Error::input(format!("cannot write the table: {error}"));
    let mut writer = csv::Writer::from_writer(Vec::new());
    writer.write_record(&headings).map_err(failed)?;
    for row in rows {
        writer.write_record(row.iter().map(f64::to_string)).map_err(failed)?;
    }
    writer.into_inner().map_err(|error| Error::input(format!("cannot write the table: {error}")))
}
