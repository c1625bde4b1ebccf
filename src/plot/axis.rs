//! The axis of all charts: a coordinate of plotters with a scale, limits, marks, their labels, and a title.

use super::AxisSpec;
use super::ticks::{Room, Ticks};
use super::{LABEL_SIZE, Label};
use crate::math::bounds;
use plotters::coord::ranged1d::{KeyPointHint, NoDefaultFormatting, Ranged, ValueFormatter};
use std::ops::Range;

/// Values beyond this are drawn at it, so that differences of values stay finite.
const LARGEST: f64 = 1e300;
/// Smaller differences count as zero, and so do those below this part of the values themselves.
const SMALLEST: f64 = 1e-290;
const NOISE: f64 = 1e-13;
/// Limit of positions outside the axis, in lengths of the axis.
const FAR: f64 = 1e6;

/// Returns the limits of a linear axis with a margin in parts of its length; without, it ends at round numbers that are
/// very near.
fn linear((low, high): (f64, f64), margin: Option<f64>) -> (f64, f64) {
    let span = high - low;
    let middle = 0.5 * low + 0.5 * high;
    if span > least_span(low, high) {
        return margin.map_or_else(|| near_round(low, high), |margin| (low - margin * span, high + margin * span));
    }
    let half = if middle.abs() < SMALLEST { 1.0 } else { 0.1 * middle.abs() };
    (middle - half, middle + half)
}

/// Returns the decimal logarithms of the limits, with at least two labelled decades.
fn decades((low, high): (f64, f64), margin: f64) -> (f64, f64) {
    let low = low.log10();
    let high = high.log10();
    let (low, high) = match ((low + 1e-9).floor(), (high - 1e-9).ceil()) {
        _ if high.floor() - low.ceil() >= 1.0 => (low, high),
        (down, up) if up > down => (down, up),
        (down, up) => (down - 1.0, up + 1.0),
    };
    (low - margin * (high - low), high + margin * (high - low))
}

/// Moves limits outwards to round numbers that are very near: data up to 9.995 get an axis up to 10.
fn near_round(low: f64, high: f64) -> (f64, f64) {
    let step = 10f64.powf((high - low).log10().floor()) / 2.0;
    let near = 0.012 * (high - low);
    let down = (low / step).floor() * step;
    let up = (high / step).ceil() * step;
    (if low - down < near { down } else { low }, if up - high < near { up } else { high })
}

fn least_span(low: f64, high: f64) -> f64 {
    SMALLEST.max(NOISE * low.abs().max(high.abs()))
}

/// A scale with its limits and marks; limits of a logarithmic one are decimal logarithms.
#[derive(Clone, Debug, Default)]
pub(super) struct PlotAxis {
    pub spec: AxisSpec,
    pub low: f64,
    pub high: f64,
    pub ticks: Ticks,
    pub label: Label,
}

impl PlotAxis {
    /// An axis that shows all values which have a place on its scale, without marks.
    pub fn new(spec: &AxisSpec, values: impl Iterator<Item = f64>, margin: Option<f64>) -> Self {
        let is_on_scale = |value: &f64| value.is_finite() && (*value > 0.0 || !spec.is_log);
        let extent = bounds(values.filter(is_on_scale).map(|value| value.clamp(-LARGEST, LARGEST)));
        let fixed = spec.range.filter(|(low, high)| low.abs() <= LARGEST && high.abs() <= LARGEST);
        let (low, high) = match (spec.is_log, fixed) {
            (false, Some((low, high))) if high - low > least_span(low, high) => (low, high),
            (true, Some((low, high))) if low > 0.0 && high > 1.003 * low => (low.log10(), high.log10()),
            _ if extent.0 > extent.1 => (0.0, 1.0),
            (false, _) => linear(extent, margin),
            (true, _) => decades(extent, margin.unwrap_or(0.0)),
        };
        Self { spec: spec.clone(), low, high, ..Self::default() }
    }

