//! `study.json`, `study.csv`, `study.npz`, and the text on a study.

use super::study_figure::{coordinates_figure, scatter_figure, study_figure};
use super::table::count;
use super::tables::{cell, table};
use super::{Answer, Folder, TextTable};
use crate::error::{Result, significant};
#[cfg(feature = "npz")]
use crate::files::Array;
use crate::study::variants::{StudyRow, StudyTable};
use serde::Serialize;
use serde_json::{Value, json};

pub struct StudyAnswer<'a> {
    /// The rows that are there.
    pub table: &'a StudyTable,
    /// Number of the rows that were asked for.
    pub asked: usize,
    /// False where only the tables are written.
    pub has_figures: bool,
}

/// Reasons of failures that are listed.
const REASONS: usize = 5;

impl Answer for StudyAnswer<'_> {
    fn json(&self) -> impl Serialize {
        let StudyTable { identity, again, rows, .. } = self.table;
        let range = |i: usize| {
            let place = |(row, value): (usize, f64)| json!({ "row": row, "value": value });
            let column = &self.table.columns[i];
            let ends = self.ends(i).map(|end| end.map(place));
            json!({ "name": column.name, "unit": column.unit, "min": ends[0], "max": ends[1] })
        };
        json!({
            "study": identity,
            "again": again,
            "status": if rows.len() < self.asked { "unfinished" } else { "completed" },
            "rows": rows.len(),
            "failed": self.table.failed(),
            "recorded": self.recorded().map(range).collect::<Vec<Value>>(),
        })
    }

    fn text(&self) -> String {
        let scene = self.table.identity.get("scene").and_then(Value::as_str).unwrap_or_default();
        let done = self.table.rows.len();
        let part =
            if self.asked < self.table.count { format!(" of {} in all", self.table.count) } else { String::new() };
        let mut text = format!("{scene}: {done} of {}{part}\n", count(self.asked, "variant"));
        for (reason, rows) in self.failures().iter().take(REASONS) {
            text += &format!("  FAILED {}, the first in row {}: {reason}\n", count(rows.len(), "variant"), rows[0]);
        }
        let more = self.failures().len().saturating_sub(REASONS);
        if more > 0 {
            text += &format!("  and {} more, which study.csv lists\n", count(more, "reason"));
        }
        text + "\n" + &self.ranges()
    }

    fn write(&self, folder: &mut Folder, stem: &str) -> Result<()> {
        let row = |(place, StudyRow { values, failure }): (&usize, &StudyRow)| {
            let numbers = values.iter().map(|value| cell(*value));
            [place.to_string()].into_iter().chain(numbers).chain([failure.clone()]).collect()
        };
        folder.table(stem, &table(self.table.headings(), self.table.rows.iter().map(row))?)?;
        #[cfg(feature = "npz")]
        folder.write(&format!("{stem}.npz"), &crate::files::npz::write(&self.arrays())?)?;
        if self.has_figures {
            folder.figure(stem, study_figure(self.table))?;
            folder.figure(&format!("{stem}-scatter"), scatter_figure(self.table))?;
            folder.figure(&format!("{stem}-parallel"), coordinates_figure(self.table))?;
        }
        Ok(())
    }
}

impl StudyAnswer<'_> {
    fn recorded(&self) -> impl Iterator<Item = usize> {
        self.table.parameters..self.table.columns.len()
    }

    /// Returns the rows with the least and the greatest value of a column, with the values.
    fn ends(&self, column: usize) -> [Option<(usize, f64)>; 2] {
        let all = || self.table.rows.iter().map(|(row, found)| (*row, found.values[column]));
        let defined = || all().filter(|(_, value)| value.is_finite());
        [defined().min_by(|a, b| a.1.total_cmp(&b.1)), defined().rev().max_by(|a, b| a.1.total_cmp(&b.1))]
    }

    /// Returns the reasons of failures without their numbers, with their rows, the most frequent first.
    fn failures(&self) -> Vec<(&str, Vec<usize>)> {
        let mut found: Vec<(String, &str, Vec<usize>)> = Vec::new();
        for (row, StudyRow { failure, .. }) in self.table.rows.iter().filter(|(_, row)| !row.failure.is_empty()) {
            let kind: String = failure.chars().filter(|c| !c.is_ascii_digit()).collect();
            match found.iter_mut().find(|(known, ..)| *known == kind) {
                Some((_, _, rows)) => rows.push(*row),
                None => found.push((kind, failure, vec![*row])),
            }
        }
        found.sort_by_key(|(_, _, rows)| std::cmp::Reverse(rows.len()));
        found.into_iter().map(|(_, reason, rows)| (reason, rows)).collect()
    }

    fn ranges(&self) -> String {
        let mut table = TextTable::new(&["recorded", "", "min", "in row", "max", "in row"]).words(1);
        for i in self.recorded() {
            let column = &self.table.columns[i];
            let cells = self.ends(i).into_iter().flat_map(|end| match end {
                Some((row, value)) => [significant(value, 6), row.to_string()],
                None => ["?".to_string(), String::new()],
            });
            table.row([column.name.clone(), column.unit.clone()].into_iter().chain(cells));
        }
        table.to_string()
    }

    /// Returns the table as arrays, with what the rows depend on as JSON.
    #[cfg(feature = "npz")]
    fn arrays(&self) -> Vec<(&'static str, Array)> {
        let StudyTable { identity, columns, rows, .. } = self.table;
        let values = rows.values().flat_map(|row| row.values.iter().copied()).collect();
        let places: Vec<f64> = rows.keys().map(|row| *row as f64).collect();
        vec![
            ("columns", Array::Texts(columns.iter().map(|column| column.name.clone()).collect())),
            ("units", Array::Texts(columns.iter().map(|column| column.unit.clone()).collect())),
            ("row", Array::vector(&places)),
            ("values", Array::Real { shape: vec![rows.len(), columns.len()], values }),
            ("failure", Array::Texts(rows.values().map(|row| row.failure.clone()).collect())),
            ("study", Array::Text(Value::Object(identity.clone()).to_string())),
        ]
    }
}
