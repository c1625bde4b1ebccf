//! Text tables for terminals.

use std::fmt;

/// Columns under headings; the first and those of text are aligned left, the others right unless all are aligned left.
pub struct Table {
    rows: Vec<Vec<String>>,
    left: bool,
    words: Vec<usize>,
}

impl Table {
    /// A table of numbers.
    pub fn new(headings: &[&str]) -> Self {
        Table {
            rows: vec![headings.iter().map(|heading| heading.to_string()).collect()],
            left: false,
            words: Vec::new(),
        }
    }

    /// A table of text.
    pub fn left(headings: &[&str]) -> Self {
        Table { left: true, ..Table::new(headings) }
    }

    /// Aligns a column left, as text.
    pub fn words(mut self, column: usize) -> Self {
        self.words.push(column);
        self
    }

    /// Adds a row.
    pub fn row(&mut self, cells: impl IntoIterator<Item = String>) {
        self.rows.push(cells.into_iter().collect());
    }
}

impl fmt::Display for Table {
    fn fmt(&self, out: &mut fmt::Formatter<'_>) -> fmt::Result {
        let columns = self.rows.iter().map(Vec::len).max().unwrap_or(0);
        let width = |column: usize| {
            self.rows.iter().filter_map(|row| row.get(column)).map(|cell| cell.chars().count()).max().unwrap_or(0)
        };
        let widths: Vec<usize> = (0..columns).map(width).collect();
        for row in &self.rows {
            let mut line = String::from("  ");
            for (i, (cell, &width)) in row.iter().zip(&widths).enumerate() {
                let padding = " ".repeat(width - cell.chars().count());
                let gap = if i == 0 { "" } else { "  " };
                line += &match i == 0 || self.left || self.words.contains(&i) {
                    true => format!("{gap}{cell}{padding}"),
                    false => format!("{gap}{padding}{cell}"),
                };
            }
            writeln!(out, "{}", line.trim_end())?;
        }
        Ok(())
    }
}

/// A number of velocities in words.
pub fn velocities(count: usize) -> String {
    match count {
        1 => "1 velocity".to_string(),
        _ => format!("{count} velocities"),
    }
}
