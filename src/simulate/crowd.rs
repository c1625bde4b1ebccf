//! Detection of threshold passages that accumulate without end (Zeno behaviour).

use crate::tolerances;
use serde::{Deserialize, Serialize};

/// Turns in a window.
const TURNS_IN_WINDOW: usize = 250;

/// Windows of turns in a row that decide. Where each is shorter and slower than the one before, the motion comes to
/// rest at the threshold. Where all turns are nearer to each other than the tolerance, the motion is lost. Unit:
/// `[windows]`.
const WINDOWS_IN_ROW: usize = 4;

/// Statistics of the threshold passages of a run, in windows of a fixed number.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct Crowd {
    window: Window,
    last: Option<Window>,
    /// Number of successive windows that were each shorter and slower than the one before.
    decaying: usize,
    /// Number of successive windows in which no passage moved the state.
    unseen: usize,
}

#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize)]
struct Window {
    start: f64,
    count: usize,
    duration: f64,
    /// Sum of the rates with which arguments reached thresholds.
    rates: f64,
    moves: bool,
}

impl Crowd {
    /// Counts a passage at `t` with this rate of the argument; `moves` is true if the state differs from that of the
    /// passage before.
    pub fn add(&mut self, t: f64, rate: f64, moves: bool) {
        let Window { start, count, rates, moves: moved, .. } = &mut self.window;
        (*count, *rates, *moved) = (*count + 1, *rates + rate.abs(), *moved || moves);
        if *count < TURNS_IN_WINDOW {
            return;
        }
        self.window.duration = t - *start;
        let is_less = |last: Window| self.window.duration < last.duration && self.window.rates < last.rates;
        self.decaying = if self.last.is_some_and(is_less) { self.decaying + 1 } else { 0 };
        self.unseen = if self.window.moves { 0 } else { self.unseen + 1 };
        self.last = Some(self.window);
        self.window = Window { start: t, ..Window::default() };
    }

    /// Number and duration of the passages in the last window, if the remaining time `left` would not be completed.
    pub fn endless(&self, left: f64) -> Option<(usize, f64)> {
        let duration = self.last?.duration;
        let ahead = TURNS_IN_WINDOW as f64 * left / duration;
        let is_endless = ahead > tolerances::TURNS
            // The turns of a motion that comes to rest at the threshold get ever more.
            || self.decaying >= WINDOWS_IN_ROW && ahead > 1e5
            || self.unseen >= WINDOWS_IN_ROW;
        is_endless.then_some((TURNS_IN_WINDOW, duration))
    }
}
