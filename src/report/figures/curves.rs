//! Curves stacked in panels, so that the course of each can be seen.

use super::{grouped, label, quantity};
use crate::error::clock;
use crate::math::{bounds, largest};
use crate::plot::{Item, ItemForm, Panel, Series, Spot, Tint};

/// A curve of a figure, with the name and the unit of its quantity.
pub(in crate::report) struct Curve<'a> {
    pub name: &'a str,
    pub unit: &'a str,
    pub points: Vec<(f64, f64)>,
    /// Error bar at each point; none where the error is not known.
    pub bar: &'a [f64],
}

pub(in crate::report) struct Stack<'a> {
    pub curves: Vec<Curve<'a>>,
    /// True if the change of each curve since its beginning, x₀, is drawn.
    pub is_change: bool,
}

/// Ratio of two ranges above which curves do not share a panel.
/// Unit: [1]. Why: at a tenth of a panel, some 20 pixels, the course of a curve can just be read. Test:
/// `ranges_that_differ_tenfold_are_drawn_apart`.
const APART: f64 = 10.0;
/// A curve that uses less of its panel, because the curves lie far from each other, is drawn as its change.
/// Unit: [1] of the panel. Why: half of what `APART` allows. Test: `curves_far_from_each_other_are_drawn_as_changes`.
const LITTLE: f64 = 0.05;
/// Changes that are smaller would need marks of five digits and more.
/// Unit: [1] of the largest value. Why: marks of four digits are the longest that are read at a glance. Test:
/// `what_is_nearly_constant_is_drawn_as_its_change`.
const NEARLY_CONSTANT: f64 = 1e-4;
/// A curve whose range is smaller is a constant beside the others: it gets no panel for its round-off.
/// Unit: [1] of the largest range. Why: below the tolerance of nearly all runs. Test:
/// `round_off_gets_no_panel_of_its_own`.
const FLAT: f64 = 1e-9;
/// Changes that are smaller are rounding: the value tells all.
/// Unit: [1] of the value. Why: rounding adds up in outputs. Test: `what_is_nearly_constant_is_drawn_as_its_change`.
const CONSTANT: f64 = 1e-13;
/// A band of error bars that is narrower is hidden by its curve.
/// Unit: [1] of the range of the curve. Why: half the width of a line. Test: `an_error_bar_that_is_seen_is_a_band`.
const SEEN: f64 = 2e-3;
/// A constant joins a panel if it becomes no higher than this.
/// Unit: [1] of its height without. Why: the others keep half of the panel. Test: `a_constant_joins_what_is_near`.
const WIDER: f64 = 2.0;

impl Curve<'_> {
    fn values(&self) -> impl Iterator<Item = f64> {
        self.points.iter().map(|point| point.1).filter(|value| value.is_finite())
    }

    /// Returns the first value, x₀; 0 without one.
    fn start(&self) -> f64 {
        self.values().next().unwrap_or(0.0)
    }

    /// Returns the difference of the largest and the smallest value; 0 if that is rounding.
    fn range(&self) -> f64 {
        let (low, high) = bounds(self.values());
        if high - low > CONSTANT * largest(&[low, high]) { high - low } else { 0.0 }
    }
}

/// Returns the curves by panels: those of one unit together if their ranges are alike; with `separate` one a panel.
pub(in crate::report) fn stacked<'a>(
    curves: impl IntoIterator<Item = Curve<'a>>,
    separate: bool,
) -> impl Iterator<Item = Stack<'a>> {
    let groups = grouped(curves, |curve| (curve.unit, separate.then_some(curve.name)));
    groups.into_iter().flat_map(apart).map(|curves| Stack { is_change: is_change(&curves), curves })
}

/// Splits curves of one unit whose ranges differ by more than [`APART`].
fn apart(curves: Vec<Curve>) -> Vec<Vec<Curve>> {
    let ranges: Vec<f64> = curves.iter().map(Curve::range).collect();
    let flat = FLAT * largest(&ranges);
    let mut sorted: Vec<f64> = ranges.iter().copied().filter(|range| *range > flat).collect();
    sorted.sort_by(|a, b| b.total_cmp(a));
    // The largest range of each panel.
    let mut tops: Vec<f64> = Vec::new();
    sorted.into_iter().for_each(|range| match tops.last() {
        Some(top) if APART * range >= *top => {}
        _ => tops.push(range),
    });
    let panel_of = |range: f64| tops.iter().rposition(|top| range > flat && range <= *top);
    let mut members: Vec<Vec<usize>> = vec![Vec::new(); tops.len()];
    let mut constant = Vec::new();
    for (place, range) in ranges.iter().enumerate() {
        panel_of(*range).map_or(&mut constant, |panel| &mut members[panel]).push(place);
    }
    let mut alone = Vec::new();
    for place in constant {
        let near = members.iter_mut().find(|members| is_near(&curves, members, place));
        near.unwrap_or(&mut alone).push(place);
    }
    members.push(alone);
    in_order(curves, members)
}

