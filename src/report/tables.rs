//! Comma-separated tables for Python, MATLAB and spreadsheets.

use super::figures::MOST_COORDINATES;
use crate::error::{Error, Result};
use crate::files::Array;
use crate::study::ErrorBars;
use crate::sweep::{Point, Sweep};
use crate::system::Names;
use crate::trajectory::Trajectory;
use std::borrow::Borrow;
use std::fmt;
use std::io::Write;

/// Returns a trajectory as arrays for Python and MATLAB: `rows`, a matrix, and the names of its `columns`; NaN where there
/// is no value.
pub fn trajectory_arrays(trajectory: &Trajectory, bars: Option<&ErrorBars>) -> Vec<(&'static str, Array)> {
    let headings = trajectory.headings();
    let values = trajectory.rows.iter().flatten().map(|value| if value.is_finite() { *value } else { f64::NAN });
    let rows = Array::Real { shape: vec![trajectory.rows.len(), headings.len()], values: values.collect() };
    let mut arrays = vec![("columns", Array::Texts(headings.into_iter().map(String::from).collect())), ("rows", rows)];
    arrays.extend(bars.into_iter().flat_map(|bars| error_arrays(bars, trajectory.rows.len())));
    arrays
}

/// The error bars at each row, with the names of their quantities; NaN at rows that the companion did not reach.
fn error_arrays(bars: &ErrorBars, rows: usize) -> [(&'static str, Array); 2] {
    let names = bars.outputs.iter().map(|(name, _)| name.clone()).collect();
    let row = |row: usize| bars.outputs.iter().map(move |(_, bar)| bar.rows.get(row).copied().unwrap_or(f64::NAN));
    let values = (0..rows).flat_map(row).collect();
    let shape = vec![rows, bars.outputs.len()];
    [("error_columns", Array::Texts(names)), ("error_rows", Array::Real { shape, values })]
}

/// Returns the parameter by its name, coordinates, multipliers, outputs: one row per value that was reached.
pub fn sweep_table(sweep: &Sweep) -> Result<Vec<u8>> {
    let Names { q, lambda, .. } = &sweep.names;
    let outputs = sweep.outputs.iter().map(|output| output.name.as_str());
    let parameter = heading(&sweep.range.parameter, sweep.outputs.iter().map(|output| output.name.as_str()));
    let own = [parameter.as_str()].into_iter().chain(q.iter().chain(lambda).map(String::as_str));
    let mut all = header(own.chain(outputs).collect())?;
    for point in &sweep.points {
        line(&mut all, &[&[point.value], &point.q[..], &point.lambda, &point.outputs].concat());
    }
    Ok(all)
}

/// Returns name and unit of what is shown: the outputs, or the first coordinates where the scene names none.
pub(super) fn watched(sweep: &Sweep) -> Vec<(&str, &str)> {
    match sweep.outputs.as_slice() {
        [] => sweep.names.q.iter().take(MOST_COORDINATES).map(|name| (name.as_str(), "m, rad")).collect(),
        outputs => outputs.iter().map(|output| (output.name.as_str(), output.unit.as_str())).collect(),
    }
}

/// Returns the values of these at a state.
pub(super) fn shown<'a>(sweep: &Sweep, point: &'a Point) -> &'a [f64] {
    if sweep.outputs.is_empty() { &point.q } else { &point.outputs }
}

/// Returns the heading of a parameter: `parameters.NAME` where another column has its name.
pub fn heading<'a>(parameter: &str, mut others: impl Iterator<Item = &'a str>) -> String {
    if others.any(|other| other == parameter) { format!("parameters.{parameter}") } else { parameter.to_string() }
}

pub fn cell(value: f64) -> String {
    let mut text = Vec::new();
    push(&mut text, value);
    text.into_iter().map(char::from).collect()
}

/// Writes a number at full precision with the fewest digits, with an exponent where zeros alone would fill the cell;
/// nothing where there is no value, such as of an output outside its domain.
fn push(out: &mut impl Write, value: f64) {
    if value.is_finite() {
        let mut buffer = zmij::Buffer::new();
        let digits = buffer.format_finite(value);
        // Memory has no errors, and a stream keeps its first one.
        let _ = out.write_all(digits.strip_suffix(".0").unwrap_or(digits).as_bytes());
    }
}

pub fn header(headings: Vec<&str>) -> Result<Vec<u8>> {
    table(headings.into_iter().map(String::from), std::iter::empty())
}

/// Writes a line of numbers with commas between them.
pub fn line(out: &mut impl Write, row: &[f64]) {
    for (i, value) in row.iter().enumerate() {
        if i > 0 {
            let _ = out.write_all(b",");
        }
        push(out, *value);
    }
    let _ = out.write_all(b"\n");
}

fn failed(error: &dyn fmt::Display) -> Error {
    Error::input(format!("cannot write the table: {error}"))
}

pub fn table(headings: impl Iterator<Item = String>, rows: impl Iterator<Item = Vec<String>>) -> Result<Vec<u8>> {
    let mut writer = csv::Writer::from_writer(Vec::new());
    writer.write_record(headings).map_err(|error| failed(&error))?;
    for row in rows {
        writer.write_record(row).map_err(|error| failed(&error))?;
    }
    writer.into_inner().map_err(|error| failed(&error))
}

/// A column: its heading, and the cell of an item.
pub type TableColumn<T> = (&'static str, fn(&T) -> String);

pub fn by_columns<T>(columns: &[TableColumn<T>], items: impl Iterator<Item = impl Borrow<T>>) -> Result<Vec<u8>> {
    let row = |item| columns.iter().map(|(_, cell)| cell(Borrow::borrow(&item))).collect();
    table(columns.iter().map(|(heading, _)| heading.to_string()), items.map(row))
}

/// Returns a number as tables have it; an empty cell where there is none.
pub fn optional(value: Option<f64>) -> String {
    value.map_or(String::new(), cell)
}
