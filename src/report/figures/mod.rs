//! Figures of a run.

mod curves;
mod shown;

pub(super) use curves::{Curve, Stack, stacked};
pub use shown::{Ending, Shown};

use crate::analysis::{Ledger, Record};
use crate::math::largest;
use crate::plot::{AxisSpec, Figure, Panel, Series};
use crate::scene::units::{Dimension, dimension_of};
use crate::study::ErrorBars;
use crate::trajectory::Trajectory;

/// Draws outputs over time, one panel for those of one unit and of similar ranges, or one each; coordinates where the
/// scene names no outputs; with error bars as bands. `None` without rows.
pub fn outputs_figure(
    name: &str,
    trajectory: &Trajectory,
    bars: Option<&ErrorBars>,
    shown: &Shown,
    separate: bool,
) -> Option<Figure> {
    let Trajectory { names, outputs, rows } = trajectory;
    let rows = &rows[..shown.rows.min(rows.len())];
    let first = trajectory.headings().len() - outputs.len();
    let coordinates = names.q.iter().take(MOST_COORDINATES).map(|name| (name.as_str(), "m, rad"));
    let mut drawn: Vec<((&str, &str), usize)> = trajectory.named_outputs().zip(first..).collect();
    if drawn.is_empty() {
        drawn = coordinates.zip(1..).collect();
    }
    let points = |column: usize| rows.iter().map(|row| (row[0], row[column])).collect();
    let bar = |i: usize| bars.and_then(|bars| bars.outputs.get(i)).map_or(&[][..], |(_, bar)| &bar.rows[..]);
    let curve = |(i, ((name, unit), column))| Curve { name, unit, points: points(column), bar: bar(i) };
    let curves = drawn.into_iter().enumerate().map(curve);
    let panels = stacked(curves, separate).map(|stack| stack.panel("time (s)"));
    (rows.len() > 1).then(|| panels.fold(Figure::new().title(shown.title(name)), Figure::panel))
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
pub(crate) fn quantity(unit: &str) -> &'static str {
    let dimension = dimension_of(unit).filter(|dimension| *dimension != Dimension::Strain);
    dimension.map_or("value", Dimension::word)
}

/// Draws the drift of positions, velocities and accelerations over time, on a logarithmic axis down to the round-off of
/// `length`, that of the mechanism in m. `None` without constraints.
pub fn drift_figure(name: &str, record: &Record, shown: &Shown, length: f64) -> Option<Figure> {
    let times: Vec<f64> = record.trajectory.times().take(shown.rows).collect();
    if times.len() < 2 || record.full().names.lambda.is_empty() {
        return None;
    }
    let floor = Floor::of(length);
    let labels = ["position |φ|", "velocity |φ′|", "acceleration |φ″|"];
    let series = labels.iter().enumerate().map(|(i, label)| {
        let points = times.iter().zip(&record.drift_rows).map(|(t, levels)| (*t, levels[i]));
        Series::line(*label, envelope(points, times.len(), 100))
    });
    let panel = series.fold(Panel::new("time (s)", AxisSpec::from("drift (m, rad; per s, s²)").log()), Panel::series);
    Some(Figure::new().title(shown.title(&format!("{name}: drift"))).panel(floor.cut(panel)))
}

/// Draws kinetic and potential energy and work, and the error of their balance down to the round-off of the energies.
pub fn energy_figure(name: &str, record: &Record, shown: &Shown) -> Option<Figure> {
    let times: Vec<f64> = record.trajectory.times().take(shown.rows).collect();
    if times.len() < 2 || record.ledger_rows.len() != record.trajectory.rows.len() {
        return None;
    }
    let rows = &record.ledger_rows[..times.len()];
    let points = |value: fn(&Ledger) -> f64| times.iter().zip(rows).map(|(t, row)| (*t, value(row))).collect();
    let curve = |name, value| Curve { name, unit: "J", points: points(value), bar: &[] };
    let mut curves = vec![curve("kinetic", |row| row.kinetic), curve("potential", |row| row.potential)];
    if rows.iter().any(|row| row.work != 0.0) {
        curves.push(curve("work put in", |row| row.work));
    }
    let mut stacks: Vec<Stack> = stacked(curves, false).collect();
    // Beside changes the sum would be a line of zeros: the panel of the error has it.
    if let [Stack { curves, is_change: false }] = &mut stacks[..] {
        curves.push(curve("total less work", |row| row.kinetic + row.potential - row.work));
    }
    let floor = Floor::of(rows.iter().map(|row| largest(&[row.kinetic, row.potential, row.work])).fold(0.0, f64::max));
    let error = AxisSpec::from("error of the balance (J)").log();
    let errors = Panel::new("time (s)", error).series(Series::line("", points(|row| row.error.abs())).color(0));
    let title = Figure::new().title(shown.title(&format!("{name}: energy")));
    Some(stacks.into_iter().map(|stack| stack.panel("time (s)")).chain([floor.cut(errors)]).fold(title, Figure::panel))
}

/// The power of ten from which on values on a logarithmic axis are more than round-off.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Floor {
    exponent: i32,
}

impl Floor {
    /// The floor of numbers that are sums of such a size; at least that of the smallest sizes with an exponent.
    pub fn of(size: f64) -> Self {
        Floor { exponent: (f64::EPSILON * size).max(f64::MIN_POSITIVE).log10().round() as i32 }
    }

    /// Moves smaller values to the floor, and says so.
    pub fn cut(self, mut panel: Panel) -> Panel {
        let least = 10f64.powi(self.exponent);
        let mut has_cut = false;
        for (_, value) in panel.series.iter_mut().flat_map(|series| &mut series.points).filter(|point| point.1 < least)
        {
            (*value, has_cut) = (least, true);
        }
        let text = format!("round-off: values below 10^{0} are drawn at 10^{0}", self.exponent);
        if has_cut { panel.title(text) } else { panel }
    }
}

/// Returns the largest value within each of `windows` windows: drift at round-off jumps between zero and 1e-16 from row
/// to row, and a curve through all of it hides the others.
pub fn envelope(points: impl Iterator<Item = (f64, f64)>, rows: usize, windows: usize) -> Vec<(f64, f64)> {
    let points: Vec<(f64, f64)> = points.collect();
    let width = rows.div_ceil(windows).max(1);
    let largest = |window: &[(f64, f64)]| {
        window.iter().copied().max_by(|a, b| a.1.total_cmp(&b.1)).map(|(_, value)| (window[window.len() / 2].0, value))
    };
    points.chunks(width).filter_map(largest).collect()
}
