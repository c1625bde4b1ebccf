//! One run, with as little beside it as can be.

use super::error_metric::Watched;
use crate::analysis::{Drift, Sizes};
use crate::error::{Failure, Result};
use crate::formulation::Statistics;
use crate::simulate::{Method, Observation, Sink, Span, Stop, simulate};
use crate::system::{MechanicalSystem, Scratch};
use cpu_time::ThreadTime;
use std::time::{Duration, Instant};

/// What is measured on.
#[derive(Clone, Copy)]
pub struct Motion<'a> {
    pub system: &'a dyn MechanicalSystem,
    /// Consistent q and v.
    pub start: (&'a [f64], &'a [f64]),
    /// From when to when, s.
    pub between: (f64, f64),
    /// atol over rtol.
    pub ratio: f64,
    /// Whether the user wants it to end.
    pub is_stopped: &'a (dyn Fn() -> bool + Sync),
}

/// What one run gave.
#[derive(Clone, Debug)]
pub struct RunSample {
    /// Of the quantities watched, one row an output time after the start, where all motions are alike.
    pub rows: Vec<Vec<f64>>,
    /// Over the same rows and the start.
    pub sizes: Sizes,
    pub drift: Drift,
    pub statistics: Statistics,
    pub failure: Option<Failure>,
    /// Whether it was stopped because it took too long.
    pub is_too_slow: bool,
    /// CPU time, s.
    pub seconds: f64,
}

impl RunSample {
    /// So long the run would have taken to its end by how far it came, s; none where it failed.
    pub fn whole(&self, motion: &Motion) -> Option<f64> {
        let (start, end) = motion.between;
        match &self.failure {
            Some(failure) if self.is_too_slow && failure.t > start => {
                Some(self.seconds * (end - start) / (failure.t - start))
            }
            // One that was stopped at once says nothing.
            Some(_) if self.is_too_slow => Some(0.0),
            Some(_) => None,
            None => Some(self.seconds),
        }
    }
}

/// How long a run may take.
#[derive(Clone, Copy, Debug)]
pub struct Allowed {
    /// CPU time, so that what else the machine does ends no run;
    pub cpu: Duration,
    /// up to a time that somebody waits.
    pub wall: Duration,
}

impl From<Duration> for Allowed {
    fn from(cpu: Duration) -> Allowed {
        Allowed { cpu, wall: BUSY * cpu }
    }
}

/// Runs `method` until it ends or the time `allowed` is over.
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
    // On one thread, so that its time is the method's.
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
        clocks: (ThreadTime::now(), Instant::now()),
    };
    let (outcome, seconds) = cpu_seconds(|| simulate(system, method, span, motion.start, &mut sink));
    let outcome = outcome?;
    let is_too_slow =
        outcome.failure.as_ref().is_some_and(|failure| failure.reason == Stop::deadline(allowed.cpu).reason);
    let Sampler { rows, sizes, drift, .. } = sink;
    Ok(RunSample { rows, sizes, drift, statistics: outcome.statistics, failure: outcome.failure, is_too_slow, seconds })
}

/// CPU time that `work` takes on this thread, s.
pub fn cpu_seconds<T>(work: impl FnOnce() -> T) -> (T, f64) {
    let clock = ThreadTime::now();
    let result = work();
    (result, clock.elapsed().as_secs_f64())
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
    clocks: (ThreadTime, Instant),
}

/// On a busy machine a run may take so many times its CPU time.
const BUSY: u32 = 3;

impl Sink for Sampler<'_> {
    fn accepted(&mut self, state: &Observation) {
        self.drift.add(state, &self.scales);
    }

    fn row(&mut self, state: &Observation) {
        self.sizes.add(self.motion.system, state, &self.scales, &mut self.scratch);
        if state.t > self.start {
            self.rows.push(self.watched.read(self.motion.system, state, &mut self.scratch));
        }
    }

    fn stops(&self) -> Option<Stop> {
        if (self.motion.is_stopped)() {
            return Some(Stop { reason: "interrupted".to_string(), hint: "begin again".to_string() });
        }
        // The clock of CPU time is slow to read, and never ahead of the other.
        let (cpu, wall) = self.clocks;
        let (waited, Allowed { cpu: most, wall: longest }) = (wall.elapsed(), self.allowed);
        let is_over = waited > longest || waited > most && cpu.elapsed() > most;
        is_over.then(|| Stop::deadline(most))
    }
}
