//! One run, with as little overhead as possible.

use super::error_metric::Watched;
use crate::analysis::{Drift, Sizes};
use crate::clock::Stopwatch;
use crate::error::{Failure, Result};
use crate::formulation::Statistics;
use crate::prepared::PreparedScene;
use crate::simulate::{Method, Observation, Sink, Span, Stop, simulate};
use crate::system::{MechanicalSystem, Scratch};
use std::time::Duration;

/// The motion that is measured.
#[derive(Clone, Copy)]
pub struct Motion<'a> {
    /// The mechanical system.
    pub system: &'a dyn MechanicalSystem,
    /// Consistent q and v.
    pub start: (&'a [f64], &'a [f64]),
    /// Start and end time, s.
    pub between: (f64, f64),
    /// Ratio atol / rtol.
    pub ratio: f64,
    /// True if the start counts, where all methods agree, but not all models.
    pub counts_start: bool,
    /// Returns true if the user stops the measurement.
    pub is_stopped: &'a (dyn Fn() -> bool + Sync),
}

impl<'a> Motion<'a> {
    /// The motion of a scene over a span, without its start.
    pub fn of(prepared: &'a PreparedScene, span: Span, is_stopped: &'a (dyn Fn() -> bool + Sync)) -> Self {
        Motion {
            system: prepared.system(),
            start: prepared.start(),
            between: (span.start, span.end),
            ratio: prepared.method.atol / prepared.method.rtol,
            counts_start: false,
            is_stopped,
        }
    }
}

/// Result of one run.
#[derive(Clone, Debug)]
pub struct RunSample {
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
    /// Returns the time of the whole run, s, extrapolated from the part completed; 0 if it was stopped at once, none
    /// where it failed.
    pub fn whole(&self, motion: &Motion) -> Option<f64> {
        let (start, end) = motion.between;
        match &self.failure {
            Some(failure) if self.is_too_slow && failure.t > start => {
                Some(self.seconds * (end - start) / (failure.t - start))
            }
            // A run that was stopped at once gives no estimate.
            Some(_) if self.is_too_slow => Some(0.0),
            Some(_) => None,
            None => Some(self.seconds),
        }
    }
}

/// Time limits of a run.
#[derive(Clone, Copy, Debug)]
pub struct Allowed {
    /// CPU time, which does not depend on other load of the machine.
    pub cpu: Duration,
    /// Wall-clock time.
    pub wall: Duration,
}

impl From<Duration> for Allowed {
    fn from(cpu: Duration) -> Allowed {
        Allowed { cpu, wall: cpu.saturating_mul(BUSY) }
    }
}

/// Runs `method` until it ends or the `allowed` time is over.
///
/// # Errors
/// Bad input only, as [`simulate`].
pub fn sample(
    motion: &Motion,
    watched: &Watched,
    method: &Method,
    span: Span,
    allowed: impl Into<Allowed>,
) -> Result<RunSample> {
    let allowed = allowed.into();
    // One thread, so that the time is that of the method.
    faer::set_global_parallelism(faer::Par::Seq);
    let system = motion.system;
    let mut sink = Sampler {
        motion,
        watched,
        scratch: Scratch::default(),
        scales: system.scales(),
        start: span.start,
        rows: Vec::new(),
        sizes: Sizes::default(),
        drift: Drift::default(),
        allowed,
        watch: Stopwatch::start(),
    };
    let (outcome, seconds) = cpu_seconds(|| simulate(system, method, span, motion.start, &mut sink));
    let outcome = outcome?;
    let is_too_slow =
        outcome.failure.as_ref().is_some_and(|failure| failure.reason == Stop::deadline(allowed.cpu).reason);
    let Sampler { rows, sizes, drift, .. } = sink;
    Ok(RunSample { rows, sizes, drift, statistics: outcome.statistics, failure: outcome.failure, is_too_slow, seconds })
}

/// Returns the CPU time of `work` on this thread, s.
pub fn cpu_seconds<T>(work: impl FnOnce() -> T) -> (T, f64) {
    let watch = Stopwatch::start();
    let result = work();
    (result, watch.cpu().as_secs_f64())
}

struct Sampler<'a> {
    motion: &'a Motion<'a>,
    watched: &'a Watched,
    scratch: Scratch,
    scales: Vec<f64>,
    start: f64,
    rows: Vec<Vec<f64>>,
    sizes: Sizes,
    drift: Drift,
    allowed: Allowed,
    watch: Stopwatch,
}

/// Limit of the wall-clock time of a run on a busy machine, in CPU time limits.
const BUSY: u32 = 3;

impl Sink for Sampler<'_> {
    fn accepted(&mut self, state: &Observation) {
        self.drift.add(state, &self.scales);
    }

    fn row(&mut self, state: &Observation) {
        self.sizes.add(self.motion.system, state, &self.scales, &mut self.scratch);
        if state.t > self.start || self.motion.counts_start {
            self.rows.push(self.watched.read_row(self.motion.system, state, &mut self.scratch));
        }
    }

    fn stops(&self) -> Option<Stop> {
        if (self.motion.is_stopped)() {
            return Some(Stop { reason: "interrupted".to_string(), hint: "begin again".to_string() });
        }
        // The clock of CPU time is slow to read, and never ahead of the other.
        let (waited, Allowed { cpu: most, wall: longest }) = (self.watch.wall(), self.allowed);
        let is_over = waited > longest || waited > most && self.watch.cpu() > most;
        is_over.then(|| Stop::deadline(most))
    }
}
