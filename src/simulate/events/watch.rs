//! Looks that no step misses what functions of t do between the stages.
//!
//! A window of time is resolved where four pieces of cubics, through values and rates of a function at five nodes, show
//! all of it: each agrees with the function in its middle, and neither the function nor its rate goes beyond the two
//! nodes on its sides by more than the nodes bend there. The last is known of every instant, by enclosures of the
//! function and its rate over whole intervals; where these are too wide it is seen at samples as close as the promise
//! says.

use crate::math::expression::TimeFunction;
use crate::math::{Interval, Regime, Scalar, Taylor};
use crate::tolerances::simulate as tolerances;

/// The functions of time of a run.
pub struct Watch<'a> {
    functions: Vec<Watched<'a>>,
    /// The distance of samples, s.
    shortest: f64,
    /// Steps up to here are resolved.
    seen: f64,
}

struct Watched<'a> {
    function: &'a TimeFunction,
    /// Whether its enclosures are too wide.
    is_loose: bool,
}

/// The quarter of a window, with what its function and rate may be there.
struct Quarter {
    from: f64,
    to: f64,
    allowed: [Interval; 2],
}

impl<'a> Watch<'a> {
    pub fn new(functions: &'a [TimeFunction], span: f64) -> Self {
        let functions = functions.iter().map(|function| Watched { function, is_loose: false }).collect();
        Watch { functions, shortest: 0.5 * tolerances::NEVER_MISSED * span, seen: f64::NEG_INFINITY }
    }

    /// Up to where steps are resolved, if anywhere, and whether the enclosures of each function are too wide.
    pub fn memory(&self) -> (Option<f64>, Vec<bool>) {
        let seen = Some(self.seen).filter(|seen| seen.is_finite());
        (seen, self.functions.iter().map(|watched| watched.is_loose).collect())
    }

    /// Goes on with what [`Self::memory`] said.
    pub fn recall(&mut self, seen: Option<f64>, loose: &[bool]) {
        self.seen = seen.unwrap_or(f64::NEG_INFINITY);
        self.functions.iter_mut().zip(loose).for_each(|(watched, loose)| watched.is_loose = *loose);
    }

    /// The functions are others from here on.
    pub fn forget(&mut self) {
        self.seen = f64::NEG_INFINITY;
    }

    /// The step from `t` that misses nothing, `h` or less, with cubics that show the functions but for this part; the
    /// functions are those of the regime up to `stop`.
    pub fn resolved(&mut self, (t, h, stop): (f64, f64, f64), beside: f64, regime: Regime) -> f64 {
        if self.functions.is_empty() || t + h <= self.seen {
            return h;
        }
        let whole = (tolerances::WATCHED_STEPS * h).min(stop - t);
        let mut window = whole;
        while window > self.shortest {
            let shortest = self.shortest;
            let unseen =
                self.functions.iter_mut().filter_map(|watched| watched.unseen(regime, (t, window), (shortest, beside)));
            match unseen.reduce(f64::min) {
                None => break,
                // Up to where something begins that the nodes do not show there may be nothing else.
                Some(from) => window = if from > t + 0.125 * window { from - t } else { 0.5 * window },
            }
        }
        self.seen = t + window;
        // What rounding makes of a step that ends at the stop is that step still.
        if window == whole { h } else { h.min(window) }
    }
}

