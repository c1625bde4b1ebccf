//! Ranges of a parameter, written `NAME=A..B:N` or `NAME=A..B:N:log`.

use crate::error::{Error, Result};
use crate::math::expression::constant;
use std::fmt;
use std::str::FromStr;

/// Values of a parameter with equal differences or equal ratios.
#[derive(Clone, Debug, PartialEq)]
pub struct Range {
    /// Name of the parameter.
    pub parameter: String,
    /// First value.
    pub from: f64,
    /// Last value; may be less than the first.
    pub to: f64,
    /// Number of values, ends included.
    pub count: usize,
    /// True for a constant ratio from value to value.
    pub is_log: bool,
}

/// Number of values where none is given.
const COUNT: usize = 81;
/// More values than this are taken for a mistake.
const MOST: usize = 100_000;
const FORM: &str = "write NAME=A..B:N, as in travel=-0.08..0.08:81, or NAME=A..B:N:log for a constant factor";

impl Range {
    /// # Errors
    /// An empty or infinite range, fewer than two values or more than 100 000.
    pub fn new(parameter: impl Into<String>, ends: (f64, f64), count: usize) -> Result<Range> {
        let (from, to) = ends;
        let length = to - from;
        if !length.is_finite() {
            return Err(Error::input(format!("the range from {from} to {to} is not finite")));
        }
        if length.abs() <= 1e-12 * from.abs().max(to.abs()) {
            return Err(Error::input("the range is empty: both ends are the same"));
        }
        if !(2..=MOST).contains(&count) {
            return Err(Error::input(format!("the number of values is {count}; give 2 to {MOST}")));
        }
        Ok(Range { parameter: parameter.into(), from, to, count, is_log: false })
    }

    /// The same range with a constant ratio from value to value.
    ///
    /// # Errors
    /// Ends that are not both above zero.
    pub fn log(self) -> Result<Range> {
        if self.from > 0.0 && self.to > 0.0 {
            Ok(Range { is_log: true, ..self })
        } else {
            Err(Error::input(format!("from {} to {} there is no constant factor", self.from, self.to))
                .hint("give two ends above zero, or leave out `:log`"))
        }
    }

    /// The values from first to last, rounded to the significant decimals, so that 0.3 is not 0.30000000000000004.
    pub fn values(&self) -> Vec<f64> {
        let last = self.count - 1;
        let digits = 14 - self.from.abs().max(self.to.abs()).log10().floor() as i32;
        let round = |value: f64| match digits {
            0..=300 => format!("{value:.*}", digits as usize).parse().unwrap_or(value),
            _ => value,
        };
        let part = |k: usize| k as f64 / last as f64;
        let between = |k: usize| {
            if self.is_log {
                self.from * (self.to / self.from).powf(part(k))
            } else {
                round(self.from * part(last - k) + self.to * part(k))
            }
        };
        (0..self.count)
            .map(|k| {
                if k == 0 {
                    self.from
                } else if k == last {
                    self.to
                } else {
                    between(k)
                }
            })
            .collect()
    }

    /// |to - from|
    pub fn length(&self) -> f64 {
        (self.to - self.from).abs()
    }

    /// True if `value` lies between the ends, ends included.
    pub fn contains(&self, value: f64) -> bool {
        (self.from.min(self.to)..=self.from.max(self.to)).contains(&value)
    }
}

impl FromStr for Range {
    type Err = Error;

