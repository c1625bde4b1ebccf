//! Marks of an axis: multiples of 1, 2, 2.5 or 5 times a power of ten, powers of ten, or names.

use super::{PlotAxis, TICK_SIZE, text};

/// Steps of angles, degrees.
const ANGLES: [f64; 8] = [5.0, 15.0, 30.0, 45.0, 90.0, 180.0, 360.0, 720.0];
/// Numbers of decades between labels.
const STRIDES: [i32; 13] = [1, 2, 3, 4, 5, 10, 15, 20, 25, 50, 100, 200, 500];
/// Powers of ten that numbers of the machine reach.
const POWERS: (i32, i32) = (-307, 307);

#[derive(Clone, Debug, Default, PartialEq)]
pub(super) struct Ticks {
    /// Values with their labels.
    pub major: Vec<(f64, String)>,
    /// Values without one.
    pub minor: Vec<f64>,
    /// Factor or offset of all labels, like "×10^-6"; may be empty.
    pub factor: String,
}

/// Length of an axis in pixels; true if its labels stand one above another, as on y.
#[derive(Clone, Copy, Debug)]
pub(super) struct Room {
    pub length: f64,
    pub is_upright: bool,
}

impl Ticks {
    pub fn new(axis: &PlotAxis, room: Room) -> Self {
        if !axis.spec.names.is_empty() {
            return named(axis, room);
        }
        let limits = (axis.low, axis.high);
        if axis.spec.is_log { log(limits, room) } else { linear(limits, room, axis.spec.is_angle) }
    }

    /// Returns the least distance of marks at which their labels do not touch.
    fn spacing(&self, room: Room) -> f64 {
        if room.is_upright { 2.2 * TICK_SIZE } else { self.widest().max(TICK_SIZE) + 0.9 * TICK_SIZE }
    }

    fn labelled(major: impl Iterator<Item = (f64, String)>) -> Self {
        Self { major: major.collect(), ..Self::default() }
    }

    pub fn widest(&self) -> f64 {
        self.major.iter().map(|tick| text::width(&tick.1, TICK_SIZE)).fold(0.0, f64::max)
    }
}

/// Sets texts at 0, 1, 2 ..., thinned where there is no space.
fn named(axis: &PlotAxis, room: Room) -> Ticks {
    let place = |value: f64| axis.place(value).unwrap_or(0.0);
    let all = || axis.spec.names.iter().enumerate().map(|(k, name)| (k as f64, name.clone()));
    let label = if room.is_upright { 1.05 * TICK_SIZE } else { Ticks::labelled(all()).widest() + TICK_SIZE };
    let stride = (label / (room.length * (place(1.0) - place(0.0))).max(1e-9)).ceil().clamp(1.0, 1e6) as usize;
    Ticks::labelled(all().step_by(stride).filter(|tick| (0.0..=1.0).contains(&place(tick.0))))
}

/// Returns the finest marks whose labels have space.
fn linear((low, high): (f64, f64), room: Room, is_angle: bool) -> Ticks {
    let span = high - low;
    let finest = span / if room.is_upright { 7.0 } else { 8.0 };
    let angles = ANGLES.into_iter().filter(|step| is_angle && *step <= 0.5 * span);
    let power = finest.log10().floor() as i32;
    let decimal = (power..power + 2).flat_map(|power| [1.0, 2.0, 2.5, 5.0].map(|digit| digit * 10f64.powi(power)));
    let steps = angles.chain(decimal).filter(|step| *step >= finest * (1.0 - 1e-9));
    let mut marks = steps.map(|step| (room.length * step / span, multiples(low, high, step)));
    let first = marks.find(|(distance, ticks)| ticks.major.len() < 3 || *distance >= ticks.spacing(room));
    first.map_or_else(|| multiples(low, high, 0.5 * span), |(_, ticks)| ticks)
}