/// True if a constant does not make the panel of some curves much higher.
fn is_near(curves: &[Curve], members: &[usize], constant: usize) -> bool {
    let values = || members.iter().flat_map(|place| curves[*place].values());
    let ((low, high), (all_low, all_high)) = (bounds(values()), bounds(values().chain(curves[constant].values())));
    all_high - all_low <= WIDER * (high - low)
}

/// Returns the curves of each panel in their order, and the panels in that of their first curves.
fn in_order<'a>(curves: Vec<Curve<'a>>, mut members: Vec<Vec<usize>>) -> Vec<Vec<Curve<'a>>> {
    members.retain(|members| !members.is_empty());
    members.iter_mut().for_each(|members| members.sort_unstable());
    members.sort_unstable();
    let mut curves: Vec<Option<Curve>> = curves.into_iter().map(Some).collect();
    members.into_iter().map(|members| members.into_iter().filter_map(|place| curves[place].take()).collect()).collect()
}

/// True if the changes of the curves are seen, and their values not.
fn is_change(curves: &[Curve]) -> bool {
    let (low, high) = bounds(curves.iter().flat_map(Curve::values));
    let height = high - low;
    let size = largest(&[low, high]);
    if height <= CONSTANT * size {
        return false;
    }
    let ranges: Vec<f64> = curves.iter().map(Curve::range).collect();
    let flat = FLAT * largest(&ranges);
    let smallest = ranges.into_iter().filter(|range| *range > flat).fold(f64::INFINITY, f64::min);
    let (low, high) = bounds(curves.iter().flat_map(|curve| curve.values().map(|value| value - curve.start())));
    height < NEARLY_CONSTANT * size || smallest < LITTLE * height && WIDER * (high - low) <= height
}

impl Stack<'_> {
    /// Draws the curves; one alone is named by the axis, several by the legend.
    pub fn panel(self, x: &str) -> Panel {
        let Stack { curves, is_change } = self;
        let Some(Curve { name, unit, .. }) = curves.first() else { return Panel::new(x, "") };
        let is_alone = curves.len() == 1;
        let what = if is_alone { name } else { quantity(unit) };
        let what = if is_change { format!("{what} − x₀") } else { what.to_string() };
        let mut panel = Panel::new(x, label(&what, unit));
        if is_alone && is_change {
            panel = panel.title(start(&curves[0]));
        }
        for curve in curves {
            let name = match (is_alone, is_change) {
                (true, _) => String::new(),
                (false, false) => curve.name.to_string(),
                (false, true) => format!("{}, {}", curve.name, start(&curve)),
            };
            let origin = if is_change { curve.start() } else { 0.0 };
            if largest(curve.bar) > SEEN * curve.range() {
                let color = panel.series.len();
                panel = panel.items([band(&curve, origin, color)]);
            }
            panel = panel.series(Series::line(name, curve.points.iter().map(|(x, y)| (*x, y - origin)).collect()));
        }
        panel
    }
}

/// Returns the area between a curve less and plus its error bar.
fn band(curve: &Curve, origin: f64, color: usize) -> Item {
    let stride = curve.points.len().div_ceil(400);
    let points = curve.points.iter().zip(curve.bar).filter(|((_, y), bar)| y.is_finite() && bar.is_finite());
    let points: Vec<_> = points.step_by(stride).map(|((x, y), bar)| (*x, y - origin, *bar)).collect();
    let upper = points.iter().map(|(x, y, bar)| Spot::data(*x, y + bar));
    let lower = points.iter().rev().map(|(x, y, bar)| Spot::data(*x, y - bar));
    Item { spots: upper.chain(lower).collect(), tint: Tint::Body(color, 0.0), form: ItemForm::Area(0.25) }
}

/// Returns the value that a curve begins with, in words.
fn start(curve: &Curve) -> String {
    let six_digits = format!("{:.5e}", curve.start()).parse().unwrap_or(curve.start());
    let value = clock(six_digits).replace('-', "−");
    format!("x₀ = {value} {}", curve.unit).trim_end().to_string()
}
