//! Figure of outputs over a parameter or over one of them.

use super::figures::quantity;
use super::sweep::{shown, watched};
use crate::plot::{Figure, Panel, Series};
use crate::sweep::{Point, Sweep};

/// A curve, with the name of its quantity.
struct Curve<'a> {
    name: &'a str,
    unit: &'a str,
    values: Vec<f64>,
}

/// Options of the figure of a sweep.
#[derive(Clone, Copy, Debug, Default)]
pub struct SweepLook<'a> {
    /// Outputs; all where none is named.
    pub outputs: &'a [String],
    /// Output along the horizontal axis, instead of the parameter.
    pub against: Option<&'a str>,
    /// True for one panel per output, false for one per unit.
    pub separate: bool,
}

/// Draws outputs over the parameter or one of them, angles in degrees; the scene's own position and the ends of the
/// branch are marked. `None` without a curve.
pub fn sweep_figure(sweep: &Sweep, look: SweepLook) -> Option<Figure> {
    let SweepLook { outputs: names, against, separate } = look;
    let curves = curves(sweep);
    let curve = sweep.curve();
    let x = against.and_then(|name| curves.iter().find(|curve| curve.name == name));
    let abscissa: Vec<f64> = x.map_or_else(|| curve.iter().map(|point| point.value).collect(), |x| x.values.clone());
    let label = x.map_or_else(|| sweep.range.parameter.clone(), |x| label(x.name, x.unit));
    let is_drawn = |curve: &&Curve| match names {
        [] => Some(curve.name) != against,
        names => names.iter().any(|name| name == curve.name),
    };
    let drawn: Vec<&Curve> = curves.iter().filter(is_drawn).collect();
    if curve.len() < 2 || drawn.is_empty() {
        return None;
    }
    let marks = marks(sweep, &curve, &abscissa);
    let mut groups: Vec<Vec<&Curve>> = Vec::new();
    for curve in &drawn {
        match groups.iter_mut().find(|group| !separate && group[0].unit == curve.unit) {
            Some(group) => group.push(curve),
            None => groups.push(vec![curve]),
        }
    }
    let panels = groups.iter().map(|group| panel(&label, group, &abscissa, &marks));
    let over = against.unwrap_or(&sweep.range.parameter);
    let what = drawn.iter().map(|curve| curve.name).collect::<Vec<_>>().join(", ");
    let what = if names.is_empty() { "outputs" } else { &what };
    let title = Figure::new().title(format!("{}: {what} over {over}", sweep.scene));
    Some(panels.fold(title, Figure::panel))
}

fn curves<'a>(sweep: &'a Sweep) -> Vec<Curve<'a>> {
    let points = sweep.curve();
    let curve = |(i, (name, unit)): (usize, (&'a str, &'a str))| {
        let factor = if unit == "rad" { 1f64.to_degrees() } else { 1.0 };
        let unit = if unit == "rad" { "deg" } else { unit };
        let mut values: Vec<f64> = points.iter().map(|point| factor * shown(sweep, point)[i]).collect();
        cut(sweep, &points, &mut values);
        Curve { name, unit, values }
    };
    watched(sweep).into_iter().enumerate().map(curve).collect()
}

/// Removes extreme values at an end of the branch, where forces and speeds may grow without bounds.
fn cut(sweep: &Sweep, points: &[&Point], values: &mut [f64]) {
    let is_end = |point: &Point| sweep.limits.iter().any(|limit| limit.point.value == point.value);
    let others = || points.iter().zip(values.iter()).filter(|(point, _)| !is_end(point)).map(|(_, value)| *value);
    let (low, high) = others().fold((f64::INFINITY, f64::NEG_INFINITY), |(l, h), value| (l.min(value), h.max(value)));
    let wide = low - (high - low)..=high + (high - low);
    let far = |(point, value): &(&&Point, &mut f64)| low < high && is_end(point) && !wide.contains(*value);
    points.iter().zip(values).filter(far).for_each(|(_, value)| *value = f64::NAN);
}

fn label(name: &str, unit: &str) -> String {
    if unit.is_empty() { name.to_string() } else { format!("{name} ({unit})") }
}

/// Returns the positions of the scene's own value and of the ends of the branch on the abscissa.
fn marks(sweep: &Sweep, curve: &[&Point], abscissa: &[f64]) -> Vec<(f64, &'static str)> {
    let place = |point: &Point| curve.iter().position(|known| known.value == point.value).map(|i| abscissa[i]);
    let own = sweep.own.iter().map(|point| (place(point), "design"));
    let ends = sweep.limits.iter().map(|limit| (place(&limit.point), "limit"));
    own.chain(ends).filter_map(|(at, label)| Some((at?, label))).collect()
}

fn panel(x: &str, members: &[&Curve], abscissa: &[f64], marks: &[(f64, &str)]) -> Panel {
    let [first, others @ ..] = members else { return Panel::new(x, "") };
    let is_alone = others.is_empty();
    let y = label(if is_alone { first.name } else { quantity(first.unit) }, first.unit);
    let series = members.iter().map(|curve| {
        let points = abscissa.iter().copied().zip(curve.values.iter().copied()).collect();
        Series::line(if is_alone { "" } else { curve.name }, points)
    });
    let panel = series.fold(Panel::new(x, y), Panel::series);
    marks.iter().fold(panel, |panel, (at, label)| panel.vertical(*at, *label))
}
