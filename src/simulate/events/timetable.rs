//! Times at which functions of t change their form.

use super::range::{OpenInterval, first_out};
use super::watch::Watch;
use crate::math::expression::{Switch, TimeFunction};
use crate::math::{Interval, Piece, Regime, Taylor, Thresholds};
use crate::tolerances;

/// Intervals that a search for a change of form may look at; what is left is judged by its ends.
const LOOKS_FOR_CHANGE: usize = 20_000;

/// The functions of time of a run: their changes of form, and the steps that resolve them.
pub struct Timetable<'a> {
    switches: &'a [Switch],
    /// Round-off of the argument of each function of time; zero for others.
    round_off: Vec<f64>,
    pub watch: Watch<'a>,
    end: f64,
    /// The next change of form.
    next: Option<f64>,
}

impl<'a> Timetable<'a> {
    pub fn new(switches: &'a [Switch], functions: &'a [TimeFunction], start: f64, end: f64) -> Self {
        let round_off = switches.iter().map(|switch| round_off(switch, start, end)).collect();
        Timetable { switches, round_off, watch: Watch::new(functions, end - start), end, next: None }
    }

    /// Sets all functions of time to their pieces from `t` on.
    pub fn place(&mut self, t: f64, pieces: &mut [Piece]) {
        for (number, switch) in self.switches.iter().enumerate() {
            if let Some(argument) = &switch.of_time {
                let round_off = self.round_off[number];
                pieces[number] = self.piece_from(t, argument, round_off, &switch.thresholds, pieces);
            }
        }
        self.next = self.find_next(t, pieces);
        self.watch.forget();
    }

    /// Continues at `t` with this next change, from a run whose changes were known up to `end`.
    pub fn recall(&mut self, t: f64, next: Option<f64>, end: f64, pieces: &[Piece]) {
        let is_farther = next.is_none() && self.end > end;
        self.next = if is_farther { self.find_next(t, pieces) } else { next.filter(|next| *next < self.end) };
    }

    /// Moves the end, up to which changes are known, from `old` to `end`.
    pub fn extend(&mut self, t: f64, old: f64, end: f64, pieces: &[Piece]) {
        self.end = end;
        self.recall(t, self.next, old, pieces);
    }

    /// The next time at which a function of time changes its form; `None` if there is none before the end.
    pub fn next_change(&self) -> Option<f64> {
        self.next
    }

    /// The step from `t`, at most `h`, that resolves the functions of time. They are fixed on these pieces up to
    /// `stop`.
    pub fn resolved(&mut self, t: f64, h: f64, stop: f64, pieces: &[Piece]) -> f64 {
        self.watch.resolved(t, h, stop, tolerances::RESOLVED_ROUGHLY, Regime::held(pieces))
    }

    /// The step, at most `h`, on which the functions of time are almost cubics.
    pub fn finely_resolved(&mut self, t: f64, h: f64, pieces: &[Piece]) -> f64 {
        self.watch.forget();
        // A pulse of a tenth of the step is met to 1e-7 by rk4.
        self.watch.resolved(t, h, f64::INFINITY, 1e-4, Regime::held(pieces))
    }

    /// The piece of an argument right after `t`: within round-off of a threshold, the side to which it leaves that.
    fn piece_from(
        &self,
        t: f64,
        argument: &TimeFunction,
        round_off: f64,
        thresholds: &Thresholds,
        pieces: &[Piece],
    ) -> Piece {
        let regime = Regime::held(pieces);
        let x: Taylor<f64> = argument.at(Taylor::time(t), regime);
        let margin = |threshold: f64| round_off.max(8.0 * f64::EPSILON * (threshold.abs() + (x.d * t).abs()));
        let near = thresholds.nearest(x.x).filter(|&(_, threshold)| (x.x - threshold).abs() <= margin(threshold));
        let Some((k, threshold)) = near else { return thresholds.piece(x.x).unwrap_or(0) };
        let range = OpenInterval { low: threshold, high: threshold }.widened(2.0 * margin(threshold));
        let left = ThresholdSearch { argument, range, regime }.first_exit(t, self.end, &mut LOOKS_FOR_CHANGE.clone());
        let side = left.map_or(0, |left| if argument.at(left, regime) > threshold { 1 } else { -1 });
        (2 * k as Piece + 1).wrapping_add_signed(side)
    }

