//! A companion of a run: the same run by the same methods, but with other errors.

use super::watched::Watched;
use crate::error::{Error, Failure, rounded};
use crate::formulation::{Statistics, softer};
use crate::integrator::{Tightening, Tolerance, find};
use crate::prepared::Model;
use crate::simulate::{Checkpoint, Leg, Method, Observation, Outcome, Sink, Span, Start, Stop, simulate_from};
use crate::system::{MechanicalSystem, Scratch};
use crate::trajectory::Trajectory;

/// A completed run.
#[derive(Clone, Copy, Debug)]
pub struct Completed<'a> {
    /// Its span.
    pub span: Span,
    /// Its rows.
    pub trajectory: &'a Trajectory,
    /// Its methods in their order, where they were chosen by the program; else the scene's is meant.
    pub legs: &'a [Leg],
    /// Its work.
    pub statistics: Statistics,
}

impl Completed<'_> {
    /// The watched quantities of the rows at the times of the span, without those beside jumps.
    pub fn rows_of_span(&self) -> Vec<Vec<f64>> {
        let mut found: Vec<Vec<f64>> = Vec::new();
        for (t, row) in self.trajectory.times().zip(self.trajectory.watched()) {
            if t == self.span.row(found.len() as u64) {
                found.push(row);
            }
        }
        found
    }
}

/// Where the first half of a part ends: not on an output row of most runs.
const FIRST_HALF: f64 = 0.4637;

/// A part of the run with one method.
pub struct RunPart {
    pub method: Method,
    from: f64,
    to: f64,
}

impl RunPart {
    /// The parts of a run; those of a method that was replaced before it made a step are left out.
    pub fn of(prepared: &Model, run: &Completed) -> Vec<RunPart> {
        let Span { start, end, .. } = run.span;
        if run.legs.is_empty() {
            return vec![RunPart { method: prepared.method.clone(), from: start, to: end }];
        }
        let ends = run.legs.iter().skip(1).map(|leg| leg.from).chain([end]);
        let parts = run.legs.iter().zip(ends);
        let parts = parts.map(|(leg, to)| RunPart { method: leg.method.clone(), from: leg.from, to });
        parts.filter(|part| part.duration() > 0.0).collect()
    }

    /// Its duration, s.
    pub fn duration(&self) -> f64 {
        self.to - self.from
    }

    fn halves(&self) -> [RunPart; 2] {
        let middle = self.from + FIRST_HALF * self.duration();
        let half = |from, to| RunPart { method: self.method.clone(), from, to };
        [half(self.from, middle), half(middle, self.to)]
    }
}

/// A run of the scene whose errors differ from those of the run.
pub struct Companion {
    /// Method of its first part.
    pub method: Method,
    /// Part of the difference of both runs that holds the error of the run.
    pub part: f64,
    /// Least order of its methods.
    order: usize,
    pub rows: Vec<(f64, Vec<f64>)>,
    pub statistics: Statistics,
    pub failure: Option<Failure>,
}

/// Called with the times of a run, and asked whether it should end.
pub type RunWatch<'a> = (&'a dyn Fn(f64), &'a (dyn Fn() -> Option<Stop> + Sync));

/// The companion of a run: coarser, and begun anew in the middle where it would take the very steps of the run, as
/// where steps grow by a largest factor from their beginning to the end. Finer where a coarser run diverges, or does not
/// come to the end.
pub fn companion(prepared: &Model, run: &Completed, parts: &[RunPart], watch: RunWatch) -> Companion {
    let Statistics { steps, stagnated, .. } = run.statistics;
    let is_at_round_off = stagnated as f64 > AT_ROUND_OFF * steps as f64;
    let coarser = |method: &Method| Changed::coarser(method, is_at_round_off, prepared.system());
    let first = rerun(prepared, run.span, parts, &coarser, watch);
    if first.failure.is_some() || has_diverged(run.trajectory, &first.rows) {
        let is_ended = watch.1().is_some();
        return if is_ended { first } else { rerun(prepared, run.span, parts, &Changed::finer, watch) };
    }
    if first.statistics.steps != steps {
        let part = seen_part(&first, steps as f64 / first.statistics.steps.max(1) as f64);
        return Companion { part, ..first };
    }
    let halves: Vec<RunPart> = parts.iter().flat_map(RunPart::halves).collect();
    let begun_anew = rerun(prepared, run.span, &halves, &coarser, watch);
    Companion { part: begun_anew.part.max(OF_FINER), ..begun_anew }
}