fn multiples(low: f64, high: f64, step: f64) -> Ticks {
    // A mark exactly at the limit must not be lost to rounding.
    let first = (low / step - 1e-6).ceil();
    let last = (high / step + 1e-6).floor();
    let values: Vec<f64> = (0..50).map(|k| (first + f64::from(k)) * step).take_while(|v| *v <= last * step).collect();
    let largest = |offset: f64| values.iter().map(|value| (value - offset).abs()).fold(f64::MIN_POSITIVE, f64::max);
    let is_long = largest(0.0).log10().floor() - step.log10().floor() >= 6.0;
    let offset = if is_long { first * step } else { 0.0 };
    let text = if is_long { signed(offset, step) } else { String::new() };
    let exponent = (largest(offset).log10() + 1e-9).floor() as i32;
    let has_factor = exponent >= 5 || exponent <= -4 || decimals(step, 0) > 4;
    let factor = if has_factor && largest(offset) >= 0.5 * step { 3 * exponent.div_euclid(3) } else { 0 };
    let label = |value: f64| plain((value - offset) / 10f64.powi(factor), decimals(step, factor));
    let power = if factor == 0 { String::new() } else { format!("×10^{factor} ") };
    let factor = (power + &text).trim_end().to_string();
    Ticks { factor, ..Ticks::labelled(values.iter().map(|value| (*value, label(*value)))) }
}

/// Returns a number with so many digits after the point and a true minus sign.
fn plain(value: f64, places: usize) -> String {
    let text = format!("{value:.places$}");
    let is_zero = !text.contains(|digit| ('1'..='9').contains(&digit));
    text.replace('-', if is_zero { "" } else { "−" })
}

/// Returns the number of digits after the point that multiples of a step need, in units of a power of ten.
fn decimals(step: f64, power: i32) -> usize {
    let scaled = |digits: i32| step / 10f64.powi(power - digits);
    let is_whole = |digits: &i32| (scaled(*digits) - scaled(*digits).round()).abs() < 1e-6 * scaled(*digits);
    (0..330).find(is_whole).unwrap_or(0) as usize
}

/// Returns an offset with its sign and the digits that its step needs.
fn signed(offset: f64, step: f64) -> String {
    let size = offset.abs().max(f64::MIN_POSITIVE).log10().floor() as i32;
    let (unit, factor) = if (-4..7).contains(&size) { (0, String::new()) } else { (size, format!("×10^{size}")) };
    let digits = plain(offset.abs() / 10f64.powi(unit), decimals(step, unit));
    let short = if digits.contains('.') { digits.trim_end_matches('0').trim_end_matches('.') } else { &digits };
    format!("{} {short}{factor}", if offset < 0.0 { "−" } else { "+" })
}

/// Returns marks at powers of ten between 10^low and 10^high, thinned so that their labels do not touch.
fn log((low, high): (f64, f64), room: Room) -> Ticks {
    let decade = room.length / (high - low);
    let powers = ((low - 1e-9).ceil() as i32).max(POWERS.0)..=((high + 1e-9).floor() as i32).min(POWERS.1);
    let at = |power: i32| (10f64.powi(power), format!("10^{power}"));
    let needed = Ticks::labelled([*powers.start(), *powers.end()].into_iter().map(at)).spacing(room);
    let stride = STRIDES.into_iter().find(|stride| f64::from(*stride) * decade >= needed).unwrap_or(1000);
    let (labelled, between): (Vec<i32>, Vec<i32>) = powers.partition(|power| power.rem_euclid(stride) == 0);
    let minor = match stride {
        1 if decade >= 30.0 => {
            let decades = (low.floor() as i32).max(POWERS.0)..=(high.floor() as i32).min(POWERS.1);
            let within = decades.flat_map(|power| (2..10).map(move |digit| f64::from(digit) * 10f64.powi(power)));
            within.filter(|value| (low..high).contains(&value.log10())).collect()
        }
        2.. if decade >= 4.0 => between.into_iter().map(|power| 10f64.powi(power)).collect(),
        _ => Vec::new(),
    };
    Ticks { minor, ..Ticks::labelled(labelled.into_iter().map(at)) }
}

