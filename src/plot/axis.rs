//! Map from values to positions along an axis.

use super::panel::{AxisSpec, Scale};

/// Values beyond this are drawn at it, so that differences of values stay finite.
const LARGEST: f64 = 1e300;
/// Limit of positions outside the axis, in lengths of the axis.
const FAR: f64 = 1e6;
/// Smaller differences count as zero.
const SMALLEST: f64 = 1e-290;
/// Differences below this part of the values themselves are rounding noise.
const NOISE: f64 = 1e-13;

/// Range of the values along one axis.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Extent {
    low: f64,
    high: f64,
    least_positive: f64,
    negative: bool,
    not_positive: bool,
}

impl Default for Extent {
    fn default() -> Self {
        let (low, high) = (f64::INFINITY, f64::NEG_INFINITY);
        Self { low, high, least_positive: f64::INFINITY, negative: false, not_positive: false }
    }
}

impl Extent {
    pub fn add(&mut self, value: f64) {
        if !value.is_finite() {
            return;
        }
        let value = value.clamp(-LARGEST, LARGEST);
        self.low = self.low.min(value);
        self.high = self.high.max(value);
        self.negative |= value < 0.0;
        self.not_positive |= value <= 0.0;
        if value > 0.0 {
            self.least_positive = self.least_positive.min(value);
        }
    }

    pub fn merge(&mut self, other: &Self) {
        self.low = self.low.min(other.low);
        self.high = self.high.max(other.high);
        self.least_positive = self.least_positive.min(other.least_positive);
        self.negative |= other.negative;
        self.not_positive |= other.not_positive;
    }

    pub fn is_empty(&self) -> bool {
        self.low > self.high
    }
}

/// Margin between the data and the ends of an axis.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) enum Slack {
    /// No margin.
    Exact,
    /// No margin, but limits very near to round numbers are moved there.
    Round,
    /// This part of the length on both sides.
    Part(f64),
}

impl Slack {
    fn part(self) -> f64 {
        if let Self::Part(part) = self { part } else { 0.0 }
    }
}

/// A scale with its limits; those of a logarithmic one are decimal logarithms.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Axis {
    pub scale: Scale,
    pub low: f64,
    pub high: f64,
    pub floor: Option<Floor>,
    /// True for angles in degrees.
    pub is_angle: bool,
}

/// The floor of a logarithmic axis, at which zero and negative values are drawn.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) struct Floor {
    pub exponent: i32,
    /// True if some of these values are negative, not only zero.
    pub negative: bool,
}

impl Axis {
    /// An axis that shows all values.
    pub fn new(spec: &AxisSpec, extent: &Extent, slack: Slack) -> Self {
        match spec.scale {
            Scale::Linear => Self { is_angle: spec.is_angle, ..Self::linear(spec.range, extent, slack) },
            Scale::Log => Self::log(spec.range, extent, slack),
        }
    }

    fn linear(range: Option<(f64, f64)>, extent: &Extent, slack: Slack) -> Self {
        let usable = |(low, high): &(f64, f64)| {
            low.abs() <= LARGEST && high.abs() <= LARGEST && high - low > minimum_span(*low, *high)
        };
        let fixed = range.filter(usable);
        let (low, high) = fixed.unwrap_or_else(|| linear_limits(extent, slack));
        Self { scale: Scale::Linear, low, high, floor: None, is_angle: false }
    }

    fn log(range: Option<(f64, f64)>, extent: &Extent, slack: Slack) -> Self {
        let usable = |(low, high): &(f64, f64)| *low > 0.0 && *high <= LARGEST && high.log10() - low.log10() > 1e-3;
        if let Some((low, high)) = range.filter(usable) {
            return Self { scale: Scale::Log, low: low.log10(), high: high.log10(), floor: None, is_angle: false };
        }
        let floor = floor_below(extent);
        let (low, high) = log_limits(extent, floor);
        let margin = slack.part() * (high - low);
        Self { scale: Scale::Log, low: low - margin, high: high + margin, floor, is_angle: false }
    }

