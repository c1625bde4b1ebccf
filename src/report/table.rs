//! Text tables for terminals.

use super::tables;
use crate::error::significant;
use crate::initial::Move;
use crate::system::{Column, MechanicalSystem, OperatingPoint, Scratch};
use serde::{Serialize, Serializer};
use serde_json::{Map, Value};
use std::fmt;

/// Returns values by their names, as files have them.
pub(super) fn named<'n>(names: impl IntoIterator<Item = &'n String>, values: &[f64]) -> Map<String, Value> {
    names.into_iter().zip(values).map(|(name, value)| (name.clone(), Value::from(*value))).collect()
}

#[derive(Clone, Debug, Default)]
pub struct OutputValues {
    columns: Vec<Column>,
    values: Vec<f64>,
}

impl OutputValues {
    pub fn new(columns: Vec<Column>, values: Vec<f64>) -> Self {
        OutputValues { columns, values }
    }

    /// The values of all outputs of a system at a state.
    pub fn at(system: &dyn MechanicalSystem, at: OperatingPoint) -> Self {
        let columns = system.facts().outputs.clone();
        let mut values = vec![0.0; columns.len()];
        system.outputs(at, &mut values, &mut Scratch::default());
        OutputValues { columns, values }
    }

    pub fn values(&self) -> &[f64] {
        &self.values
    }

    /// Returns a line for each of the first `most` with its unit, under a heading; nothing where there is none.
    pub fn text(&self, heading: &str, digits: usize, most: usize) -> String {
        if self.values.is_empty() {
            return String::new();
        }
        let mut table = TextTable::new(&[heading, "", ""]);
        for (column, value) in self.columns.iter().zip(&self.values).take(most) {
            let value = if value.is_finite() { significant(*value, digits) } else { "?".to_string() };
            table.row([column.name.clone(), value, column.unit.clone()]);
        }
        let more = self.values.len().saturating_sub(most);
        let tail = if more > 0 { format!("  and {more} more, which --json lists\n") } else { String::new() };
        format!("\n{table}{tail}")
    }
}

impl Serialize for OutputValues {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        named(self.columns.iter().map(|column| &column.name), &self.values).serialize(serializer)
    }
}

/// Columns under headings; the first and those of text are aligned left, the others right unless all are aligned left.
pub struct TextTable {
    rows: Vec<Vec<String>>,
    left: bool,
    words: Vec<usize>,
}

impl TextTable {
    pub fn new(headings: &[&str]) -> Self {
        TextTable {
            rows: vec![headings.iter().map(|heading| heading.to_string()).collect()],
            left: false,
            words: Vec::new(),
        }
    }

    /// A row for each item.
    pub fn of<T>(columns: &[tables::TableColumn<T>], items: &[T]) -> Self {
        let mut table = TextTable::new(&columns.iter().map(|column| column.0).collect::<Vec<_>>());
        items.iter().for_each(|item| table.row(columns.iter().map(|(_, cell)| cell(item))));
        table
    }

    pub fn left(headings: &[&str]) -> Self {
        TextTable { left: true, ..TextTable::new(headings) }
    }

    /// Aligns a column left, as text.
    pub fn words(mut self, column: usize) -> Self {
        self.words.push(column);
        self
    }

    pub fn row(&mut self, cells: impl IntoIterator<Item = String>) {
        self.rows.push(cells.into_iter().collect());
    }
}

const MOST_MOVES: usize = 10;

/// Returns a line for each of the largest changes of the start.
pub fn moves_text(moves: &[Move]) -> String {
    let line = |Move { name, from, to }: &Move| {
        format!("  moved {name}: {} -> {}\n", significant(*from, 8), significant(*to, 8))
    };
    let more = match moves.len().saturating_sub(MOST_MOVES) {
        0 => String::new(),
        more => format!("  and {more} smaller moves\n"),
    };
    moves.iter().take(MOST_MOVES).map(line).chain([more]).collect()
}

/// Returns a number with its noun in the singular or the plural.
pub fn count(n: usize, noun: &str) -> String {
    match noun.strip_suffix('y') {
        _ if n == 1 => format!("1 {noun}"),
        Some(stem) => format!("{n} {stem}ies"),
        None => format!("{n} {noun}s"),
    }
}

impl fmt::Display for TextTable {
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
                line += &if i == 0 || self.left || self.words.contains(&i) {
                    format!("{gap}{cell}{padding}")
                } else {
                    format!("{gap}{padding}{cell}")
                };
            }
            writeln!(out, "{}", line.trim_end())?;
        }
        Ok(())
    }
}
