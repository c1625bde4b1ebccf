//! Step sizes that resolve the functions of t between the stages, and signals of the state.
//!
//! A window of time is resolved where four cubics, through values and rates of a function at five nodes, represent
//! the function: each agrees with it in the middle, and neither the function nor its rate exceeds the hull of the two
//! adjacent nodes by more than the second differences there. The last is proved for every instant, by enclosures of the
//! function and its rate over whole intervals; where these are too wide it is tested at samples as close as documented.
//! A signal of the state is looked at as the function of t that it is if its argument goes on at its present rate.

use crate::math::array::{Each, from_fn};
use crate::math::expression::TimeFunction;
use crate::math::signal::Signal;
use crate::math::{Interval, Piece, Rate, Regime, Scalar, Taylor};
use crate::tolerances;

/// What lasts so long is not missed, nor anything longer. Unit: `[1]` of the span. Why: the promise of the README.
/// Test: `a_bump_is_met_whenever_it_comes`.
const NEVER_MISSED: f64 = 1e-4;

/// The functions of time of a run, and the time up to which they are resolved.
pub struct Watch<'a> {
    functions: Vec<WatchedFunction<'a>>,
    /// Distance of samples, s.
    shortest: f64,
    /// Time up to which steps are resolved, s.
    seen: f64,
}

struct WatchedFunction<'a> {
    function: Function<'a>,
    /// True if its enclosures are too wide.
    is_loose: bool,
}

enum Function<'a> {
    OfTime(&'a TimeFunction),
    /// A signal on a piece, at an argument with this value and rate at a time.
    Along(&'a Signal, Piece, Rate, f64),
}

impl Function<'_> {
    fn at<S: Scalar>(&self, t: S, regime: Regime) -> S {
        match *self {
            Function::OfTime(function) => function.at(t, regime),
            Function::Along(signal, piece, x, from) => signal.on(piece, (t - from) * x.eps[0] + x.re),
        }
    }
}

/// A quarter of a window, with the bounds of the function and its rate there.
struct Quarter {
    from: f64,
    to: f64,
    allowed: [Interval; 2],
}

impl<'a> Watch<'a> {
    pub fn new(functions: &'a [TimeFunction], span: f64) -> Self {
        let watched = |function| WatchedFunction { function: Function::OfTime(function), is_loose: false };
        let functions = functions.iter().map(watched).collect();
        Watch { functions, shortest: 0.5 * NEVER_MISSED * span, seen: f64::NEG_INFINITY }
    }

    /// Time up to which steps are resolved, if known, and true for each function whose enclosures are too wide.
    pub fn memory(&self) -> (Option<f64>, Vec<bool>) {
        let seen = Some(self.seen).filter(|seen| seen.is_finite());
        (seen, self.functions.iter().map(|watched| watched.is_loose).collect())
    }

    /// Restores the values of [`Self::memory`].
    pub fn recall(&mut self, seen: Option<f64>, loose: &[bool]) {
        self.seen = seen.unwrap_or(f64::NEG_INFINITY);
        self.functions.iter_mut().zip(loose).for_each(|(watched, loose)| watched.is_loose = *loose);
    }

    /// Forgets up to which time steps are resolved, where the functions change their form.
    pub fn forget(&mut self) {
        self.seen = f64::NEG_INFINITY;
    }

    /// The step from `t`, at most `h`, that resolves the functions with cubics whose relative error is at most
    /// `beside`; the functions are those of the regime up to `stop`.
    pub fn resolved(&mut self, t: f64, h: f64, stop: f64, beside: f64, regime: Regime) -> f64 {
        if self.functions.is_empty() || t + h <= self.seen {
            return h;
        }
        // A window is looked at whole for eight steps of this size.
        let whole = (8.0 * h).min(stop - t);
        let window = seen_window(&mut self.functions, t, whole, self.shortest, beside, regime);
        self.seen = t + window;
        // A step that differs by rounding from one that ends at the stop keeps its size.
        if window == whole { h } else { h.min(window) }
    }

    /// The step from `t`, at most `h`, that resolves a signal on a piece whose argument is `x` at `t`.
    pub fn resolved_along(&self, t: f64, h: f64, signal: &Signal, piece: Piece, x: Rate) -> f64 {
        let mut watched = [WatchedFunction { function: Function::Along(signal, piece, x, t), is_loose: false }];
        seen_window(&mut watched, t, h, self.shortest, tolerances::RESOLVED_ROUGHLY, Regime::FREE)
    }
}

/// The part of a window from `t` on that resolves the functions.
fn seen_window(
    functions: &mut [WatchedFunction],
    t: f64,
    whole: f64,
    shortest: f64,
    beside: f64,
    regime: Regime,
) -> f64 {
    let mut window = whole;
    while window > shortest {
        let unseen = functions.iter_mut().filter_map(|it| it.unseen(t, window, shortest, beside, regime));
        match unseen.reduce(f64::min) {
            None => break,
            // Before the first feature that the nodes do not resolve all may be resolved.
            Some(from) => window = if from > t + 0.125 * window { from - t } else { 0.5 * window },
        }
    }
    window
}

