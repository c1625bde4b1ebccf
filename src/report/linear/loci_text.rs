//! Eigenvalues at many states as a person reads them in a terminal.

use super::loci_file::{Extent, FailureFile, LociSummary, ModeSummary, Stretch};
use crate::error::significant;
use crate::linearize::Kind;
use crate::report::Table;
use crate::tolerances::report as tolerances;

/// Lines of the table; the files have all modes.
const MOST_LINES: usize = 30;
/// Stretches of a mode that are listed.
const MOST_STRETCHES: usize = 4;

impl LociSummary {
    /// Method, chart and states, then the modes.
    pub fn text(&self) -> String {
        let along = &self.along;
        let unit = if along.unit.is_empty() { String::new() } else { format!(" {}", along.unit) };
        let ends = [along.from, along.to].map(|end| significant(end, 9));
        let mut text = format!(
            "{}: eigenvalues at {} of {} states, {} from {} to {}{unit}, by {}, chart {}\n  {}\n",
            self.scene,
            self.reached,
            along.count,
            along.name,
            ends[0],
            ends[1],
            self.method,
            self.chart,
            self.meaning()
        );
        for (first, last, count) in self.gaps() {
            let place = if count == 1 { significant(first.at, 9) } else { span(first.at, last.at) };
            text += &format!("  NO EIGENVALUES at {} = {place}{unit}: {}\n", along.name, first.reason);
        }
        text + "\n" + &self.table(&unit)
    }

    /// What the real parts say.
    fn meaning(&self) -> &'static str {
        match self.equilibria {
            all if all == self.reached => "all are equilibria: one with a growing mode is unstable",
            0 => {
                "none is an equilibrium: a growing mode tells where neighbours leave the motion at that instant, and proves \
                 nothing about its stability"
            }
            _ => "some are equilibria: only there does a growing mode mean that the state is unstable",
        }
    }

    /// Neighbouring states without eigenvalues for the same reason.
    fn gaps(&self) -> Vec<(&FailureFile, &FailureFile, usize)> {
        let mut found: Vec<(&FailureFile, &FailureFile, usize)> = Vec::new();
        for failure in &self.failures {
            match found.last_mut() {
                Some((first, last, count)) if first.reason == failure.reason => (*last, *count) = (failure, *count + 1),
                _ => found.push((failure, failure, 1)),
            }
        }
        found
    }

    fn table(&self, unit: &str) -> String {
        let growing = format!("growing at {}{}", self.along.name, unit.replace(" s", " (s)"));
        let mut table = Table::new(&["mode", "frequency (Hz)", "damping ratio", &growing]).words(1).words(2).words(3);
        let of = |kind: Kind| self.modes.iter().filter(move |mode| mode.kind == kind);
        of(Kind::Physical).take(MOST_LINES).for_each(|mode| table.row(cells(mode)));
        let [physical, uncertain, spurious] =
            [Kind::Physical, Kind::Uncertain, Kind::Spurious].map(|kind| of(kind).count());
        let mut text = if physical > 0 { table.to_string() } else { "  no physical eigenvalues\n".to_string() };
        if physical > MOST_LINES {
            text += &format!("  {} more in the files\n", physical - MOST_LINES);
        }
        if uncertain > 0 {
            text += &format!("  {uncertain} uncertain in the files: neither clearly physical nor spurious\n");
        }
        if spurious > 0 {
            text += &format!("  {spurious} spurious in the files\n");
        }
        text
    }
}

fn cells(mode: &ModeSummary) -> [String; 4] {
    let clean = |x: f64| if x.abs() < tolerances::SAME { 0.0 } else { x };
    let Extent { min, max } = mode.damping_ratio;
    let growing: Vec<String> = mode.growing.iter().take(MOST_STRETCHES).map(stretch).collect();
    let more = if mode.growing.len() > MOST_STRETCHES { ", ..." } else { "" };
    [
        mode.mode.clone(),
        extent(mode.frequency_hz, 5),
        extent(Extent { min: clean(min), max: clean(max) }, 4),
        if growing.is_empty() { "-".to_string() } else { growing.join(", ") + more },
    ]
}

fn extent(extent: Extent, digits: usize) -> String {
    let [min, max] = [extent.min, extent.max].map(|end| significant(end, digits));
    if min == max { min } else { format!("{min} to {max}") }
}

fn stretch(stretch: &Stretch) -> String {
    if stretch.from == stretch.to { significant(stretch.from, 6) } else { span(stretch.from, stretch.to) }
}

fn span(from: f64, to: f64) -> String {
    format!("{} to {}", significant(from, 6), significant(to, 6))
}