    fn from_str(text: &str) -> Result<Range> {
        let form = || Error::input(FORM);
        let (name, values) = text.split_once('=').ok_or_else(form)?;
        let mut parts = values.split(':').map(str::trim);
        let ends = parts.next().unwrap_or_default();
        let (count, is_log) = match (parts.next(), parts.next(), parts.next()) {
            (None, ..) => (COUNT, false),
            (Some("log"), None, _) => (COUNT, true),
            (Some(count), None, _) => (number::<usize>(count, "a whole number")?, false),
            (Some(count), Some("log"), None) => (number::<usize>(count, "a whole number")?, true),
            _ => return Err(form()),
        };
        let (from, to) = ends.split_once("..").ok_or_else(form)?;
        if name.trim().is_empty() {
            return Err(form());
        }
        let end = |text: &str| {
            constant(text).ok_or_else(|| Error::input(format!("`{}` is not a number; {FORM}", text.trim())))
        };
        let ends = (end(from)?, end(to)?);
        let range = Range::new(name.trim(), ends, count)?;
        if is_log { range.log() } else { Ok(range) }
    }
}

fn number<T: FromStr>(text: &str, what: &str) -> Result<T> {
    text.trim().parse().map_err(|_| Error::input(format!("`{text}` is not {what}; {FORM}")))
}

impl fmt::Display for Range {
    fn fmt(&self, out: &mut fmt::Formatter<'_>) -> fmt::Result {
        let spacing = if self.is_log { ":log" } else { "" };
        write!(out, "{}={}..{}:{}{spacing}", self.parameter, self.from, self.to, self.count)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn range(text: &str) -> Range {
        text.parse().unwrap()
    }

    #[test]
    fn ranges_are_read() {
        assert_eq!(range("a=-0.08..0.08:5"), Range::new("a", (-0.08, 0.08), 5).unwrap());
        assert_eq!(range("k1 = 1e3 .. 10 : 2"), Range::new("k1", (1e3, 10.0), 2).unwrap());
        assert_eq!(range("a=0..1").count, 81);
        assert_eq!(range("a=.5...6:3"), Range::new("a", (0.5, 0.6), 3).unwrap());
        assert_eq!(range("a=-1..1:3").to_string(), "a=-1..1:3");
        assert_eq!(range("a=1..2:log").count, 81);
        assert_eq!(range("a=1..100:3:log").to_string(), "a=1..100:3:log");
    }

    #[test]
    fn bad_ranges_are_told() {
        let table = [
            ("travel", FORM),
            ("=1..2:3", FORM),
            ("a=1:3", FORM),
            ("a=1..x:3", "`x` is not a number"),
            ("a=1..2:x", "`x` is not a whole number"),
            ("a=1..2:-3", "`-3` is not a whole number"),
            ("a=1..2:2.5", "`2.5` is not a whole number"),
            ("a=1..2:1", "the number of values is 1; give 2 to"),
            ("a=1..2:1000000", "the number of values is 1000000; give 2 to"),
            ("a=1..1:3", "the range is empty"),
            ("a=0..inf:3", "the range from 0 to inf is not finite"),
            ("a=1..2:3:lin", FORM),
            ("a=1..2:3:log:4", FORM),
            ("a=0..1:3:log", "from 0 to 1 there is no constant factor"),
            ("a=nan..1:3", "the range from NaN to 1 is not finite"),
        ];
        for (text, message) in table {
            let error = text.parse::<Range>().unwrap_err().to_string();
            assert!(error.starts_with(message), "{text}: {error}");
        }
    }

    #[test]
    fn values_are_even_and_short() {
        assert_eq!(range("a=-0.3..0.3:7").values(), [-0.3, -0.2, -0.1, 0.0, 0.1, 0.2, 0.3]);
        assert_eq!(range("a=1000..10:4").values(), [1000.0, 670.0, 340.0, 10.0]);
        let decades = range("a=10..1000:3:log").values();
        assert!(decades[0] == 10.0 && (decades[1] - 100.0).abs() < 1e-12 && decades[2] == 1000.0, "{decades:?}");
        assert_eq!(range("a=0..1e-320:2").values(), [0.0, 1e-320]);
        assert_eq!(range("a=1e300..3e300:3").values()[1], 2e300);
        let values = range("a=-0.08..0.08").values();
        assert!(values.iter().all(|value| value.to_string().len() <= 6), "{values:?}");
    }
}
