//! Signals whose argument is beyond their points for most of a run.

mod end;

use crate::error::Warning;
use crate::math::Rate;
use crate::simulate::Observation;
use crate::system::{MechanicalSystem, OperatingPoint, Scratch};
use end::SignalEnd;

/// The signals of a system that keep the value of an end where measured data end, and for how long they do.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct HeldSignals {
    ends: Vec<SignalEnd>,
    arguments: Vec<Rate>,
    /// Time of the first and of the last row, s.
    span: Option<(f64, f64)>,
}

impl HeldSignals {
    /// Before the first row.
    pub fn new(system: &dyn MechanicalSystem) -> Self {
        let switches = system.switches().all;
        let mut ends = Vec::new();
        for (number, switch) in switches.iter().enumerate() {
            let Some(signal) = &switch.signal else { continue };
            let [first, last] = signal.range();
            for (is_last, at, sign) in [(false, first, -1.0), (true, last, 1.0)] {
                let Some(value) = signal.cut_off(is_last) else { continue };
                let signal = signal.name().to_string();
                ends.push(SignalEnd::new(number, signal, at, sign, value));
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
        // Most of the run.
        let longest = 0.5 * (last - first);
        let mut named: Vec<&SignalEnd> = Vec::new();
        for end in self.ends.iter().filter(|end| end.seconds > longest) {
            if named.iter().all(|other| other.signal != end.signal) {
                named.push(end);
            }
        }
        named.into_iter().map(|end| end.warning(last - first)).collect()
    }
}