    fn find_next(&self, t: f64, pieces: &[Piece]) -> Option<f64> {
        let mut first: Option<f64> = None;
        for (number, switch) in self.switches.iter().enumerate() {
            let Some(argument) = &switch.of_time else { continue };
            let Some(range) = OpenInterval::of(pieces[number], &switch.thresholds) else { continue };
            let exit = |range: OpenInterval, end: f64| {
                let search = ThresholdSearch { argument, range, regime: Regime::held(pieces) };
                search.first_exit(t, end, &mut LOOKS_FOR_CHANGE.clone())
            };
            // A function that comes to rest on a threshold crosses it many times within round-off.
            let leaves = exit(range.widened(self.round_off[number]), first.unwrap_or(self.end));
            first = leaves.map(|left| exit(range, left).unwrap_or(left)).or(first);
        }
        first.filter(|first| *first < self.end)
    }
}

/// What may be round-off of an argument: a part of its largest distance from the nearest threshold, sampled over a run;
/// or beyond it, where all of a short run may be round-off.
fn round_off(switch: &Switch, start: f64, end: f64) -> f64 {
    let Some(argument) = &switch.of_time else { return 0.0 };
    let distance = |part: f64| {
        let x: f64 = argument.at(start + (end - start) * part, Regime::FREE);
        switch.thresholds.nearest(x).map_or(0.0, |(_, threshold)| (x - threshold).abs())
    };
    let finite = |size: f64| if size.is_finite() { size } else { 0.0 };
    let inside = (0..=SAMPLES).map(|i| finite(distance(i as f64 / SAMPLES as f64))).fold(0.0, f64::max);
    let beyond = (1..=DOUBLINGS).map(|k| finite(distance(2f64.powi(k)))).fold(0.0, f64::max);
    let is_round_off = inside <= tolerances::ROUND_OFF_OF_FACTORS * beyond;
    tolerances::ROUND_OFF_OF_FACTORS * if is_round_off { beyond } else { inside }
}

const SAMPLES: usize = 64;
/// How often the time of a run is doubled to look beyond.
const DOUBLINGS: i32 = 20;

/// Search for the time at which an argument leaves a range, with the pieces of a regime.
struct ThresholdSearch<'s> {
    argument: &'s TimeFunction,
    range: OpenInterval,
    regime: Regime<'s>,
}

impl ThresholdSearch<'_> {
    /// The first time in (from, to] at which the argument is out of the range: intervals are halved until their
    /// enclosures prove that it stays inside, or that it is monotone.
    fn first_exit(&self, from: f64, to: f64, looks: &mut usize) -> Option<f64> {
        *looks = looks.saturating_sub(1);
        let x = self.argument.at(Taylor::running(Interval::new(from, to)), self.regime);
        if self.range.contains(x.x.low) && self.range.contains(x.x.high) {
            return None;
        }
        let middle = 0.5 * (from + to);
        if !x.d.contains(0.0) || *looks == 0 || middle <= from || middle >= to {
            return (!self.range.contains(self.value(to))).then(|| self.passage(from, to));
        }
        self.first_exit(from, middle, looks).or_else(|| self.first_exit(middle, to, looks))
    }

    fn value(&self, t: f64) -> f64 {
        self.argument.at(t, self.regime)
    }

    /// The time before `to` at which an argument that is inside right after `from`, and monotone, leaves the range.
    fn passage(&self, from: f64, to: f64) -> f64 {
        first_out(|t| self.range.beyond(self.value(t)), from, to)
    }
}
