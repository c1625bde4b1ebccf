//! Marks at powers of ten, thinned so that their labels do not touch. Limits are decimal logarithms.

use super::decimal::power_of_ten;
use super::{Room, Tick, Ticks};

const STRIDES: [i64; 13] = [1, 2, 3, 4, 5, 10, 15, 20, 25, 50, 100, 200, 500];
/// Least length of a decade, in pixels, for marks within it and for marks between labels.
const ROOM_FOR_MINOR: f64 = 30.0;
const ROOM_FOR_DECADE: f64 = 4.0;

/// Returns marks at powers of ten between 10^low and 10^high.
pub(super) fn ticks(low: f64, high: f64, room: Room) -> Ticks {
    let decade = room.length / (high - low);
    let exponents = (low - 1e-9).ceil() as i64..=(high + 1e-9).floor() as i64;
    let widest = [power_of_ten(*exponents.start() as i32), power_of_ten(*exponents.end() as i32)];
    let needed = room.spacing(widest.iter().map(String::as_str));
    let fits = |stride: &&i64| **stride as f64 * decade >= needed;
    let stride = STRIDES.iter().find(fits).copied().unwrap_or(1000);
    let at = |exponent: f64| ((exponent - low) / (high - low)).clamp(0.0, 1.0);
    let labelled = exponents.clone().filter(|exponent| exponent.rem_euclid(stride) == 0);
    let major =
        labelled.map(|exponent| Tick { at: at(exponent as f64), label: power_of_ten(exponent as i32) }).collect();
    let minor = if stride > 1 {
        let between = exponents.filter(|exponent| exponent.rem_euclid(stride) != 0);
        if decade >= ROOM_FOR_DECADE { between.map(|exponent| at(exponent as f64)).collect() } else { Vec::new() }
    } else {
        within(low, high, decade).into_iter().map(at).collect()
    };
    Ticks { major, minor, factor: String::new() }
}

/// Returns logarithms of 2 to 9 times the powers of ten, where a decade has space for them.
fn within(low: f64, high: f64, decade: f64) -> Vec<f64> {
    if decade < ROOM_FOR_MINOR {
        return Vec::new();
    }
    let exponents = low.floor() as i64..=high.floor() as i64;
    let all = exponents.flat_map(|exponent| (2..10).map(move |digit| exponent as f64 + f64::from(digit).log10()));
    all.filter(|at| *at > low && *at < high).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    const ROOM: Room = Room { length: 200.0, size: 16.0, along: false };

    #[test]
    fn decades_are_thinned_to_multiples_of_a_stride() {
        let ticks = ticks(-17.3, -1.8, ROOM);
        let labels: Vec<_> = ticks.major.iter().map(|tick| tick.label.as_str()).collect();
        assert_eq!(labels, ["10⁻¹⁵", "10⁻¹²", "10⁻⁹", "10⁻⁶", "10⁻³"]);
        assert_eq!(ticks.minor.len(), 11);
    }

    #[test]
    fn few_decades_get_minor_marks() {
        let ticks = ticks(-2.0, 1.0, ROOM);
        assert_eq!(ticks.major.len(), 4);
        assert_eq!(ticks.minor.len(), 24);
        assert!((ticks.major[1].at - 1.0 / 3.0).abs() < 1e-12);
    }

    #[test]
    fn extreme_ranges_stay_readable() {
        let ticks = ticks(-300.0, 300.0, ROOM);
        assert!((3..10).contains(&ticks.major.len()), "{}", ticks.major.len());
    }
}