    /// Returns the position of a value: 0 at the lower limit, 1 at the upper one; none for NaN and infinities.
    pub fn place(&self, value: f64) -> Option<f64> {
        if !value.is_finite() {
            return None;
        }
        let value = match self.scale {
            Scale::Linear => value.clamp(-LARGEST, LARGEST),
            Scale::Log if value > 0.0 => value.log10(),
            Scale::Log => self.floor.map_or(self.low, |floor| f64::from(floor.exponent)),
        };
        Some(((value - self.low) / (self.high - self.low)).clamp(-FAR, FAR))
    }

    /// Returns the value in the middle.
    pub fn middle(&self) -> f64 {
        let middle = 0.5 * self.low + 0.5 * self.high;
        if self.scale == Scale::Log { 10f64.powf(middle) } else { middle }
    }
}

fn minimum_span(low: f64, high: f64) -> f64 {
    SMALLEST.max(NOISE * low.abs().max(high.abs()))
}

fn linear_limits(extent: &Extent, slack: Slack) -> (f64, f64) {
    if extent.is_empty() {
        return (0.0, 1.0);
    }
    let (low, high) = (extent.low, extent.high);
    if high - low > minimum_span(low, high) {
        let margin = slack.part() * (high - low);
        return if slack == Slack::Round { near_round(low, high) } else { (low - margin, high + margin) };
    }
    let middle = 0.5 * low + 0.5 * high;
    let half = if middle.abs() < SMALLEST { 1.0 } else { 0.1 * middle.abs() };
    (middle - half, middle + half)
}

/// Moves limits outwards to round numbers that are very near: data up to 9.995 get an axis up to 10.
fn near_round(low: f64, high: f64) -> (f64, f64) {
    let step = 10f64.powf((high - low).log10().floor()) / 2.0;
    let near = 0.012 * (high - low);
    let (down, up) = ((low / step).floor() * step, (high / step).ceil() * step);
    (if low - down < near { down } else { low }, if up - high < near { up } else { high })
}

/// Returns a floor one decade below the smallest positive value, if there is anything to draw at it.
fn floor_below(extent: &Extent) -> Option<Floor> {
    // Without a positive value any floor will do; this one is near the rounding of numbers of size one.
    let least = if extent.least_positive.is_finite() { extent.least_positive } else { 1e-15 };
    let exponent = least.log10().floor() as i32 - 1;
    extent.not_positive.then_some(Floor { exponent, negative: extent.negative })
}

/// Returns the decimal logarithms of the limits, with at least two labelled decades.
fn log_limits(extent: &Extent, floor: Option<Floor>) -> (f64, f64) {
    let (low, high) = match floor {
        _ if extent.is_empty() => (0.0, 1.0),
        Some(floor) if extent.high <= 0.0 => (f64::from(floor.exponent), f64::from(floor.exponent + 2)),
        Some(floor) => (f64::from(floor.exponent), extent.high.log10()),
        None => (extent.least_positive.log10(), extent.high.log10()),
    };
    if high.floor() - low.ceil() >= 1.0 {
        return (low, high);
    }
    let (low, high) = ((low + 1e-9).floor(), (high - 1e-9).ceil());
    if high > low { (low, high) } else { (low - 1.0, high + 1.0) }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn axis(spec: AxisSpec, values: &[f64]) -> Axis {
        let mut extent = Extent::default();
        values.iter().for_each(|value| extent.add(*value));
        Axis::new(&spec, &extent, Slack::Exact)
    }

    #[test]
    fn values_map_to_the_unit_interval() {
        let linear = axis("x".into(), &[2.0, 4.0]);
        assert_eq!(linear.place(3.0), Some(0.5));
        assert_eq!(linear.place(f64::NAN), None);
        let log = axis(AxisSpec::from("x").log(), &[1e-4, 1.0]);
        assert_eq!(log.place(1e-2), Some(0.5));
    }

    #[test]
    fn zeros_on_a_log_axis_lie_below_all_positive_values() {
        let log = axis(AxisSpec::from("x").log(), &[0.0, 3e-9, 1.0]);
        assert_eq!(log.floor, Some(Floor { exponent: -10, negative: false }));
        assert_eq!(log.place(0.0), Some(0.0));
        assert!(log.place(3e-9) > Some(0.1));
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
