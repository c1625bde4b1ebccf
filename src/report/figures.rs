//! Figures of a run.

use crate::analysis::Record;
use crate::plot::{Figure, Panel, Series};
use crate::scene::units::{Dimension, dimension_of};
use crate::trajectory::Trajectory;

/// Draws outputs over time, one panel for each unit; coordinates where the scene names no outputs. `None` without rows.
pub fn outputs_figure(title: &str, trajectory: &Trajectory) -> Option<Figure> {
    if trajectory.rows.len() < 2 {
        return None;
    }
    let mut units: Vec<(&str, Vec<(&str, usize)>)> = Vec::new();
    let first = trajectory.headings().len() - trajectory.outputs.len();
    let mut add = |unit, name, column| match units.iter_mut().find(|(known, _)| *known == unit) {
        Some((_, members)) => members.push((name, column)),
        None => units.push((unit, vec![(name, column)])),
    };
    for (i, column) in trajectory.outputs.iter().enumerate() {
        add(column.unit.as_str(), column.name.as_str(), first + i);
    }
    if trajectory.outputs.is_empty() {
        let names = trajectory.names.q.iter().take(MOST_COORDINATES).enumerate();
        names.for_each(|(i, name)| add("m, rad", name.as_str(), 1 + i));
    }
    let mut figure = Figure::new().title(title);
    for (unit, members) in units {
        let quantity = if members.len() == 1 { members[0].0 } else { quantity(unit) };
        let label = if unit.is_empty() { quantity.to_string() } else { format!("{quantity} ({unit})") };
        let mut panel = Panel::new("time (s)", label);
        let alone = members.len() == 1;
        for (name, column) in members {
            let name = if alone { "" } else { name };
            let points = trajectory.rows.iter().map(|row| (row[0], row[column])).collect();
            panel = panel.series(Series::line(name, points));
        }
        figure = figure.panel(panel);
    }
    Some(figure)
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
    let y = crate::plot::AxisSpec::from("drift (m, rad; per s, s²)").log();
    let panel = series.fold(Panel::new("time (s)", y), Panel::series);
    Some(Figure::new().title(title).panel(panel))
}

/// Draws kinetic and potential energy and work, and the error of their balance.
pub fn energy_figure(title: &str, record: &Record) -> Option<Figure> {
    let times: Vec<f64> = record.trajectory.times().collect();
    if times.len() < 2 || record.ledger_rows.len() != times.len() {
        return None;
    }
    let curve = |label: &str, value: fn(&crate::analysis::Ledger) -> f64| {
        Series::line(label, times.iter().zip(&record.ledger_rows).map(|(t, row)| (*t, value(row))).collect())
    };
    let mut energies = Panel::new("time (s)", "energy (J)")
        .series(curve("kinetic", |row| row.kinetic))
        .series(curve("potential", |row| row.potential));
    if record.ledger_rows.iter().any(|row| row.work != 0.0) {
        energies = energies.series(curve("work put in", |row| row.work));
    }
    let total = curve("total less work", |row| row.kinetic + row.potential - row.work);
    let error = crate::plot::AxisSpec::from("error of the balance (J)").log();
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
