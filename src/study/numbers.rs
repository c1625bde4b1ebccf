//! A table of numbers from a file of comma-separated values.

use crate::error::{Error, Result};

/// Headings and rows.
pub struct Numbers {
    /// Headings of the columns.
    pub headings: Vec<String>,
    /// A number for each heading.
    pub rows: Vec<Vec<f64>>,
}

impl Numbers {
    /// Reads a table. The caller adds the remedy of an error.
    ///
    /// # Errors
    /// Text that is no table, and cells that are no finite numbers.
    pub fn parse(text: &str) -> Result<Numbers> {
        let wrong = |error: csv::Error| Error::input(format!("this is no table: {error}"));
        let mut reader = csv::ReaderBuilder::new().trim(csv::Trim::All).from_reader(text.as_bytes());
        let headings = reader.headers().map_err(wrong)?.iter().map(str::to_string).collect();
        let mut rows = Vec::new();
        for (line, record) in reader.records().enumerate() {
            let number = |cell: &str| match cell.parse::<f64>() {
                Ok(value) if value.is_finite() => Ok(value),
                _ => Err(Error::input(format!("row {} has `{cell}`, which is no number", line + 1))),
            };
            rows.push(record.map_err(wrong)?.iter().map(number).collect::<Result<Vec<f64>>>()?);
        }
        Ok(Numbers { headings, rows })
    }
}
