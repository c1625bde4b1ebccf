//! Times at which functions of t change their form.

use super::range::{Range, first_out};
use super::watch::Watch;
use crate::math::expression::{Switch, TimeFunction};
use crate::math::{Interval, Piece, Regime, Taylor, Thresholds};
use crate::tolerances::simulate as tolerances;

/// The functions of time of a run: their changes of form, and the steps that resolve them.
pub struct Timetable<'a> {
    switches: &'a [Switch],
    pub watch: Watch<'a>,
    start: f64,
    end: f64,
    /// The next change of form.
    next: Option<f64>,
}

impl<'a> Timetable<'a> {
    pub fn new(switches: &'a [Switch], functions: &'a [TimeFunction], start: f64, end: f64) -> Self {
        Timetable { switches, watch: Watch::new(functions, end - start), start, end, next: None }
    }

    /// Sets all functions of time to their pieces from `t` on.
    pub fn place(&mut self, t: f64, pieces: &mut [Piece]) {
        for (number, switch) in self.switches.iter().enumerate() {
            if let Some(argument) = &switch.of_time {
                pieces[number] = self.piece_from(t, argument, &switch.thresholds, pieces);
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

    /// The next time at which a function of time changes its form; `None` if there is none before the end.
    pub fn next_change(&self) -> Option<f64> {
        self.next
    }

    /// The step from `t`, at most `h`, that resolves the functions of time. They are fixed on these pieces up to
    /// `stop`.
    pub fn resolved(&mut self, t: f64, h: f64, stop: f64, pieces: &[Piece]) -> f64 {
        self.watch.resolved((t, h, stop), tolerances::RESOLVED_ROUGHLY, Regime::held(pieces))
    }

    /// The step, at most `h`, on which the functions of time are almost cubics.
    pub fn finely_resolved(&mut self, t: f64, h: f64, pieces: &[Piece]) -> f64 {
        self.watch.forget();
        self.watch.resolved((t, h, f64::INFINITY), tolerances::RESOLVED_FINELY, Regime::held(pieces))
    }

    /// The piece of an argument right after `t`: at a threshold its rate decides.
    fn piece_from(&self, t: f64, argument: &TimeFunction, thresholds: &Thresholds, pieces: &[Piece]) -> Piece {
        let regime = Regime::held(pieces);
        let x: Taylor<f64> = argument.at(Taylor::time(t), regime);
        let round_off = |threshold: f64| 8.0 * f64::EPSILON * (threshold.abs() + (x.d * t).abs());
        let at = thresholds.nearest(x.x).filter(|&(_, threshold)| (x.x - threshold).abs() <= round_off(threshold));
        let side = |slope: f64| if slope > 0.0 { 1 } else { -1 };
        let turn = match at {
            None => return thresholds.piece(x.x).unwrap_or(0),
            Some(_) if x.d != 0.0 => side(x.d),
            Some(_) if x.dd != 0.0 => side(x.dd),
            Some((_, threshold)) => {
                let later = argument.at(t + tolerances::LOOKED_AHEAD * (self.end - self.start), regime) - threshold;
                if later == 0.0 { 0 } else { side(later) }
            }
        };
        (2 * at.map_or(0, |(k, _)| k) as Piece + 1).wrapping_add_signed(turn)
    }

    fn find_next(&self, t: f64, pieces: &[Piece]) -> Option<f64> {
        let mut first: Option<f64> = None;
        for (number, switch) in self.switches.iter().enumerate() {
            let Some(argument) = &switch.of_time else { continue };
            let Some(range) = Range::of(pieces[number], &switch.thresholds) else { continue };
            let search = Search { argument, range, regime: Regime::held(pieces) };
            let exit = search.first_exit(t, first.unwrap_or(self.end), &mut tolerances::LOOKS_FOR_CHANGE.clone());
            first = exit.or(first);
        }
        first.filter(|first| *first < self.end)
    }
}

/// Search for the time at which an argument leaves a range, with the pieces of a regime.
struct Search<'s> {
    argument: &'s TimeFunction,
    range: Range,
    regime: Regime<'s>,
}

impl Search<'_> {
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
