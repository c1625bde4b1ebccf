//! Turns at thresholds that crowd without end.

use serde::{Deserialize, Serialize};

/// Turns are looked at in windows of so many.
const WINDOW: usize = 250;
/// A run that has so many turns before it at the rate of the last window does not come to its end.
const MOST: f64 = 5e7;
/// Nor does one with so many where the last windows, this number of them, were each shorter and slower than the one before:
/// the motion comes to rest at the threshold, and the turns get ever more.
const MOST_IN_DECAY: f64 = 1e5;
const DECAY: usize = 4;
/// Nor does one whose turns, in so many windows, were all nearer to each other than the tolerance: it has lost the motion.
const UNSEEN: usize = 2;

/// The turns of a run.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct Crowd {
    window: Window,
    last: Option<Window>,
    /// Windows up to here that were each shorter and slower than the one before, and that moved nothing.
    decaying: usize,
    unseen: usize,
}

#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize)]
struct Window {
    start: f64,
    count: usize,
    duration: f64,
    /// The sum of the rates at which arguments came to thresholds.
    rates: f64,
    moves: bool,
}

impl Crowd {
    /// Counts a turn at `t`, at which the argument had this rate; `moves`: the state is another than at the turn before.
    pub fn add(&mut self, t: f64, rate: f64, moves: bool) {
        let Window { start, count, rates, moves: moved, .. } = &mut self.window;
        (*count, *rates, *moved) = (*count + 1, *rates + rate.abs(), *moved || moves);
        if *count < WINDOW {
            return;
        }
        self.window.duration = t - *start;
        let is_less = |last: Window| self.window.duration < last.duration && self.window.rates < last.rates;
        self.decaying = if self.last.is_some_and(is_less) { self.decaying + 1 } else { 0 };
        self.unseen = if self.window.moves { 0 } else { self.unseen + 1 };
        self.last = Some(self.window);
        self.window = Window { start: t, ..Window::default() };
    }

    /// How many turns took how long, where a run of the span `left` would not come to an end.
    pub fn endless(&self, left: f64) -> Option<(usize, f64)> {
        let duration = self.last?.duration;
        let ahead = WINDOW as f64 * left / duration;
        let is_endless = ahead > MOST || self.decaying >= DECAY && ahead > MOST_IN_DECAY || self.unseen >= UNSEEN;
        is_endless.then_some((WINDOW, duration))
    }
}