impl WatchedFunction<'_> {
    /// The function and its rates; zero rates where an overflow makes them not finite, as in 1/cosh(t).
    fn at(&self, t: f64, regime: Regime) -> Taylor<f64> {
        let value = self.function.at(Taylor::time(t), regime);
        let finite = |x: f64| if x.is_finite() { x } else { 0.0 };
        Taylor { x: value.x, d: finite(value.d), dd: finite(value.dd) }
    }

    /// The time from which on the window that starts at `t` does not resolve the function; `None` where it does, or
    /// where the function is not finite.
    fn unseen(&mut self, t: f64, window: f64, shortest: f64, beside: f64, regime: Regime) -> Option<f64> {
        let times = [0.0, 0.25, 0.5, 0.75, 1.0].each(|fraction| t + fraction * window);
        let nodes = times.each(|t| self.at(t, regime));
        if nodes.iter().any(|node| !node.x.is_finite()) {
            return None;
        }
        // With more the enclosures of the function are too wide.
        let mut looks = 100;
        for (i, quarter) in quarters(&times, &nodes).into_iter().enumerate() {
            let middle = self.at(0.5 * (quarter.from + quarter.to), regime);
            let a = nodes[i];
            let b = nodes[i + 1];
            let width = quarter.to - quarter.from;
            let cubic = 0.5 * (a.x + b.x) + width / 8.0 * (a.d - b.d);
            let change = (b.x - a.x).abs() + 0.25 * width * (a.d.abs() + b.d.abs());
            let small = tolerances::SAME * a.x.abs().max(b.x.abs()) + tolerances::ROUND_OFF_OF_SUMS;
            if (middle.x - cubic).abs() > beside * change + small {
                return Some(quarter.from);
            }
            if let Some(from) = self.first_beyond(&quarter, regime, shortest, &mut looks) {
                return Some(from);
            }
        }
        None
    }

    /// The first time in a quarter at which the function or its rate exceeds the bounds.
    fn first_beyond(&mut self, quarter: &Quarter, regime: Regime, shortest: f64, looks: &mut usize) -> Option<f64> {
        if !self.is_loose {
            let beyond = self.enclosed(quarter, quarter.from, quarter.to, regime, looks);
            self.is_loose = *looks == 0;
            if !self.is_loose {
                return beyond;
            }
        }
        let count = ((quarter.to - quarter.from) / shortest).ceil().max(1.0);
        let samples =
            (0..count as usize).map(|k| quarter.from + (k as f64 + 0.5) / count * (quarter.to - quarter.from));
        let beyond = |t: &f64| !quarter.allowed[0].contains(self.function.at(*t, regime));
        samples.into_iter().find(beyond).map(|t| (t - shortest).max(quarter.from))
    }

    /// The same by enclosures over intervals, which are halved until they are narrow enough.
    fn enclosed(&self, quarter: &Quarter, from: f64, to: f64, regime: Regime, looks: &mut usize) -> Option<f64> {
        if *looks == 0 {
            return None;
        }
        *looks -= 1;
        let x = self.function.at(Taylor::running(Interval::new(from, to)), regime);
        let fits = |x: [Interval; 2]| {
            x.iter().zip(&quarter.allowed).all(|(x, allowed)| allowed.low <= x.low && x.high <= allowed.high)
        };
        if fits([x.x, x.d]) {
            return None;
        }
        let middle = 0.5 * (from + to);
        let there = self.at(middle, regime);
        // Mean value form, often much narrower.
        let half = Interval::new(from - middle, to - middle);
        if fits([half * x.d + there.x, half * x.dd + there.d]) {
            return None;
        }
        if !fits([Interval::constant(there.x), Interval::constant(there.d)]) {
            return Some(from);
        }
        if middle <= from || middle >= to {
            return None;
        }
        let first = self.enclosed(quarter, from, middle, regime, looks);
        first.or_else(|| self.enclosed(quarter, middle, to, regime, looks))
    }
}

/// Bounds in each quarter: the hull of its ends, widened by the smaller of the second differences at them.
fn quarters(times: &[f64; 5], nodes: &[Taylor<f64>; 5]) -> [Quarter; 4] {
    let levels = nodes.each(|node| [node.x, node.d]);
    let size = nodes.iter().fold(0.0, |size: f64, node| size.max(node.x.abs()));
    let bend = |i: usize, level: usize| match i {
        1..4 => (levels[i - 1][level] - 2.0 * levels[i][level] + levels[i + 1][level]).abs(),
        _ => f64::INFINITY,
    };
    std::array::from_fn(|i| {
        let allowed = from_fn(|level| {
            let small =
                (tolerances::SAME * size + tolerances::ROUND_OFF_OF_SUMS) / (times[4] - times[0]).powi(level as i32);
            let margin = bend(i, level).min(bend(i + 1, level)) + small;
            let hull = Interval::new(levels[i][level], levels[i + 1][level]);
            Interval { low: hull.low - margin, high: hull.high + margin }
        });
        Quarter { from: times[i], to: times[i + 1], allowed }
    })
}
