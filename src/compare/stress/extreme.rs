//! What can be driven to extremes.

use super::case::Case;
use super::extremes::registry;
use super::subject::Subject;
use crate::error::{Error, Result, suggest};

/// Something of a simulation that a map can vary over many powers of ten.
pub struct Extreme {
    pub name: &'static str,
    /// Empty for a ratio.
    pub unit: &'static str,
    pub about: &'static str,
    /// Whether the motion that is to be computed stays the same, so that one reference serves all values.
    pub keeps_motion: bool,
    /// Whether the subject has it.
    pub suits: fn(&Subject) -> bool,
    /// Values where none are given.
    pub values: fn(&Subject) -> Vec<f64>,
    /// Gives the case this value.
    pub apply: fn(&mut Case, f64) -> Result<()>,
}

/// The extreme of this name.
///
/// # Errors
/// An unknown name, with the one that was meant.
pub fn find(name: &str) -> Result<&'static Extreme> {
    let canonical = name.replace('-', "_");
    registry().iter().copied().find(|extreme| extreme.name == canonical).ok_or_else(|| {
        let names = registry().iter().map(|extreme| extreme.name);
        Error::input(format!("there is no extreme `{name}`")).hint(suggest(name, names))
    })
}

/// 1, 2, 5, 10, 20 ... from `low` to `high`.
pub fn ladder(low: f64, high: f64) -> Vec<f64> {
    let decades = low.log10().floor() as i32..=high.log10().ceil() as i32;
    let rungs = decades.flat_map(|exponent| [1, 2, 5].map(|digit| decimal(digit, exponent)));
    rungs.filter(|rung| (low * (1.0 - 1e-9)..=high * (1.0 + 1e-9)).contains(rung)).collect()
}

/// Powers of ten, every `stride`-th.
pub(super) fn decades(from: i32, to: i32, stride: usize) -> Vec<f64> {
    (from..=to).step_by(stride).map(|exponent| decimal(1, exponent)).collect()
}

/// The number nearest to digit 10^exponent.
fn decimal(digit: u32, exponent: i32) -> f64 {
    format!("{digit}e{exponent}").parse().unwrap_or(f64::NAN)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn ladders_have_round_rungs() {
        assert_eq!(ladder(4e-3, 0.11), [5e-3, 0.01, 0.02, 0.05, 0.1]);
        assert_eq!(ladder(1.0, 1.0), [1.0]);
        assert_eq!(decades(-4, 4, 4), [1e-4, 1.0, 1e4]);
    }

    #[test]
    fn unknown_extremes_suggest_the_nearest() {
        assert!(find("mass-ratio").is_ok());
        let error = find("stifness").err().map(|error| error.to_string());
        assert!(error.is_some_and(|error| error.contains("did you mean `stiffness`?")));
    }
}
