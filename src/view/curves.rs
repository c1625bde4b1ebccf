//! Curves over time below the mechanism.

use super::ShownMotion;
use super::encode::Floats;
use crate::analysis::Ledger;
use crate::report::quantity;
use serde::Serialize;

/// A quantity at each time of a clip.
#[derive(Clone, Debug, Serialize)]
pub struct Curve {
    pub name: String,
    /// Title of the diagram that it is drawn in, with its unit.
    pub group: String,
    pub unit: String,
    /// True on a logarithmic axis.
    pub is_log: bool,
    /// Values; NaN where there is none.
    pub values: Floats,
    /// Half width of the error bar at each time; empty where it is not known.
    pub bar: Floats,
}

/// Largest number of curves.
const MOST: usize = 40;

impl Curve {
    fn new(group: &str, name: &str, unit: &str) -> Self {
        let group = if unit.is_empty() { group.to_string() } else { format!("{group} ({unit})") };
        let unit = unit.to_string();
        Curve { name: name.to_string(), group, unit, is_log: false, values: Floats::default(), bar: Floats::default() }
    }

    fn with(mut self, values: impl IntoIterator<Item = f64>) -> Self {
        self.values.extend(values);
        self
    }

    /// Number of values.
    pub fn len(&self) -> usize {
        self.values.0.len() + self.bar.0.len()
    }
}

/// Returns outputs, or coordinates where there are none, drift and energies of a run at these rows, and the number that
/// these would be without a limit.
pub fn curves(run: &ShownMotion, rows: &[usize]) -> (Vec<Curve>, usize) {
    let mut curves = outputs(run, rows);
    let left_out = curves.len().saturating_sub(MOST);
    curves.truncate(MOST);
    curves.extend(drift(run, rows));
    curves.extend(energy(run, rows));
    let all = curves.len() + left_out;
    (curves, all)
}

fn outputs(run: &ShownMotion, rows: &[usize]) -> Vec<Curve> {
    let trajectory = run.trajectory;
    let values = |column: usize| rows.iter().map(move |row| trajectory.rows[*row][column]);
    if trajectory.outputs.is_empty() {
        let names = trajectory.names.q.iter().zip(1..);
        return names.map(|(name, column)| Curve::new("coordinates", name, "m, rad").with(values(column))).collect();
    }
    let first = trajectory.headings().len() - trajectory.outputs.len();
    let bar_of = |name: &str| run.bars?.outputs.iter().find(|(known, _)| known == name).map(|(_, bar)| &bar.rows);
    let curve = |((name, unit), column): ((&str, &str), usize)| {
        let mut curve = Curve::new(quantity(unit), name, unit).with(values(column));
        if let Some(bar) = bar_of(name) {
            curve.bar.extend(rows.iter().map(|row| bar.get(*row).copied().unwrap_or(f64::NAN)));
        }
        curve
    };
    trajectory.named_outputs().zip(first..).map(curve).collect()
}

/// Positions and velocities at a value of zero, which no logarithmic axis has, are left out.
fn drift(run: &ShownMotion, rows: &[usize]) -> Vec<Curve> {
    if run.drift.len() != run.trajectory.rows.len() || run.trajectory.names.lambda.is_empty() {
        return Vec::new();
    }
    let level = |(level, name): (usize, &str)| {
        let values =
            rows.iter().map(|row| run.drift[*row][level]).map(|value| if value > 0.0 { value } else { f64::NAN });
        Curve { is_log: true, ..Curve::new("drift", name, "m, rad; per s").with(values) }
    };
    ["positions |φ|", "velocities |φ′|"].into_iter().enumerate().map(level).collect()
}

fn energy(run: &ShownMotion, rows: &[usize]) -> Vec<Curve> {
    if run.energy.len() != run.trajectory.rows.len() {
        return Vec::new();
    }
    let curve = |group: &str, name: &str, value: fn(&Ledger) -> f64| {
        Curve::new(group, name, "J").with(rows.iter().map(|row| value(&run.energy[*row])))
    };
    let mut curves = vec![
        curve("energy", "kinetic", |row| row.kinetic),
        curve("energy", "potential", |row| row.potential),
        curve("error of the energy balance", "total less work", |row| row.error),
    ];
    if run.energy.iter().any(|row| row.work != 0.0) {
        curves.insert(2, curve("energy", "work put in", |row| row.work));
    }
    curves
}
