//! Frequency and damping of the modes over time or a parameter.

use super::range::{drawn, padded, robust};
use crate::linearize::{Branch, Complex, Kind};
use crate::plot::{AxisSpec, Figure, Panel, Series, Style};
use crate::tolerances::linearize as tolerances;
use std::f64::consts::TAU;

/// More lines than this have no names.
const MOST_NAMED: usize = 7;
/// Values further apart than this factor have a logarithmic axis.
const WIDE: f64 = 100.0;
const FREE: f64 = 0.06;
/// An axis of damping ratios is at least so long where they differ by round-off only.
const LEAST_DAMPING: f64 = 0.02;

/// |lambda| / 2 pi and -Re(lambda) / |lambda| of the physical eigenvalues, each conjugate pair once; `along` names time or
/// parameter with its unit. `None` without physical eigenvalues.
pub fn frequency_figure(title: &str, along: impl Into<AxisSpec>, branches: &[Branch]) -> Option<Figure> {
    let along = along.into();
    let (drawn, left_out) = drawn(branches);
    let physical = drawn.iter().filter(|branch| branch.kind == Kind::Physical);
    let upper: Vec<&Branch> = physical.filter(|branch| branch.points.iter().any(|point| is_shown(point.1))).collect();
    let frequencies = lines(&upper, |value| value.norm() / TAU);
    let dampings = lines(&upper, |value| if value.norm() > 0.0 { -value.re / value.norm() } else { 0.0 });
    let (frequency_axis, note) = frequency_axis(values(&frequencies))?;
    let note = if left_out.is_empty() { note } else { left_out };
    let damping_axis = damping_axis(values(&dampings));
    let all = |panel: Panel, lines: Vec<Series>| lines.into_iter().fold(panel, Panel::series);
    let frequencies = all(Panel::new(along.clone(), frequency_axis).title(note), frequencies);
    let dampings = all(Panel::new(along, damping_axis), dampings);
    Some(Figure::new().title(title).panel(frequencies).panel(dampings))
}

/// Finite, and not the lower one of a pair.
fn is_shown(value: Complex<f64>) -> bool {
    value.re.is_finite() && value.im.is_finite() && value.im >= 0.0
}

fn lines(branches: &[&Branch], value: impl Fn(Complex<f64>) -> f64) -> Vec<Series> {
    let is_named = (2..=MOST_NAMED).contains(&branches.len());
    let point = |(at, there): &(f64, Complex<f64>)| (*at, if is_shown(*there) { value(*there) } else { f64::NAN });
    let line = |(i, branch): (usize, &&Branch)| {
        let name = if is_named { format!("mode {}", i + 1) } else { String::new() };
        // Real now, elsewhere the lower one of a pair: it must not hide the other one, which may be as large.
        let is_partner = branch.points.iter().any(|(_, value)| value.im < 0.0);
        let style = if is_partner { Style::Thin } else { Style::Line };
        Series::line(name, branch.points.iter().map(point).collect()).style(style)
    };
    branches.iter().enumerate().map(line).collect()
}

fn values(lines: &[Series]) -> Vec<f64> {
    let points = lines.iter().flat_map(|line| &line.points);
    points.map(|point| point.1).filter(|value| value.is_finite()).collect()
}

/// Whether values are all above zero and of different sizes.
fn are_wide(values: &[f64]) -> bool {
    let (low, high) = bounds(values);
    low > 0.0 && high > WIDE * low
}

fn bounds(values: &[f64]) -> (f64, f64) {
    values.iter().fold((f64::INFINITY, f64::NEG_INFINITY), |(low, high), value| (low.min(*value), high.max(*value)))
}

/// The axis and what is said of values outside it.
fn frequency_axis(values: Vec<f64>) -> Option<(AxisSpec, String)> {
    let axis = AxisSpec::from("frequency |λ|/2π (Hz)");
    if are_wide(&values) {
        return Some((axis.log(), String::new()));
    }
    let range = robust(values.iter().copied())?;
    let outside = values.iter().filter(|value| !(range.0..=range.1).contains(*value)).count();
    let (low, high) = padded(range, FREE, 0.0);
    Some(match outside {
        0 => (axis, String::new()),
        1 => (axis.range(low, high), "1 point lies outside".to_string()),
        _ => (axis.range(low, high), format!("{outside} points lie outside")),
    })
}

fn damping_axis(values: Vec<f64>) -> AxisSpec {
    let axis = AxisSpec::from("damping ratio");
    let (low, high) = bounds(&values);
    match high - low {
        span if span < tolerances::EIGENVALUES_AGREE => {
            let (low, high) = padded((low, high), 0.0, LEAST_DAMPING);
            axis.range(low, high)
        }
        _ if are_wide(&values) => axis.log(),
        _ => axis,
    }
}
