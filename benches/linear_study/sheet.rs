//! Tables in Markdown, printed as they are made.

use std::fmt::Write;

pub struct Sheet(String);

impl Sheet {
    pub fn new(about: &str) -> Self {
        println!("{about}");
        Sheet(about.to_string())
    }

    pub fn text(&self) -> &str {
        &self.0
    }

    fn add(&mut self, line: &str) {
        println!("{line}");
        // Writing to a string does not fail.
        let _ = writeln!(self.0, "{line}");
    }

    /// A heading and a table, its cells padded to be read as text as well.
    pub fn table(&mut self, title: &str, headings: &[&str], rows: &[Vec<String>]) {
        let width = |j: usize| {
            let cells = rows.iter().filter_map(|row| row.get(j)).map(|cell| cell.chars().count());
            cells.chain([headings[j].chars().count(), 3]).max().unwrap_or(3)
        };
        let widths: Vec<usize> = (0..headings.len()).map(width).collect();
        let line = |cells: Vec<String>| {
            let padded: Vec<String> =
                cells.iter().zip(&widths).map(|(cell, width)| format!("{cell:<width$}")).collect();
            format!("| {} |", padded.join(" | "))
        };
        self.add(&format!("\n## {title}\n"));
        self.add(&line(headings.iter().map(|heading| heading.to_string()).collect()));
        self.add(&line(widths.iter().map(|width| "-".repeat(*width)).collect()));
        rows.iter().for_each(|row| self.add(&line(row.clone())));
    }
}

/// `3e-12`, or `-` for none.
pub fn power(value: Option<f64>) -> String {
    value.map_or("-".to_string(), |value| if value == 0.0 { "0".to_string() } else { format!("{value:.0e}") })
}