impl Watched<'_> {
    /// The function and its rates; without rates where an overflow makes nothing of them, as in 1/cosh(t).
    fn at(&self, t: f64, regime: Regime) -> Taylor<f64> {
        let found = self.function.at(Taylor::time(t), regime);
        let finite = |x: f64| if x.is_finite() { x } else { 0.0 };
        Taylor { x: found.x, d: finite(found.d), dd: finite(found.dd) }
    }

    /// From where on the window that starts at `t` does not show all of the function; none where it does, or where that
    /// is not finite.
    fn unseen(&mut self, regime: Regime, (t, window): (f64, f64), (shortest, beside): (f64, f64)) -> Option<f64> {
        let times = [0.0, 0.25, 0.5, 0.75, 1.0].map(|part| t + part * window);
        let nodes = times.map(|t| self.at(t, regime));
        if nodes.iter().any(|node| !node.x.is_finite()) {
            return None;
        }
        let mut looks = tolerances::LOOKS_IN_WINDOW;
        for (i, quarter) in quarters(&times, &nodes).into_iter().enumerate() {
            let middle = self.at(0.5 * (quarter.from + quarter.to), regime);
            let (a, b, width) = (nodes[i], nodes[i + 1], quarter.to - quarter.from);
            let cubic = 0.5 * (a.x + b.x) + width / 8.0 * (a.d - b.d);
            let change = (b.x - a.x).abs() + 0.25 * width * (a.d.abs() + b.d.abs());
            let small = tolerances::SAME * a.x.abs().max(b.x.abs()) + tolerances::NO_FUNCTION;
            if (middle.x - cubic).abs() > beside * change + small {
                return Some(quarter.from);
            }
            if let Some(from) = self.first_beyond(&quarter, regime, shortest, &mut looks) {
                return Some(from);
            }
        }
        None
    }

    /// Where in a quarter the function or its rate goes beyond what is allowed.
    fn first_beyond(&mut self, quarter: &Quarter, regime: Regime, shortest: f64, looks: &mut usize) -> Option<f64> {
        if !self.is_loose {
            let found = self.enclosed(quarter, (quarter.from, quarter.to), regime, looks);
            self.is_loose = *looks == 0;
            if !self.is_loose {
                return found;
            }
        }
        let count = ((quarter.to - quarter.from) / shortest).ceil().max(1.0);
        let samples =
            (0..count as usize).map(|k| quarter.from + (k as f64 + 0.5) / count * (quarter.to - quarter.from));
        let beyond = |t: &f64| !quarter.allowed[0].contains(self.function.at(*t, regime));
        samples.into_iter().find(beyond).map(|t| (t - shortest).max(quarter.from))
    }

    /// The same by enclosures over intervals, which are halved until they are narrow enough.
    fn enclosed(&self, quarter: &Quarter, (from, to): (f64, f64), regime: Regime, looks: &mut usize) -> Option<f64> {
        if *looks == 0 {
            return None;
        }
        *looks -= 1;
        let x = self.function.at(Taylor::running(Interval::new(from, to)), regime);
        let fits =
            |x: [Interval; 2]| x.iter().zip(&quarter.allowed).all(|(x, all)| all.low <= x.low && x.high <= all.high);
        if fits([x.x, x.d]) {
            return None;
        }
        let middle = 0.5 * (from + to);
        let there = self.at(middle, regime);
        // By the theorem of the mean, often much narrower.
        let half = Interval::new(from - middle, to - middle);
        if fits([half * x.d + there.x, half * x.dd + there.d]) {
            return None;
        }
        if !fits([there.x, there.d].map(Interval::constant)) {
            return Some(from);
        }
        if middle <= from || middle >= to {
            return None;
        }
        let first = self.enclosed(quarter, (from, middle), regime, looks);
        first.or_else(|| self.enclosed(quarter, (middle, to), regime, looks))
    }
}

/// What is allowed in each quarter: the hull of its ends, widened by the smaller of the second differences at them.
fn quarters(times: &[f64; 5], nodes: &[Taylor<f64>; 5]) -> [Quarter; 4] {
    let levels = nodes.map(|node| [node.x, node.d]);
    let size = nodes.iter().fold(0.0, |size: f64, node| size.max(node.x.abs()));
    let bend = |i: usize, level: usize| match i {
        1..4 => (levels[i - 1][level] - 2.0 * levels[i][level] + levels[i + 1][level]).abs(),
        _ => f64::INFINITY,
    };
    std::array::from_fn(|i| {
        let allowed = std::array::from_fn(|level| {
            let small = (tolerances::SAME * size + tolerances::NO_FUNCTION) / (times[4] - times[0]).powi(level as i32);
            let margin = bend(i, level).min(bend(i + 1, level)) + small;
            let hull = Interval::new(levels[i][level], levels[i + 1][level]);
            Interval { low: hull.low - margin, high: hull.high + margin }
        });
        Quarter { from: times[i], to: times[i + 1], allowed }
    })
}
