//! Signals whose argument is beyond their points for most of a run.

use crate::error::{Warning, percent, short};
use crate::math::Rate;
use crate::simulate::Observation;
use crate::system::{MechanicalSystem, OperatingPoint, Scratch};
use crate::tolerances::report as tolerances;

/// The signals of a system that keep the value of an end where measured data end, and for how long they do.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct HeldSignals {
    ends: Vec<End>,
    arguments: Vec<Rate>,
    /// Time of the first and of the last row, s.
    span: Option<(f64, f64)>,
}

/// An end of a signal beyond which its value is kept.
#[derive(Clone, Debug, PartialEq)]
struct End {
    /// Number of the switching function that is the signal's argument.
    number: usize,
    signal: String,
    /// Argument at the end, and 1 where larger ones are beyond it, -1 where smaller ones are.
    at: f64,
    sign: f64,
    value: f64,
    /// Distance of the argument beyond the end at the last row.
    beyond: f64,
    /// Time beyond the end, s, and the time at which it was passed first, s.
    seconds: f64,
    from: f64,
}

impl HeldSignals {
    /// Before the first row.
    pub fn new(system: &dyn MechanicalSystem) -> Self {
        let switches = system.switches();
        let mut ends = Vec::new();
        for (number, switch) in switches.iter().enumerate() {
            let Some(signal) = &switch.signal else { continue };
            let [first, last] = signal.range();
            for (is_last, at, sign) in [(false, first, -1.0), (true, last, 1.0)] {
                let Some(value) = signal.cut_off(is_last) else { continue };
                let signal = signal.name().to_string();
                ends.push(End { number, signal, at, sign, value, beyond: 0.0, seconds: 0.0, from: f64::INFINITY });
            }
        }
        let arguments = if ends.is_empty() { Vec::new() } else { vec![Rate::fixed(0.0); switches.len()] };
        HeldSignals { ends, arguments, span: None }
    }

    /// Adds a row. Between rows arguments are taken to be linear.
    pub fn add(&mut self, system: &dyn MechanicalSystem, state: &Observation, scratch: &mut Scratch) {
        if self.ends.is_empty() {
            return;
        }
        let at = OperatingPoint { vdot: &[], ..state.loaded() };
        system.switching(at, &mut self.arguments, scratch);
        let before = self.span.map(|(_, last)| last);
        for end in &mut self.ends {
            end.add(before, state.t, self.arguments[end.number].re);
        }
        self.span = Some((self.span.map_or(state.t, |(first, _)| first), state.t));
    }

    /// Returns a warning for each signal that keeps the value of an end for most of the run.
    pub fn warnings(&self) -> Vec<Warning> {
        let Some((first, last)) = self.span else { return Vec::new() };
        let longest = tolerances::HELD_SIGNAL * (last - first);
        let mut named: Vec<&End> = Vec::new();
        for end in self.ends.iter().filter(|end| end.seconds > longest) {
            if named.iter().all(|other| other.signal != end.signal) {
                named.push(end);
            }
        }
        named.into_iter().map(|end| end.warning(last - first)).collect()
    }
}

impl End {
    fn add(&mut self, before: Option<f64>, t: f64, argument: f64) {
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

    fn warning(&self, seconds: f64) -> Warning {
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
            let mut end = End {
                number: 0,
                signal: "f".to_string(),
                at: 0.0,
                sign,
                value: 0.0,
                beyond: 0.0,
                seconds: 0.0,
                from: f64::INFINITY,
            };
            end.add(None, 0.0, -5.0);
            end.add(Some(0.0), 0.8, 3.0);
            end.add(Some(0.8), 2.0, 15.0);
            // Sums of a few numbers of size 1.
            assert!((end.seconds - seconds).abs() < 1e-15 && (end.from - from).abs() < 1e-15, "{end:?}");
        }
    }
}