    /// Chooses the marks for a length, and breaks the title. There are no texts where a panel below has them.
    pub fn fit(&mut self, room: Room, is_labelled: bool) {
        self.ticks = Ticks::new(self, room);
        let (part, lines) = if room.is_upright { (1.08, 3) } else { (1.0, 2) };
        self.label = Label::new(&self.spec.label, LABEL_SIZE, part * room.length, lines);
        if !is_labelled {
            self.ticks.major.iter_mut().for_each(|tick| tick.1.clear());
            self.ticks.factor.clear();
            self.label = Label::default();
        }
    }

    /// Returns the position of a value: 0 at the lower limit, 1 at the upper one; none for NaN and infinities.
    pub fn place(&self, value: f64) -> Option<f64> {
        let is_log = self.spec.is_log;
        let on_scale = if is_log { value.max(f64::MIN_POSITIVE).log10() } else { value.clamp(-LARGEST, LARGEST) };
        value.is_finite().then(|| ((on_scale - self.low) / (self.high - self.low)).clamp(-FAR, FAR))
    }
}

impl Ranged for PlotAxis {
    type FormatOption = NoDefaultFormatting;
    type ValueType = f64;

    fn map(&self, value: &f64, (from, to): (i32, i32)) -> i32 {
        from + (f64::from(to - from) * self.place(*value).unwrap_or(0.0).clamp(0.0, 1.0)).round() as i32
    }

    /// Returns the labelled marks, or the others if 0 labels are asked for. Only the first have grid lines.
    fn key_points<Hint: KeyPointHint>(&self, hint: Hint) -> Vec<f64> {
        match (hint.weight().allow_light_points(), hint.bold_points()) {
            (true, _) => Vec::new(),
            (false, 0) => self.ticks.minor.clone(),
            (false, _) => self.ticks.major.iter().map(|tick| tick.0).collect(),
        }
    }

    fn range(&self) -> Range<f64> {
        let end = |limit: f64| if self.spec.is_log { 10f64.powf(limit) } else { limit };
        end(self.low)..end(self.high)
    }
}

impl ValueFormatter<f64> for PlotAxis {
    fn format_ext(&self, value: &f64) -> String {
        let tick = self.ticks.major.iter().find(|tick| tick.0 == *value);
        tick.map_or_else(String::new, |tick| tick.1.clone())
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn axis(spec: AxisSpec, values: &[f64]) -> PlotAxis {
        PlotAxis::new(&spec, values.iter().copied(), Some(0.0))
    }

    #[test]
    fn values_map_to_the_unit_interval() {
        let linear = axis("x".into(), &[2.0, 4.0]);
        assert_eq!([2.0, 3.0, 4.0].map(|value| linear.place(value)), [Some(0.0), Some(0.5), Some(1.0)]);
        assert_eq!(linear.place(f64::NAN), None);
        let log = axis(AxisSpec::from("x").log(), &[1e-4, 1.0]);
        assert_eq!([1e-4, 1e-2, 1.0].map(|value| log.place(value)), [Some(0.0), Some(0.5), Some(1.0)]);
        assert_eq!([log.map(&1e-2, (100, 300)), log.map(&1.0, (300, 100))], [200, 100]);
    }

    #[test]
    fn zeros_on_a_log_axis_lie_far_below_all_positive_values() {
        let log = axis(AxisSpec::from("x").log(), &[0.0, -1.0, 3e-9, 1.0]);
        assert_eq!(log.place(3e-9), Some(0.0));
        assert!(log.place(0.0) < Some(-30.0) && log.place(-1.0) == log.place(0.0));
    }

    #[test]
    fn degenerate_data_give_a_range() {
        let odd: [&[f64]; 7] =
            [&[], &[0.0], &[5.0, 5.0], &[f64::MAX, f64::MIN], &[5e-324], &[1e300, -1e300], &[f64::NAN, f64::INFINITY]];
        for values in odd {
            for spec in [AxisSpec::from("x"), AxisSpec::from("x").log()] {
                let axis = axis(spec, values);
                assert!(axis.low.is_finite() && axis.high.is_finite() && axis.low < axis.high, "{values:?} {axis:?}");
            }
        }
    }
}
