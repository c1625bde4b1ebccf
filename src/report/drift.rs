//! Text, table and figure of `drift`.

use super::error_bar::accuracy;
use super::figures::{Ending, Floor, Shown, envelope};
use super::{Answer, Folder, TextTable, cell, table};
use crate::analysis::Drift;
use crate::error::Result;
use crate::plot::{AxisSpec, Figure, Panel, Series};
use crate::prepared::Model;
use crate::simulate::Method;
use crate::study::StabilizedRun;
use serde::Serialize;
use serde_json::json;

/// A scene under every stabilization.
pub struct Stabilizations<'a> {
    pub prepared: &'a Model,
    pub runs: Vec<StabilizedRun>,
}

impl Answer for Stabilizations<'_> {
    fn json(&self) -> impl Serialize {
        json!({ "scene": self.prepared.name, "runs": self.runs })
    }

    /// Returns one row for each stabilization, and the failures.
    fn text(&self) -> String {
        let Stabilizations { prepared, runs: rows } = self;
        let Method { integrator, .. } = &prepared.method;
        let accuracy = accuracy(&prepared.method);
        let mut table = TextTable::new(&[
            "",
            "max |φ|",
            "max |φ′|",
            "final |φ|",
            "final |φ′|",
            "energy error",
            "steps",
            "rhs",
            "ms",
        ]);
        for row in rows {
            let Drift { position, velocity, .. } = &row.drift;
            let drift = [position.max, velocity.max, position.last, velocity.last].map(|value| format!("{value:.2e}"));
            let energy = row.energy.map_or("-".to_string(), |energy| format!("{:.2e}", energy.max_error));
            let work =
                [row.steps.to_string(), row.rhs_evaluations.to_string(), format!("{:.2}", 1e3 * row.wall_seconds)];
            table.row([row.method.clone()].into_iter().chain(drift).chain([energy]).chain(work));
        }
        let because = prepared.chosen_because.as_ref().map_or(String::new(), |because| format!("  auto: {because}\n"));
        let text = format!("{}: drift with {integrator}, {accuracy}\n{because}\n{table}", prepared.name);
        let failures = rows.iter().filter_map(|row| Some((&row.method, row.failure.as_ref()?)));
        let lines = failures
            .map(|(method, failure)| format!("\n  {method} FAILED at t = {:.4e} s: {}", failure.t, failure.reason));
        let left = rows.iter().filter_map(|row| Some((&row.method, row.record.singularity.left()?)));
        let jumps = left.map(|(method, at)| {
            let t = at.t;
            format!("\n  {method} left its branch: its velocity jumped at the singular state of t = {t:.6} s")
        });
        let lines: String = lines.chain(jumps).collect();
        text + &lines + if lines.is_empty() { "" } else { "\n" }
    }

    fn write(&self, folder: &mut Folder, stem: &str) -> Result<()> {
        folder.table(stem, &stabilizations_table(&self.runs)?)?;
        let length = self.prepared.system().facts().length;
        folder.figure(stem, stabilizations_figure(&self.prepared.name, &self.runs, length))
    }
}

/// Returns `t`, then |phi| and |phi'| of every method; empty where a run had ended.
fn stabilizations_table(rows: &[StabilizedRun]) -> Result<Vec<u8>> {
    let names = rows.iter().flat_map(|row| [format!("position {}", row.method), format!("velocity {}", row.method)]);
    let longest = rows.iter().map(|row| row.record.drift_rows.len()).max().unwrap_or(0);
    let line = |i: usize| {
        let t = rows.iter().find_map(|row| row.record.trajectory.times().nth(i)).unwrap_or(0.0);
        let levels = rows.iter().flat_map(|row| match row.record.drift_rows.get(i) {
            Some([position, velocity, _]) => [cell(*position), cell(*velocity)],
            None => [String::new(), String::new()],
        });
        [cell(t)].into_iter().chain(levels).collect()
    };
    table(["t".to_string()].into_iter().chain(names), (0..longest).map(line))
}

fn legend(method: &str) -> String {
    method.replace("alpha", "α").replace("beta", "β").replace("gamma", "γ").replace(':', " ").replace(',', ", ")
}

/// Draws the drift of positions and of velocities over time down to the round-off of `length`, that of the mechanism in
/// m: a curve for each stabilization, up to where its run diverged.
fn stabilizations_figure(name: &str, rows: &[StabilizedRun], length: f64) -> Option<Figure> {
    let shown = |row: &StabilizedRun| {
        let ending = Ending::of(row.failure.as_ref(), &row.drift, row.energy.as_ref());
        Shown::of_run(ending, &row.record, length)
    };
    let all: Vec<Shown> = rows.iter().map(shown).collect();
    let panel = |level: usize, label: &str| {
        let panel = Panel::new("time (s)", AxisSpec::from(label).log());
        let panel = rows.iter().zip(&all).fold(panel, |panel, (row, shown)| {
            let times = row.record.trajectory.times().take(shown.rows);
            let points = times.zip(&row.record.drift_rows).map(|(t, levels)| (t, levels[level]));
            let curve = envelope(points, shown.rows, 60);
            panel.series(Series::line(shown.legend(&legend(&row.method)), curve))
        });
        Floor::of(length).cut(panel)
    };
    let figure = Figure::new().title(format!("{name}: drift under every stabilization"));
    Some(figure.panel(panel(0, "position drift |φ| (m, rad)")).panel(panel(1, "velocity drift |φ′| (m/s, rad/s)")))
}
