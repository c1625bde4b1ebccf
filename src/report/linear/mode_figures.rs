//! Frequency and damping of the modes over a parameter, and frequency and growth along a motion.

use super::drawn::{self, DrawnMode, MOST_DRAWN, ORDERS, is_shown};
use super::ranges::{FREE, fitted, notes, outside, padded, robust, shaded, whole};
use crate::linearize::{Branch, Complex, damping};
use crate::plot::{AxisSpec, Figure, Panel, Series, Style, Tint};
use crate::tolerances;
use std::f64::consts::TAU;

/// Draws |lambda| / 2 pi and -Re(lambda) / |lambda| of the physical eigenvalues over a parameter, each conjugate pair
/// once; `along` names the parameter with its unit. `None` without physical eigenvalues.
///
/// With `speeds`, values of the parameter and the angular velocities there in rad/s, it is a Campbell diagram: lines of
/// excitation once and twice a turn, on a linear axis, and the modes that these may meet.
pub fn frequency_figure(
    title: &str,
    along: impl Into<AxisSpec>,
    branches: &[Branch],
    speeds: &[(f64, f64)],
) -> Option<Figure> {
    let (modes, left_out) = drawn::modes(branches, drawn::count(branches, speeds));
    let frequencies = lines(&modes, |value| value.norm() / TAU);
    let dampings = lines(&modes, damping);
    let x = whole(branches.iter().flat_map(|branch| &branch.points).map(|point| point.0))?;
    let along = along.into().range(x.0, x.1);
    let (axis, note) = frequency_axis("frequency |λ|/2π (Hz)", &values(&frequencies), !speeds.is_empty())?;
    let top = axis.range.map_or(f64::INFINITY, |range| range.1);
    let panel = Panel::new(along.clone(), axis).title(notes([left_out, note]));
    let frequencies = frequencies.into_iter().map(without_zeros(&panel));
    let upper = excitation(frequencies.fold(panel, Panel::series), speeds, top);
    let axis = damping_axis(&values(&dampings));
    let growing = axis.range.filter(|range| range.0 < 0.0);
    let mut lower = dampings.into_iter().fold(Panel::new(along, axis), Panel::series);
    if let Some((low, high)) = growing {
        lower = shaded(lower, x, (low, high.min(0.0)));
    }
    Some(Figure::new().title(title).panel(upper).panel(lower))
}

/// Draws Im(lambda) / 2 pi and Re(lambda) of the physical eigenvalues along a motion, each conjugate pair once; those of
/// another scene as dashed lines. `None` without physical eigenvalues.
pub fn motion_figure(title: &str, branches: &[Branch], other: Option<(&str, &[Branch])>) -> Option<Figure> {
    let (modes, left_out) = drawn::modes(branches, MOST_DRAWN);
    let swings = lines(&modes, |value| value.im / TAU);
    let growths = lines(&modes, |value| value.re);
    let size = robust(modes.iter().flat_map(|mode| &mode.branch.points).map(|point| point.1.norm()), 0.0)?.1;
    let x = whole(branches.iter().flat_map(|branch| &branch.points).map(|point| point.0))?;
    let time = AxisSpec::from("time (s)").range(x.0, x.1);
    let (axis, note) = frequency_axis("frequency Im λ/2π (Hz)", &values(&swings), false)?;
    let upper = Panel::new(time.clone(), axis).title(notes([left_out, note]));
    let growth = values(&growths);
    let y = fitted(growth.iter().copied(), size)?;
    let is_outside = growth.iter().filter(|value| !(y.0..=y.1).contains(*value)).count();
    let lower = Panel::new(time, AxisSpec::from("real part (1/s)").range(y.0, y.1)).title(outside(is_outside));
    let lower = shaded(lower, x, (y.0.max(0.0), y.1));
    let [others_swing, others_growth] = others(other);
    let upper = swings.into_iter().chain(others_swing).map(without_zeros(&upper)).fold(upper, Panel::series);
    let lower = growths.into_iter().chain(others_growth).fold(lower, Panel::series);
    Some(Figure::new().title(title).panel(upper).panel(lower))
}

/// Returns frequencies and real parts of the modes of another scene; the first line names it.
fn others(other: Option<(&str, &[Branch])>) -> [Vec<Series>; 2] {
    let Some((scene, branches)) = other else { return Default::default() };
    let (modes, _) = drawn::modes(branches, MOST_DRAWN);
    let dashed = |value: fn(Complex<f64>) -> f64| {
        let mut lines = lines(&modes, value);
        lines.iter_mut().for_each(|line| {
            (line.style, line.color) = (Style::Dashed, Some(6));
            line.label.clear();
        });
        if let Some(first) = lines.first_mut() {
            first.label = scene.to_string();
        }
        lines
    };
    [dashed(|value| value.im / TAU), dashed(|value| value.re)]
}

