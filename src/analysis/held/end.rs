//! An end of the points of a signal.

use crate::error::{Warning, percent, short};

/// An end of a signal beyond which its value is kept.
#[derive(Clone, Debug, PartialEq)]
pub struct SignalEnd {
    /// Number of the switching function that is the signal's argument.
    pub number: usize,
    pub signal: String,
    /// Argument at the end, and 1 where larger ones are beyond it, -1 where smaller ones are.
    at: f64,
    sign: f64,
    value: f64,
    /// Distance of the argument beyond the end at the last row.
    beyond: f64,
    /// Time beyond the end, s.
    pub seconds: f64,
    /// Time at which it was passed first, s.
    from: f64,
}

impl SignalEnd {
    /// The end at an argument `at` where the signal has a value, before the first row.
    pub fn new(number: usize, signal: String, at: f64, sign: f64, value: f64) -> Self {
        SignalEnd { number, signal, at, sign, value, beyond: 0.0, seconds: 0.0, from: f64::INFINITY }
    }

    /// Adds the argument at the row at `t`, which follows that at `before`.
    pub fn add(&mut self, before: Option<f64>, t: f64, argument: f64) {
        let beyond = self.sign * (argument - self.at);
        let from = std::mem::replace(&mut self.beyond, beyond);
        let Some(before) = before.filter(|_| beyond > 0.0 || from > 0.0) else { return };
        // Place of the end on the line from one row to the next.
        let passage = if from * beyond < 0.0 { from / (from - beyond) } else { 0.0 };
        let part = if beyond > 0.0 {
            1.0 - passage
        } else if passage > 0.0 {
            passage
        } else {
            1.0
        };
        self.seconds += part * (t - before);
        let entered = if from > 0.0 { before } else { before + passage * (t - before) };
        self.from = self.from.min(entered);
    }

    /// Returns a warning about a run of so many seconds.
    pub fn warning(&self, seconds: f64) -> Warning {
        let side = if self.sign > 0.0 { "above" } else { "below" };
        let text = format!(
            "the signal `{}` has no points {side} {}: from t = {} s on it is held at {}, for {} of the run",
            self.signal,
            short(self.at),
            short(self.from),
            short(self.value),
            percent((self.seconds / seconds * 100.0).round() / 100.0),
        );
        Warning::new(text, "give it a longer table, or \"beyond\": \"repeat\"")
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// An argument 10 t - 5 over an end at 0: it is passed at 0.5 s.
    #[test]
    fn the_time_beyond_an_end_is_that_of_lines() {
        for (sign, seconds, from) in [(1.0, 1.5, 0.5), (-1.0, 0.5, 0.0)] {
            let mut end = SignalEnd::new(0, "f".to_string(), 0.0, sign, 0.0);
            end.add(None, 0.0, -5.0);
            end.add(Some(0.0), 0.8, 3.0);
            end.add(Some(0.8), 2.0, 15.0);
            // Sums of a few numbers of size 1.
            assert!((end.seconds - seconds).abs() < 1e-15 && (end.from - from).abs() < 1e-15, "{end:?}");
        }
    }
}
