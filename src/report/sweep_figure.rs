//! Figure of outputs over a parameter or over one of them.

use super::figures::{Curve, label, stacked};
use super::tables::{shown, watched};
use crate::math::bounds;
use crate::plot::{Figure, Item, ItemForm, Panel, Spot, Tint};
use crate::sweep::{Point, Sweep};

/// Options of the figure of a sweep.
#[derive(Clone, Copy, Debug, Default)]
pub struct SweepLook<'a> {
    /// Outputs; all where none is named.
    pub outputs: &'a [String],
    /// Output along the horizontal axis, instead of the parameter.
    pub against: Option<&'a str>,
    /// True for one panel per output, false for one per unit and size of the range.
    pub separate: bool,
}

/// Draws outputs over the parameter or one of them, angles in degrees; the scene's own position and the ends of the
/// branch are marked. `None` without a curve.
pub fn sweep_figure(sweep: &Sweep, look: SweepLook) -> Option<Figure> {
    let SweepLook { outputs: names, against, separate } = look;
    let curve = sweep.curve();
    let mut curves = curves(sweep);
    let x = against.and_then(|name| curves.iter().find(|curve| curve.name == name));
    let label = x.map_or_else(|| sweep.range.parameter.clone(), |x| label(x.name, x.unit));
    if let Some(x) = x {
        let abscissa: Vec<f64> = x.points.iter().map(|point| point.1).collect();
        let points = curves.iter_mut().flat_map(|curve| curve.points.iter_mut().zip(&abscissa));
        points.for_each(|(point, x)| point.0 = *x);
    }
    let marks = curves.first().map_or(Vec::new(), |first| marks(sweep, &curve, &first.points));
    curves.retain(|curve| match names {
        [] => Some(curve.name) != against,
        names => names.iter().any(|name| name == curve.name),
    });
    if curve.len() < 2 || curves.is_empty() {
        return None;
    }
    let over = against.unwrap_or(&sweep.range.parameter);
    let what = curves.iter().map(|curve| curve.name).collect::<Vec<_>>().join(", ");
    let what = if names.is_empty() { "outputs" } else { &what };
    let marked = |panel| marks.iter().fold(panel, |panel, (at, label)| marked(panel, *at, label));
    let panels = stacked(curves, separate).map(|stack| marked(stack.panel(&label)));
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
        Curve { name, unit, points: points.iter().map(|point| point.value).zip(values).collect(), bar: &[] }
    };
    watched(sweep).into_iter().enumerate().map(curve).collect()
}

/// Removes extreme values at an end of the branch, where forces and speeds may grow without bounds.
fn cut(sweep: &Sweep, points: &[&Point], values: &mut [f64]) {
    let is_end = |point: &Point| sweep.limits.iter().any(|limit| limit.point.value == point.value);
    let others = points.iter().zip(values.iter()).filter(|(point, _)| !is_end(point)).map(|(_, value)| *value);
    let (low, high) = bounds(others);
    let wide = low - (high - low)..=high + (high - low);
    let far = |(point, value): &(&&Point, &mut f64)| low < high && is_end(point) && !wide.contains(*value);
    points.iter().zip(values).filter(far).for_each(|(_, value)| *value = f64::NAN);
}

/// Adds a dashed vertical line with a text.
pub fn marked(panel: Panel, x: f64, text: &str) -> Panel {
    let spots = vec![Spot::data(x, f64::NEG_INFINITY), Spot::data(x, f64::INFINITY)];
    let line = Item { spots, tint: Tint::Ink(0.3), form: ItemForm::Line(1.5, true) };
    panel.items([line]).note(Tint::Ink(0.25), x, f64::INFINITY, text)
}

/// Returns the positions of the scene's own value and of the ends of the branch among the points of a curve.
fn marks(sweep: &Sweep, curve: &[&Point], points: &[(f64, f64)]) -> Vec<(f64, &'static str)> {
    let place = |point: &Point| curve.iter().position(|known| known.value == point.value).map(|i| points[i].0);
    let own = sweep.own.iter().map(|point| (place(point), "design"));
    let ends = sweep.limits.iter().map(|limit| (place(&limit.point), "limit"));
    own.chain(ends).filter_map(|(at, label)| Some((at?, label))).collect()
}
