//! The end of a travel: the time from which on the joints can no longer follow a driver.
//!
//! There G(q, t) loses rank, and phi_t has a part along the lost row: phi' = G v + phi_t = 0 has no solution v.

use super::diagnosis::is_length;
use super::{Metric, closing, continuation};
use crate::error::significant;
use crate::math::largest;
use crate::system::{Group, MechanicalSystem};
use crate::tolerances;

/// Samples of a driver's value that a message is made of.
const TRAVEL_SAMPLES: u32 = 400;

/// Looks ahead for the end of a travel, each twice as far as the one before, from a millionth of the time on.
const TRAVEL_LOOKS: i32 = 20;

/// The joints of a system with drivers, closed at one time after the other.
pub struct Travel<'a> {
    metric: Metric<'a>,
    driven: Vec<Group>,
    /// The last closed state.
    last: (f64, Vec<f64>),
    /// The state that is being closed, and the way to it.
    trial: Vec<f64>,
    moved: Vec<f64>,
}

/// The end of a travel.
#[derive(Clone, Debug, PartialEq)]
pub struct TravelEnd {
    /// Time, s.
    pub t: f64,
    /// The driver, the value that it asks for and the value at the end.
    pub reason: String,
}

impl<'a> Travel<'a> {
    /// Begins at a consistent state; `None` for a system without drivers.
    pub fn new(system: &'a dyn MechanicalSystem, t: f64, q: &[f64]) -> Option<Self> {
        let rows: Vec<usize> = system.prescribed(t).iter().map(|driven| driven.row).collect();
        let mut driven = system.facts().groups();
        driven.retain(|group| group.rows.clone().any(|row| rows.contains(&row)));
        if driven.is_empty() {
            return None;
        }
        let moved = vec![0.0; system.dimensions().v];
        let last = (t, q.to_vec());
        Some(Travel { metric: Metric::new(system, Vec::new()), driven, last, trial: q.to_vec(), moved })
    }

    /// True if there are as many constraints as velocities.
    pub fn is_determined(&self) -> bool {
        self.metric.scales.len() >= self.metric.system.dimensions().moving()
    }

    /// The end of the travel if the joints do not close at `t`, neither near q nor on the way there from the last
    /// closed state; `until` is the end of the run.
    pub fn end_before(&mut self, t: f64, q: &[f64], until: f64) -> Option<TravelEnd> {
        self.trial.copy_from_slice(q);
        if self.closes(t) {
            self.take(t);
            return None;
        }
        // A driver without a value there, such as a signal beyond its points, is no end of a travel.
        if self.metric.system.prescribed(t).iter().any(|driven| driven.value.is_some_and(|value| !value.is_finite())) {
            return None;
        }
        let start = self.last.0;
        let resolution = tolerances::ROUND_OFF_OF_SOLUTIONS * (until - start).abs() + f64::EPSILON * t.abs();
        continuation(start, t, t - start, resolution, |next| {
            let is_closed = self.closes_from_last(next);
            if is_closed {
                self.take(next);
            }
            is_closed.then_some(2.0)
        });
        if self.last.0 >= t { None } else { Some(self.end(until)) }
    }

    /// The end of the travel if it comes within `ahead` after a state. A driver may come back soon after the end, so that
    /// the looks begin near the state, each twice as far as the one before.
    pub fn end_within(&mut self, t: f64, q: &[f64], ahead: f64, until: f64) -> Option<TravelEnd> {
        self.end_before(t, q, until).or_else(|| {
            (0..=TRAVEL_LOOKS).find_map(|look| {
                let from = self.last.1.clone();
                self.end_before(t + ahead * 0.5f64.powi(TRAVEL_LOOKS - look), &from, until)
            })
        })
    }

    /// Closes the state on trial; true if it was near a closed one.
    fn closes(&mut self, t: f64) -> bool {
        let Travel { metric, trial, moved, .. } = self;
        let size = 1.0 + largest(metric.system.dimensions().without_turns(trial));
        moved.fill(0.0);
        let is_closed = closing::attempt(metric, t, trial, moved).unwrap_or(false);
        // Other configurations are farther.
        is_closed && largest(moved) <= 0.1 * size
    }

    /// True if a state near the last one is closed at `t`; that is on trial then.
    fn closes_from_last(&mut self, t: f64) -> bool {
        self.trial.copy_from_slice(&self.last.1);
        self.closes(t)
    }

    /// Takes the state on trial as the last one.
    fn take(&mut self, t: f64) {
        self.last.0 = t;
        std::mem::swap(&mut self.last.1, &mut self.trial);
    }

    /// The end at the last closed state.
    fn end(&mut self, until: f64) -> TravelEnd {
        let t = self.last.0;
        let blamed = (0..self.driven.len()).find(|driven| self.closes_without(*driven, until)).unwrap_or(0);
        let Group { name, rows, .. } = &self.driven[blamed];
        let row = rows.start;
        let reason = match self.asked(row, until) {
            Some((asked, reached)) => {
                let unit = if is_length(&self.metric.system.facts().names.lambda[row]) { "m" } else { "rad" };
                let asked = significant(asked, tolerances::DIGITS_OF_TRAVEL);
                let reached = significant(reached, tolerances::DIGITS_OF_TRAVEL);
                format!(
                    "the driver `{name}` later asks for {asked} {unit}, and its travel ends at {reached} {unit}: the joints reach \
                     no farther"
                )
            }
            None => format!("the joint `{name}`, which depends on time, comes to the end of its travel"),
        };
        TravelEnd { t, reason }
    }

    /// True if the joints close beyond the end without a driver.
    fn closes_without(&mut self, driven: usize, until: f64) -> bool {
        let t = self.last.0;
        let rows: Vec<usize> = self.driven[driven].rows.clone().collect();
        self.metric.drop_rows(&rows);
        let is_closed = self.closes_from_last(t + tolerances::UNSEEN * (until - t));
        self.metric.drop_rows(&[]);
        is_closed
    }

    /// The extreme that a driver asks for before it comes back to the value of the end, and that value.
    fn asked(&self, row: usize, until: f64) -> Option<(f64, f64)> {
        let t = self.last.0;
        let value = |t: f64| self.metric.system.prescribed(t).iter().find(|driven| driven.row == row)?.value;
        let reached = value(t)?;
        let apart = (until - t) / f64::from(TRAVEL_SAMPLES);
        let mut farthest = t;
        let mut asked = reached;
        for sample in 1..=TRAVEL_SAMPLES {
            let ahead = t + f64::from(sample) * apart;
            let beyond = value(ahead)? - reached;
            if beyond * (asked - reached) < 0.0 {
                break;
            }
            if beyond.abs() > (asked - reached).abs() {
                (farthest, asked) = (ahead, reached + beyond);
            }
        }
        // The extreme is between the neighbours of the sample.
        let mut low = f64::max(farthest - apart, t);
        let mut high = f64::min(farthest + apart, until);
        // (2/3)^60 is below round-off.
        for _ in 0..60 {
            let left = low + 1.0 / 3.0 * (high - low);
            let right = low + 2.0 / 3.0 * (high - low);
            if (value(left)? - reached).abs() < (value(right)? - reached).abs() { low = left } else { high = right }
        }
        Some((value(0.5 * (low + high))?, reached))
    }
}
