//! Marks at multiples of 1, 2, 2.5 or 5 times a power of ten.

use super::decimal::{places, plain, power_of_ten, value};
use super::{Room, Tick, Ticks};

/// Steps in tenths.
const STEPS: [i64; 4] = [10, 20, 25, 50];
/// Largest number of significant digits; longer labels are written relative to an offset.
const MOST_DIGITS: i32 = 6;

/// Marks first * step, (first + 1) * step, ... last * step with step = tenths * 10^(power - 1).
#[derive(Clone, Copy, Debug)]
struct Grid {
    tenths: i64,
    power: i32,
    first: i64,
    last: i64,
}

/// Returns the finest marks whose labels have space.
pub(super) fn ticks(low: f64, high: f64, room: Room, is_angle: bool) -> Ticks {
    let most = if room.along { 8.0 } else { 7.0 };
    let mut best = None;
    let angles = angle_grids(low, high, most).filter(|_| is_angle);
    for grid in angles.chain(grids(low, high, most)) {
        let ticks = grid.ticks(low, high);
        let spacing = room.length * grid.step() / (high - low);
        let needed = room.spacing(ticks.major.iter().map(|tick| tick.label.as_str()));
        if ticks.major.len() >= 2 || best.is_none() {
            best = Some(ticks);
        }
        if spacing >= needed {
            break;
        }
    }
    best.unwrap_or_default()
}

/// Steps of angles, degrees.
const ANGLES: [i64; 8] = [5, 15, 30, 45, 90, 180, 360, 720];

/// Returns grids for angles from fine to coarse, where one has at most `most` steps and more than one.
fn angle_grids(low: f64, high: f64, most: f64) -> impl Iterator<Item = Grid> {
    let (finest, coarsest) = ((high - low) / most, 0.5 * (high - low));
    let steps = ANGLES.into_iter().filter(move |step| (finest..=coarsest).contains(&(*step as f64)));
    steps.map(move |step| Grid::new(step, 0, low, high))
}

/// Returns grids from fine to coarse, beginning with at most `most` steps.
fn grids(low: f64, high: f64, most: f64) -> impl Iterator<Item = Grid> {
    let finest = (high - low) / most;
    let power = finest.log10().floor() as i32;
    let steps = (power..power + 3).flat_map(|power| STEPS.map(|tenths| (tenths, power)));
    let fine = move |(tenths, power): &(i64, i32)| value(*tenths, power - 1) >= finest * (1.0 - 1e-9);
    steps.filter(fine).map(move |(tenths, power)| Grid::new(tenths, power - 1, low, high))
}

impl Grid {
    /// Marks at multiples of tenths * 10^power.
    fn new(tenths: i64, power: i32, low: f64, high: f64) -> Self {
        let step = value(tenths, power);
        // A mark exactly at the limit must not be lost to rounding.
        let (first, last) = ((low / step - 1e-6).ceil() as i64, (high / step + 1e-6).floor() as i64);
        Grid { tenths, power, first, last }
    }

    fn step(&self) -> f64 {
        value(self.tenths, self.power)
    }

    fn ticks(&self, low: f64, high: f64) -> Ticks {
        let numbers: Vec<i64> = (self.first..=self.last).take(50).map(|k| k.saturating_mul(self.tenths)).collect();
        let largest = numbers.iter().map(|n| value(*n, self.power).abs()).fold(0.0, f64::max);
        let (offset, largest) = self.offset(&numbers, largest);
        let relative: Vec<i64> = numbers.iter().map(|n| n.saturating_sub(offset)).collect();
        let factor = common_factor(largest, &relative, self.power);
        let decimals = relative.iter().map(|n| places(*n, self.power - factor)).max().unwrap_or(0);
        let label = |n: &i64| plain(*n, self.power - factor, decimals);
        let at = |n: &i64| (value(*n, self.power) - low) / (high - low);
        let major = numbers.iter().zip(&relative).map(|(n, r)| Tick { at: at(n).clamp(0.0, 1.0), label: label(r) });
        Ticks { major: major.collect(), minor: Vec::new(), factor: factor_text(factor, offset, self.power) }
    }

    /// Returns the number to subtract from all labels because they would be too long, and the largest remainder.
    fn offset(&self, numbers: &[i64], largest: f64) -> (i64, f64) {
        let digits = largest.max(f64::MIN_POSITIVE).log10().floor() as i32 - self.step().log10().floor() as i32;
        let (Some(first), Some(last)) = (numbers.first(), numbers.last()) else { return (0, largest) };
        if digits < MOST_DIGITS {
            return (0, largest);
        }
        let offset = roundest(*first, *last);
        let left = last.saturating_sub(offset).max(offset.saturating_sub(*first));
        (offset, value(left, self.power))
    }
}