/// Steps that are hardly fewer at a larger tolerance are limited by something else, such as stability, in both runs.
const HARDLY_FEWER: f64 = 0.9;
/// Errors of such runs are alike, and their difference is smaller.
const OF_ALIKE: f64 = 10.0;
/// The part by the steps that were seen: where these are s times as many, errors of order p differ by s^p at most.
fn seen_part(companion: &Companion, fewer: f64) -> f64 {
    if fewer < 1.0 / HARDLY_FEWER {
        return OF_ALIKE;
    }
    let is_adaptive = companion.method.step.is_none();
    let seen = if is_adaptive { part_of(fewer.powi(companion.order as i32)) } else { 0.0 };
    companion.part.max(seen)
}

/// The part of the difference that holds the error where the companion's error is `factor` times as large: all of it up
/// to ten times.
fn part_of(factor: f64) -> f64 {
    (10.0 / factor).min(1.0).powf(GROWTH)
}

/// A companion whose values are so many times the largest one of the run is beyond its limit of stability.
const DIVERGED: f64 = 1e2;

fn has_diverged(trajectory: &Trajectory, companion: &[(f64, Vec<f64>)]) -> bool {
    let differences = differences(trajectory, companion);
    let is_far = |i: usize, row: &[f64]| row[i] > DIVERGED * largest_of(trajectory, i);
    differences.last().is_some_and(|row| (0..row.len()).any(|i| is_far(i, row)))
}

/// Runs the parts one after the other, each by its changed method.
fn rerun(
    prepared: &Model,
    span: Span,
    parts: &[RunPart],
    change: &dyn Fn(&Method) -> Changed,
    watch: RunWatch,
) -> Companion {
    let (show, stop) = watch;
    let system = prepared.system();
    let (q, v) = prepared.start();
    let methods: Vec<Changed> = parts.iter().map(|part| change(&part.method)).collect();
    let method = methods.first().map_or(prepared.method.clone(), |changed| changed.method.clone());
    let part = methods.iter().map(|changed| changed.part).fold(0.0, f64::max);
    let order = methods.iter().map(|changed| changed.order).min().unwrap_or(1);
    let mut companion =
        Companion { method, part, order, rows: Vec::new(), statistics: Statistics::default(), failure: None };
    let Ok(watched) = Watched::new(system, &[]) else { return companion };
    let mut sink = WatchedRows { system, watched, scratch: Scratch::default(), rows: Vec::new(), show, stop };
    let mut saved: Option<Checkpoint> = None;
    for (part, Changed { method, .. }) in parts.iter().zip(&methods) {
        let start = saved.as_ref().map_or(Start::State(q, v), Start::Saved);
        let ended = match simulate_from(system, method, Span { end: part.to, ..span }, start, &mut sink) {
            Ok(ended) => ended,
            Err(error) => {
                companion.failure = Some(not_begun(part.from, &error));
                break;
            }
        };
        // A run that goes on by the same method counts the work before it.
        let counts_before = saved.as_ref().is_some_and(|saved| saved.method() == method);
        let before = if counts_before { Statistics::default() } else { companion.statistics };
        let (Outcome { statistics, failure, .. }, checkpoint) = ended;
        companion.statistics = before + statistics;
        companion.failure = failure;
        if companion.failure.is_some() {
            break;
        }
        saved = checkpoint;
    }
    companion.rows = sink.rows;
    companion
}

fn not_begun(t: f64, error: &Error) -> Failure {
    Failure { t, reason: format!("{error:#}"), hint: String::new() }
}

/// A method with other errors.
struct Changed {
    method: Method,
    /// Part of the difference of both runs that holds the error of the method: measured, see `benches/error_bars.rs`.
    part: f64,
    order: usize,
}

/// Order from which on a tenfold tolerance saves too little: 10^(-1/p) of the work is left.
const HIGH_ORDER: usize = 8;
/// Part of the steps of a run that end at round-off, from which on its error does not follow the tolerance.
const AT_ROUND_OFF: f64 = 0.3;
/// The coarsest tolerance of a companion, where that of the run is not coarser.
const COARSEST: f64 = 0.1;
/// Errors of loose tolerances grow less than in proportion to them.
const GROWTH: f64 = 0.75;
/// Twice the step leaves 2^p times the error: two thirds of the difference hold that of a method of order three and more
/// where order 1.3 is seen, as with steps over kinks.
const OF_FIXED_STEPS: f64 = 2.0 / 3.0;
/// Twice the difference holds the error of a method of lower order where order 0.6 is seen.
const OF_LOW_ORDER: f64 = 2.0;
/// Half the step leaves half of the error of order one.
const OF_FINER: f64 = 2.0;

