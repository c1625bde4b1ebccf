//! Figures of a run.

use crate::analysis::{Ledger, Record};
use crate::plot::{AxisSpec, Figure, Panel, Series};
use crate::scene::units::{Dimension, dimension_of};
use crate::trajectory::Trajectory;

/// A curve of a figure, with the name and the unit of its quantity.
pub(super) struct Curve<'a> {
    pub name: &'a str,
    pub unit: &'a str,
    pub points: Vec<(f64, f64)>,
}

/// Draws outputs over time, one panel for each unit; coordinates where the scene names no outputs. `None` without rows.
pub fn outputs_figure(title: &str, trajectory: &Trajectory) -> Option<Figure> {
    let Trajectory { names, outputs, rows } = trajectory;
    let first = trajectory.headings().len() - outputs.len();
    let coordinates = names.q.iter().take(MOST_COORDINATES).map(|name| (name.as_str(), "m, rad"));
    let mut shown: Vec<((&str, &str), usize)> = trajectory.named_outputs().zip(first..).collect();
    if shown.is_empty() {
        shown = coordinates.zip(1..).collect();
    }
    let points = |column: usize| rows.iter().map(|row| (row[0], row[column])).collect();
    let curves = shown.into_iter().map(|((name, unit), column)| Curve { name, unit, points: points(column) });
    let panels = grouped(curves, |curve| curve.unit).into_iter().map(|group| panel("time (s)", group));
    (rows.len() > 1).then(|| panels.fold(Figure::new().title(title), Figure::panel))
}

/// Draws curves of one unit; one alone is named by the axis, several by the legend.
pub(super) fn panel(x: &str, curves: Vec<Curve>) -> Panel {
    let Some(Curve { name, unit, .. }) = curves.first() else { return Panel::new(x, "") };
    let is_alone = curves.len() == 1;
    let panel = Panel::new(x, label(if is_alone { name } else { quantity(unit) }, unit));
    let named = |curve: Curve| Series::line(if is_alone { "" } else { curve.name }, curve.points);
    curves.into_iter().map(named).fold(panel, Panel::series)
}

/// Returns items of equal keys together, in the order of the first of each.
pub(super) fn grouped<T, K: PartialEq>(items: impl IntoIterator<Item = T>, key: impl Fn(&T) -> K) -> Vec<Vec<T>> {
    let mut groups: Vec<Vec<T>> = Vec::new();
    for item in items {
        match groups.iter_mut().find(|group| key(&group[0]) == key(&item)) {
            Some(group) => group.push(item),
            None => groups.push(vec![item]),
        }
    }
    groups
}

/// Returns the label of an axis: a quantity with its unit, if it has one.
pub(super) fn label(quantity: &str, unit: &str) -> String {
    if unit.is_empty() { quantity.to_string() } else { format!("{quantity} ({unit})") }
}

/// Largest number of coordinates drawn.
pub const MOST_COORDINATES: usize = 12;

/// Returns the quantity of a unit, for an axis; a percentage may be one of any quantity.
pub(super) fn quantity(unit: &str) -> &'static str {
    let dimension = dimension_of(unit).filter(|dimension| *dimension != Dimension::Strain);
    dimension.map_or("value", Dimension::word)
}

/// Number of points of a drift curve, each the largest value of its window.
const WINDOWS: usize = 100;

/// Draws the drift of positions, velocities and accelerations over time, on logarithmic axes.
pub fn drift_figure(title: &str, record: &Record) -> Option<Figure> {
    let times: Vec<f64> = record.trajectory.times().collect();
    if times.len() < 2 || record.full().names.lambda.is_empty() {
        return None;
    }
    let labels = ["position |φ|", "velocity |φ′|", "acceleration |φ″|"];
    let series = labels.iter().enumerate().map(|(i, label)| {
        let points = times.iter().zip(&record.drift_rows).map(|(t, levels)| (*t, levels[i]));
        Series::line(*label, envelope(points, times.len(), WINDOWS))
    });
    let y = AxisSpec::from("drift (m, rad; per s, s²)").log();
    let panel = series.fold(Panel::new("time (s)", y), Panel::series);
    Some(Figure::new().title(title).panel(panel))
}

/// Draws kinetic and potential energy and work, and the error of their balance.
pub fn energy_figure(title: &str, record: &Record) -> Option<Figure> {
    let times: Vec<f64> = record.trajectory.times().collect();
    if times.len() < 2 || record.ledger_rows.len() != times.len() {
        return None;
    }
    let curve = |label: &str, value: fn(&Ledger) -> f64| {
        Series::line(label, times.iter().zip(&record.ledger_rows).map(|(t, row)| (*t, value(row))).collect())
    };
    let mut energies = Panel::new("time (s)", "energy (J)")
        .series(curve("kinetic", |row| row.kinetic))
        .series(curve("potential", |row| row.potential));
    if record.ledger_rows.iter().any(|row| row.work != 0.0) {
        energies = energies.series(curve("work put in", |row| row.work));
    }
    let total = curve("total less work", |row| row.kinetic + row.potential - row.work);
    let error = AxisSpec::from("error of the balance (J)").log();
    let errors = Panel::new("time (s)", error).series(curve("", |row| row.error.abs()).color(0));
    Some(Figure::new().title(title).panel(energies.series(total)).panel(errors))
}

/// Returns the largest value within each of `windows` windows: drift at round-off jumps between zero and 1e-16 from row
/// to row, and a curve through all of it hides the others. Windows without a positive value are dropped.
pub fn envelope(points: impl Iterator<Item = (f64, f64)>, rows: usize, windows: usize) -> Vec<(f64, f64)> {
    let points: Vec<(f64, f64)> = points.collect();
    let width = rows.div_ceil(windows).max(1);
    let largest = |window: &[(f64, f64)]| {
        window.iter().copied().max_by(|a, b| a.1.total_cmp(&b.1)).map(|(_, value)| (window[window.len() / 2].0, value))
    };
    points.chunks(width).filter_map(largest).filter(|(_, value)| *value > 0.0).collect()
}