#[cfg(test)]
mod tests {
    use super::*;

    const ROOM: Room = Room { length: 500.0, is_upright: false };
    const UPWARDS: Room = Room { length: 200.0, is_upright: true };

    fn labels(ticks: &Ticks) -> Vec<&str> {
        ticks.major.iter().map(|tick| tick.1.as_str()).collect()
    }

    #[test]
    fn labels_are_short_and_exact() {
        let at = |low, high| linear((low, high), ROOM, false);
        assert_eq!(labels(&at(0.0, 0.6)), ["0.0", "0.1", "0.2", "0.3", "0.4", "0.5", "0.6"]);
        assert_eq!(labels(&at(0.0, 0.03)), ["0.000", "0.005", "0.010", "0.015", "0.020", "0.025", "0.030"]);
        assert_eq!(labels(&at(-1.0, 1.0)), ["−1.0", "−0.5", "0.0", "0.5", "1.0"]);
        assert_eq!([plain(-0.0, 1), plain(-0.025, 3), plain(700.0, 0)], ["0.0", "−0.025", "700"]);
        assert_eq!([decimals(2.5, 0), decimals(0.02, 0), decimals(2e-9, -9), decimals(500.0, 3)], [1, 2, 0, 1]);
    }

    #[test]
    fn angles_are_marked_at_parts_of_turns() {
        let at = |low, high| linear((low, high), Room { length: 240.0, is_upright: true }, true);
        assert_eq!(labels(&at(-370.0, 10.0)), ["−360", "−270", "−180", "−90", "0"]);
        assert_eq!(labels(&at(-95.0, 3.0)), ["−90", "−75", "−60", "−45", "−30", "−15", "0"]);
        assert_eq!(labels(&at(0.0, 1.0)), ["0.0", "0.2", "0.4", "0.6", "0.8", "1.0"]);
    }

    #[test]
    fn tiny_and_huge_values_share_a_factor() {
        let tiny = linear((0.0, 5e-7), ROOM, false);
        assert_eq!((labels(&tiny)[1], tiny.factor.as_str()), ("100", "×10^-9"));
        let huge = linear((0.0, 1e300), ROOM, false);
        assert_eq!((labels(&huge).last(), huge.factor.as_str()), (Some(&"1.0"), "×10^300"));
    }

    #[test]
    fn small_changes_of_a_large_value_get_an_offset() {
        let ticks = linear((19.62, 19.62 + 3e-9), ROOM, false);
        assert!(labels(&ticks).iter().all(|label| label.chars().count() <= 4), "{ticks:?}");
        assert_eq!(ticks.factor, "×10^-9 + 19.62");
        assert_eq!([signed(196_200_000.0, 10.0), signed(-1_234_567.0, 1.0)], ["+ 1.962×10^8", "− 1234567"]);
    }

    #[test]
    fn marks_lie_on_their_values() {
        for (value, label) in linear((0.05, 0.95), ROOM, false).major {
            assert!((label.parse::<f64>().expect("a number") - value).abs() < 1e-12);
        }
    }

    #[test]
    fn decades_are_thinned_to_multiples_of_a_stride() {
        let ticks = log((-17.3, -1.8), UPWARDS);
        assert_eq!(labels(&ticks), ["10^-15", "10^-12", "10^-9", "10^-6", "10^-3"]);
        assert_eq!(ticks.minor.len(), 11);
        let few = log((-2.0, 1.0), UPWARDS);
        assert_eq!((few.major.len(), few.minor.len()), (4, 24));
        let extreme = log((-300.0, 300.0), UPWARDS);
        assert!((3..10).contains(&extreme.major.len()), "{}", extreme.major.len());
    }
}
