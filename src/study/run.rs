//! One run, with as little overhead as possible.

use super::budget::{Limit, Over};
use super::watched::Watched;
use crate::analysis::{Drift, Sizes};
use crate::clock::Stopwatch;
use crate::error::{Failure, INTERRUPTED, Result};
use crate::formulation::Statistics;
use crate::prepared::Model;
use crate::simulate::{Method, Observation, Outcome, Sink, Span, Stop, simulate};
use crate::system::{MechanicalSystem, Scratch};
use std::cell::Cell;

/// The motion that runs compute.
#[derive(Clone)]
pub struct Motion<'a> {
    /// The mechanical system.
    pub system: &'a dyn MechanicalSystem,
    /// Consistent q and v.
    pub start: (&'a [f64], &'a [f64]),
    /// Start, end and output step.
    pub span: Span,
    /// The quantities that are compared.
    #[doc(hidden)]
    pub watched: Watched,
    /// Ratio atol / rtol.
    pub ratio: f64,
    /// True if the start counts, where all methods agree, but not all models.
    pub counts_start: bool,
    /// Returns true if the user stops the measurement.
    pub is_stopped: &'a (dyn Fn() -> bool + Sync),
}

impl<'a> Motion<'a> {
    /// The motion of a scene over a span, without its start.
    #[doc(hidden)]
    pub fn of(prepared: &'a Model, span: Span, watched: Watched, is_stopped: &'a (dyn Fn() -> bool + Sync)) -> Self {
        Motion {
            system: prepared.system(),
            start: prepared.start(),
            span,
            watched,
            ratio: prepared.method.atol / prepared.method.rtol,
            counts_start: false,
            is_stopped,
        }
    }

    /// Returns the simulated time, s.
    pub fn duration(&self) -> f64 {
        self.span.end - self.span.start
    }

    /// Runs `method` until it ends, is stopped, or a limit is over; the sink receives the motion.
    ///
    /// # Errors
    /// Bad input only, as `simulate`.
    pub(crate) fn simulate(&self, method: &Method, limit: Option<Limit>, sink: &mut dyn Sink) -> Result<Ended> {
        let watch = Stopwatch::start();
        let mut limited = LimitedSink { sink, is_stopped: self.is_stopped, limit, watch, over: Cell::new(None) };
        let outcome = simulate(self.system, method, self.span, self.start, &mut limited)?;
        let over = limited.over.get().filter(|_| outcome.failure.is_some());
        Ok(Ended { outcome, over, seconds: watch.cpu().as_secs_f64() })
    }

    /// Runs `method` until it ends or a limit is over, and samples the motion.
    ///
    /// # Errors
    /// Bad input only, as `simulate`.
    #[doc(hidden)]
    pub fn run(&self, method: &Method, limit: impl Into<Limit>) -> Result<RunSample> {
        // One thread, so that the time is that of the method.
        faer::set_global_parallelism(faer::Par::Seq);
        let mut sink = Sampler {
            motion: self,
            scratch: Scratch::default(),
            scales: self.system.facts().scales.clone(),
            rows: Vec::new(),
            sizes: Sizes::default(),
            drift: Drift::default(),
        };
        let Ended { outcome, over, seconds } = self.simulate(method, Some(limit.into()), &mut sink)?;
        let Sampler { rows, sizes, drift, .. } = sink;
        let Outcome { statistics, failure, .. } = outcome;
        let method = method.clone();
        Ok(RunSample { method, rows, sizes, drift, statistics, failure, is_too_slow: over.is_some(), seconds })
    }
}

/// How a run ended.
pub(crate) struct Ended {
    /// State, work and failure.
    pub outcome: Outcome,
    /// The limit that ended it.
    pub(super) over: Option<Over>,
    /// CPU time, s.
    pub seconds: f64,
}

