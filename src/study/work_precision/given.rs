//! Tables of reference values from files.

use crate::error::{Error, Result, suggest};
use crate::simulate::Span;
use crate::study::numbers::Numbers;
use crate::study::watched::Watched;
use std::path::Path;

/// Values from a file: columns by name, one of them `t`.
#[derive(Clone, Debug)]
pub struct GivenValues {
    /// File name.
    pub name: String,
    headings: Vec<String>,
    rows: Vec<Vec<f64>>,
}

const HINT: &str =
    "give a table of comma-separated values with headings, as trajectory.csv is one: t, then quantities by name";

impl GivenValues {
    /// Reads a table with headings like `trajectory.csv`: `t` and quantities by name.
    ///
    /// # Errors
    /// A file that cannot be read or is no such table.
    pub fn read(path: &Path) -> Result<GivenValues> {
        let text = crate::files::read_text(path).map_err(|error| Error::file(path, error))?;
        GivenValues::parse(&path.display().to_string(), &text).map_err(|error| error.in_file(path))
    }

    /// Reads the same from text.
    ///
    /// # Errors
    /// Text that is no table with a column `t`.
    pub fn parse(name: &str, text: &str) -> Result<GivenValues> {
        let Numbers { headings, rows } = Numbers::parse(text).map_err(|error| error.hint(HINT))?;
        if headings.iter().all(|heading| heading != "t") {
            return Err(Error::input("there is no column `t`").hint(HINT));
        }
        Ok(GivenValues { name: name.to_string(), headings, rows })
    }

    /// Returns the names of its quantities.
    pub fn names(&self) -> impl Iterator<Item = &str> {
        self.headings.iter().map(String::as_str).filter(|heading| *heading != "t")
    }

    /// Returns the largest number of equal parts of the time, at most `limit`, for which the file has a row at the end
    /// of each part.
    ///
    /// # Errors
    /// A file without a row at the end.
    pub fn parts(&self, start: f64, end: f64, limit: usize) -> Result<usize> {
        let has = |parts: usize| {
            (1..=parts).all(|k| self.row(start + (end - start) * k as f64 / parts as f64, end - start).is_some())
        };
        (1..=limit).rev().find(|parts| has(*parts)).ok_or_else(|| {
            Error::input(format!("`{}` has no values at the end, t = {end} s", self.name))
                .under("--reference")
                .hint("give a file with a row at the end time, or --until a time that it has")
        })
    }

    fn row(&self, t: f64, duration: f64) -> Option<&[f64]> {
        let time = self.headings.iter().position(|heading| heading == "t")?;
        let row = self.rows.iter().find(|row| (row[time] - t).abs() <= 1e-9 * duration)?;
        Some(row)
    }

    /// Returns the watched quantities at the output times of `span` after its start.
    pub(super) fn rows_at(&self, watched: &Watched, span: Span) -> Result<Vec<Vec<f64>>> {
        let index = |name: &String| {
            self.headings.iter().position(|heading| heading == name).ok_or_else(|| {
                let known = self.headings.iter().map(String::as_str);
                Error::input(format!("`{}` has no column `{name}`", self.name))
                    .under("--reference")
                    .hint(format!("{}; or name the quantities to compare by --outputs", suggest(name, known)))
            })
        };
        let names = watched.columns.iter().map(|column| &column.name);
        let indices: Vec<usize> = names.map(index).collect::<Result<_>>()?;
        let parts = ((span.end - span.start) / span.output_step).round() as usize;
        let duration = span.end - span.start;
        let at = |k: usize| self.row(span.start + duration * k as f64 / parts as f64, duration);
        let values = |row: &[f64]| indices.iter().map(|index| row[*index]).collect();
        Ok((1..=parts).filter_map(at).map(values).collect())
    }
}