/// Returns the number from `first` to `last` with the most zeros at its end.
fn roundest(first: i64, last: i64) -> i64 {
    let units = (0..=18).rev().map(|zeros| 10i64.pow(zeros));
    let multiples = units.map(|unit| last.div_euclid(unit).saturating_mul(unit));
    multiples.into_iter().find(|multiple| *multiple >= first).unwrap_or(first)
}

/// Returns the power of a thousand to take out of the labels when they would have too many digits.
fn common_factor(largest: f64, numbers: &[i64], power: i32) -> i32 {
    if largest <= 0.0 {
        return 0;
    }
    let exponent = (largest.log10() + 1e-9).floor() as i32;
    let decimals = numbers.iter().map(|n| places(*n, power)).max().unwrap_or(0);
    if exponent >= 5 || exponent <= -4 || decimals > 4 { 3 * exponent.div_euclid(3) } else { 0 }
}

fn factor_text(factor: i32, offset: i64, power: i32) -> String {
    let mut text = String::new();
    if factor != 0 {
        text = format!("×{}", power_of_ten(factor));
    }
    if offset != 0 {
        let sign = if offset < 0 { "−" } else { "+" };
        let gap = if text.is_empty() { "" } else { " " };
        text = format!("{text}{gap}{sign} {}", offset_text(offset, power));
    }
    text
}

/// Returns an offset in plain digits when these are few, else as a number times a power of ten.
fn offset_text(offset: i64, power: i32) -> String {
    let digits = offset.unsigned_abs() as i64;
    let size = value(digits, power).log10().floor() as i32;
    if (-4..7).contains(&size) {
        return plain(digits, power, places(digits, power));
    }
    let point = power - size;
    format!("{}×{}", plain(digits, point, places(digits, point)), power_of_ten(size))
}

#[cfg(test)]
mod tests {
    use super::*;

    const ROOM: Room = Room { length: 500.0, size: 16.0, along: true };

    fn labels(low: f64, high: f64) -> (Vec<String>, String) {
        let ticks = ticks(low, high, ROOM, false);
        (ticks.major.into_iter().map(|tick| tick.label).collect(), ticks.factor)
    }

    #[test]
    fn labels_are_short_and_exact() {
        assert_eq!(labels(0.0, 0.6).0, ["0.0", "0.1", "0.2", "0.3", "0.4", "0.5", "0.6"]);
        assert_eq!(labels(0.0, 0.03).0, ["0.000", "0.005", "0.010", "0.015", "0.020", "0.025", "0.030"]);
        assert_eq!(labels(-1.0, 1.0).0, ["−1.0", "−0.5", "0.0", "0.5", "1.0"]);
    }

    #[test]
    fn angles_are_marked_at_parts_of_turns() {
        let labels = |low: f64, high: f64| -> Vec<String> {
            let room = Room { length: 240.0, size: 16.0, along: false };
            ticks(low, high, room, true).major.into_iter().map(|tick| tick.label).collect()
        };
        assert_eq!(labels(-370.0, 10.0), ["−360", "−270", "−180", "−90", "0"]);
        assert_eq!(labels(-95.0, 3.0), ["−90", "−75", "−60", "−45", "−30", "−15", "0"]);
        assert_eq!(labels(0.0, 1.0), ["0.0", "0.2", "0.4", "0.6", "0.8", "1.0"]);
    }

    #[test]
    fn tiny_and_huge_values_share_a_factor() {
        let (tiny, factor) = labels(0.0, 5e-7);
        assert_eq!((tiny[1].as_str(), factor.as_str()), ("100", "×10⁻⁹"));
        let (huge, factor) = labels(0.0, 1e300);
        assert_eq!((huge.last().map(String::as_str), factor.as_str()), (Some("1.0"), "×10³⁰⁰"));
    }

    #[test]
    fn small_changes_of_a_large_value_get_an_offset() {
        let (labels, factor) = labels(19.62, 19.62 + 3e-9);
        assert!(labels.iter().all(|label| label.chars().count() <= 4), "{labels:?}");
        assert_eq!(factor, "×10⁻⁹ + 19.62");
        assert_eq!(roundest(196_199_980, 196_200_020), 196_200_000);
        assert_eq!(roundest(-1_234_567, -1_234_561), -1_234_561);
    }

    #[test]
    fn marks_lie_on_their_values() {
        let ticks = ticks(0.05, 0.95, ROOM, false);
        for tick in ticks.major {
            let value: f64 = tick.label.parse().expect("a number");
            assert!((0.05 + 0.9 * tick.at - value).abs() < 1e-12);
        }
    }
}