/// On a logarithmic axis, makes gaps where a mode does not swing.
fn without_zeros(panel: &Panel) -> impl Fn(Series) -> Series + use<> {
    let is_log = panel.y.is_log;
    move |mut line| {
        line.points.iter_mut().filter(|point| is_log && point.1 <= 0.0).for_each(|point| point.1 = f64::NAN);
        line
    }
}

/// Adds the lines of excitation, each with its order where it leaves the axes.
fn excitation(panel: Panel, speeds: &[(f64, f64)], top: f64) -> Panel {
    if speeds.is_empty() {
        return panel;
    }
    ORDERS.iter().fold(panel, |panel, order| {
        let points: Vec<(f64, f64)> = speeds.iter().map(|(at, speed)| (*at, order * speed.abs() / TAU)).collect();
        let inside = points.iter().copied().filter(|point| point.1 < 0.95 * top);
        let end = inside.max_by(|a, b| a.1.total_cmp(&b.1));
        let panel = panel.series(Series::line("", points).style(Style::Guide));
        end.into_iter().fold(panel, |panel, (x, y)| panel.note(Tint::Ink(0.4), x, y, format!("{order}×")))
    })
}

fn lines(modes: &[DrawnMode], value: impl Fn(Complex<f64>) -> f64) -> Vec<Series> {
    let line = |mode: &DrawnMode| {
        let name = if modes.len() > 1 && modes.len() <= MOST_DRAWN { mode.name.as_str() } else { "" };
        // Real here, elsewhere the lower one of a pair: it must not hide the other one, which may be as large.
        let is_partner = mode.branch.points.iter().any(|(_, value)| value.im < 0.0);
        let style = if is_partner { Style::Thin } else { Style::Line };
        Series::line(name, points(&mode.branch.curve(), &value)).style(style)
    };
    modes.iter().map(line).collect()
}

/// Returns the values of a mode, with gaps where it is the lower one of a pair, but for the states next to those where
/// it is real: there both lines meet.
fn points(branch: &Branch, value: impl Fn(Complex<f64>) -> f64) -> Vec<(f64, f64)> {
    let is_real = |i: usize| branch.points.get(i).is_some_and(|point| point.1.im == 0.0);
    let at = |(i, (at, there)): (usize, &(f64, Complex<f64>))| {
        let upper = Complex::new(there.re, there.im.abs());
        let meets = is_shown(upper) && (is_real(i + 1) || i > 0 && is_real(i - 1));
        (*at, if is_shown(*there) || meets { value(upper) } else { f64::NAN })
    };
    branch.points.iter().enumerate().map(at).collect()
}

fn values(lines: &[Series]) -> Vec<f64> {
    let points = lines.iter().flat_map(|line| &line.points);
    points.map(|point| point.1).filter(|value| value.is_finite()).collect()
}

/// True if values above zero are of different sizes.
fn are_wide(values: &[f64]) -> bool {
    let positive = whole(values.iter().copied().filter(|value| *value > 0.0));
    positive.is_some_and(|(low, high)| high > 100.0 * low)
}

/// Returns the axis of frequencies and a note on values outside it. It is linear where it must be, or where the values
/// are of one size.
fn frequency_axis(label: &str, values: &[f64], is_linear: bool) -> Option<(AxisSpec, String)> {
    let axis = AxisSpec::from(label);
    let range = robust(values.iter().copied(), 0.0)?;
    if !is_linear && are_wide(values) {
        return Some((axis.log(), String::new()));
    }
    let count = values.iter().filter(|value| !(range.0..=range.1).contains(*value)).count();
    let (low, high) = padded(range, FREE, 0.0);
    Some(match (is_linear, count) {
        (true, _) if high > 0.0 => (axis.range(0.0, high), outside(count)),
        (_, 0) => (axis, String::new()),
        _ => (axis.range(low, high), outside(count)),
    })
}

fn damping_axis(values: &[f64]) -> AxisSpec {
    let axis = AxisSpec::from("damping ratio");
    let Some((low, high)) = whole(values.iter().copied()) else { return axis };
    if high - low >= tolerances::EIGENVALUES_AGREE && low > 0.0 && are_wide(values) {
        return axis.log();
    }
    let least = if high - low < tolerances::EIGENVALUES_AGREE { 0.02 } else { 0.0 };
    let (low, high) = padded((low, high), FREE, least);
    axis.range(low, high)
}