/// Result of one run.
#[derive(Clone, Debug)]
pub struct RunSample {
    /// Its method.
    pub method: Method,
    /// Values of the watched quantities, one row per output time, at the start only where it counts.
    pub rows: Vec<Vec<f64>>,
    /// Sizes of the motion over the same rows and the start.
    pub sizes: Sizes,
    /// Constraint drift.
    pub drift: Drift,
    /// Counted work.
    pub statistics: Statistics,
    /// Reason why it did not complete.
    pub failure: Option<Failure>,
    /// True if it was stopped at its time limit.
    pub is_too_slow: bool,
    /// CPU time, s.
    pub seconds: f64,
}

impl RunSample {
    /// Returns its method with the tolerance.
    pub fn name(&self) -> String {
        with_tolerance(&self.method)
    }

    /// Returns the time of the whole run, s, extrapolated from the part completed; 0 if it was stopped at once, none
    /// where it failed.
    pub fn whole(&self, span: Span) -> Option<f64> {
        match &self.failure {
            None => Some(self.seconds),
            Some(failure) if self.is_too_slow => Some(extrapolated(self.seconds, failure.t, span).unwrap_or(0.0)),
            Some(_) => None,
        }
    }
}

/// Returns a method with its tolerance in words.
pub(super) fn with_tolerance(method: &Method) -> String {
    format!("{}, rtol {:e}", method.triple(), method.rtol)
}

/// Returns the time of a run that took `seconds` until `t`; a run that was stopped at once gives no estimate.
pub(super) fn extrapolated(seconds: f64, t: f64, span: Span) -> Option<f64> {
    (t > span.start).then(|| seconds * (span.end - span.start) / (t - span.start))
}

/// A sink whose run ends at a limit.
struct LimitedSink<'a> {
    sink: &'a mut dyn Sink,
    is_stopped: &'a (dyn Fn() -> bool + Sync),
    limit: Option<Limit>,
    watch: Stopwatch,
    over: Cell<Option<Over>>,
}

impl Sink for LimitedSink<'_> {
    fn accepted(&mut self, state: &Observation) {
        self.sink.accepted(state);
    }

    fn watches(&self) -> bool {
        self.sink.watches()
    }

    fn row(&mut self, state: &Observation) {
        self.sink.row(state);
    }

    fn watches_events(&self) -> bool {
        self.sink.watches_events()
    }

    fn before_event(&mut self, state: &Observation) {
        self.sink.before_event(state);
    }

    fn after_event(&mut self, state: &Observation) {
        self.sink.after_event(state);
    }

    fn is_done(&self) -> bool {
        self.sink.is_done()
    }

    fn watches_root(&self) -> bool {
        self.sink.watches_root()
    }

    fn root(&mut self, state: &Observation) -> f64 {
        self.sink.root(state)
    }

    fn stops(&self) -> Option<Stop> {
        if let Some(stop) = self.sink.stops() {
            return Some(stop);
        }
        if (self.is_stopped)() {
            return Some(Stop { reason: INTERRUPTED.to_string(), hint: "begin again".to_string() });
        }
        let limit = self.limit?;
        let over = limit.over(&self.watch)?;
        self.over.set(Some(over));
        Some(Stop::deadline(limit.cpu))
    }
}

struct Sampler<'a> {
    motion: &'a Motion<'a>,
    scratch: Scratch,
    scales: Vec<f64>,
    rows: Vec<Vec<f64>>,
    sizes: Sizes,
    drift: Drift,
}

impl Sink for Sampler<'_> {
    fn accepted(&mut self, state: &Observation) {
        self.drift.add(state, &self.scales);
    }

    fn row(&mut self, state: &Observation) {
        let Motion { system, span, watched, counts_start, .. } = self.motion;
        self.sizes.add(*system, state, &self.scales, &mut self.scratch);
        if state.t > span.start || *counts_start {
            self.rows.push(watched.read_row(*system, state, &mut self.scratch));
        }
    }
}