impl Changed {
    /// Twice the step; or ten times the tolerance, a hundred times with methods of high order and where the steps of the
    /// run end at round-off. More where the steps would be controlled alike: at their tightest they are for tolerances
    /// that differ. A penalty is a tenth of that of the run.
    fn coarser(method: &Method, is_at_round_off: bool, system: &dyn MechanicalSystem) -> Changed {
        let entry = find(&method.integrator);
        let order = entry.as_ref().map_or(1, |entry| entry.order);
        if let Some(step) = method.step {
            let method = Method { formulation: softer(&method.formulation), step: Some(2.0 * step), ..method.clone() };
            return Changed { method, part: if order >= 3 { OF_FIXED_STEPS } else { OF_LOW_ORDER }, order };
        }
        let tightening = entry.map_or(Tightening::NONE, |entry| entry.tightening);
        let at = |rtol: f64| Tolerance::new(rtol, method.atol * rtol / method.rtol, system);
        let of_steps = |rtol: f64| tightening.of_steps(&at(rtol)).rtol;
        let coarsest = method.rtol.max(COARSEST);
        let mut factor = if order < HIGH_ORDER && !is_at_round_off { 10.0 } else { 100.0 };
        // Half of the tenfold tolerance that a companion has.
        let least = 5.0 * of_steps(method.rtol);
        while of_steps(factor * method.rtol) < least && factor * method.rtol < coarsest {
            factor *= 10.0;
        }
        let rtol = rounded((factor * method.rtol).min(coarsest), DIGITS);
        // Steps at their tightest are those of a looser tolerance.
        let factor = rtol / tightening.reached(&at(method.rtol)).max(method.rtol);
        let part = if is_at_round_off { 1.0 } else { part_of(factor) };
        let formulation = softer(&method.formulation);
        Changed {
            method: Method { formulation, rtol, atol: rounded(at(rtol).atol, DIGITS), ..method.clone() },
            part,
            order,
        }
    }

    /// Half the step, or a tenth of the tolerance.
    fn finer(method: &Method) -> Changed {
        let Method { rtol, atol, step, .. } = method;
        let method = match step {
            Some(step) => Method { step: Some(0.5 * step), ..method.clone() },
            None => Method { rtol: 0.1 * rtol, atol: 0.1 * atol, ..method.clone() },
        };
        Changed { method, part: OF_FINER, order: 1 }
    }
}

/// Digits after the first of a tolerance that is meant.
const DIGITS: usize = 6;

/// The watched quantities of each row.
struct WatchedRows<'a> {
    system: &'a dyn MechanicalSystem,
    watched: Watched,
    scratch: Scratch,
    rows: Vec<(f64, Vec<f64>)>,
    show: &'a dyn Fn(f64),
    stop: &'a (dyn Fn() -> Option<Stop> + Sync),
}

impl Sink for WatchedRows<'_> {
    fn accepted(&mut self, state: &Observation) {
        (self.show)(state.t);
    }

    fn row(&mut self, state: &Observation) {
        let values = self.watched.read_row(self.system, state, &mut self.scratch);
        self.rows.push((state.t, values));
    }

    fn stops(&self) -> Option<Stop> {
        (self.stop)()
    }
}

/// The largest value of a watched quantity.
pub fn largest_of(trajectory: &Trajectory, i: usize) -> f64 {
    trajectory.watched().map(|row| row[i].abs()).filter(|value| value.is_finite()).fold(0.0, f64::max)
}

/// |x - x_c| at the rows of the run, as far as the companion came; zero at rows that it does not have, and after a jump
/// at the time of the row before.
pub fn differences(trajectory: &Trajectory, companion: &[(f64, Vec<f64>)]) -> Vec<Vec<f64>> {
    let mut others = companion.iter().peekable();
    let mut all = Vec::new();
    let mut before = f64::NEG_INFINITY;
    for (t, own) in trajectory.times().zip(trajectory.watched()) {
        let is_after_jump = std::mem::replace(&mut before, t) == t;
        while others.next_if(|(time, _)| *time < t).is_some() {}
        let Some((time, other)) = others.peek() else { break };
        let is_same = *time == t && !is_after_jump;
        let difference = |(own, other): (&f64, &f64)| if is_same { (own - other).abs() } else { 0.0 };
        all.push(own.iter().zip(other).map(difference).collect());
    }
    all
}
