//! A run of a model, measured against the richest.

use super::promise::Promise;
use crate::error::{Failure, Result, percent};
use crate::formulation::{Statistics, Work};
use crate::prepared::Model;
use crate::simulate::{Method, explicit};
use crate::study::price::{Class, Worker};
use crate::study::{Motion, RunSample, Watched};
use crate::system::Dimensions;
use serde::Serialize;
use std::time::Duration;

/// A run of a model.
#[derive(Clone, Debug, Serialize)]
pub struct ModelRun {
    /// n_v.
    pub velocities: usize,
    /// n_c.
    pub constraints: usize,
    /// Method of the run.
    pub method: Method,
    /// CPU time, s.
    pub seconds: f64,
    /// Counted work: see `counted`.
    pub work: f64,
    /// Kind of the work.
    #[serde(skip)]
    pub class: Class,
    /// Difference of each watched output from the full model; empty where the run failed.
    pub outputs: Vec<Difference>,
    /// Reason why it did not complete.
    pub failure: Option<Failure>,
    /// True if it was stopped at its time limit.
    #[serde(skip)]
    pub is_too_slow: bool,
    /// Values of the watched outputs.
    #[serde(skip)]
    pub rows: Vec<Vec<f64>>,
}

/// Difference of an output.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Difference {
    /// Name of the output.
    pub name: String,
    /// Difference relative to the size of the output.
    pub error: f64,
}

impl ModelRun {
    /// The output that is farthest off; none where the run failed.
    pub fn worst(&self) -> Option<&Difference> {
        self.outputs.iter().max_by(|a, b| a.error.total_cmp(&b.error))
    }

    /// The largest difference; infinite where the run failed.
    pub fn error(&self) -> f64 {
        self.worst().map_or(f64::INFINITY, |worst| worst.error)
    }

    /// Reason why the promise of so much is not kept; none if it is.
    pub fn refusal(&self, within: f64) -> Option<String> {
        match (&self.failure, self.worst()) {
            (Some(failure), _) => Some(failure.reason.clone()),
            (None, None) => Some("it has no values at the times of the full model".to_string()),
            (None, Some(worst)) => {
                (worst.error > within).then(|| format!("{} is off by {}", worst.name, percent(worst.error)))
            }
        }
    }
}

/// Runs a prepared model by its own method.
///
/// # Errors
/// It has not all outputs, or no end time.
pub fn sampled(
    prepared: &Model,
    names: &[String],
    allowed: Duration,
    is_stopped: &(dyn Fn() -> bool + Sync),
) -> Result<RunSample> {
    let watched = Watched::new(prepared.system(), names)?;
    let motion = Motion { counts_start: true, ..Motion::of(prepared, prepared.span()?, watched, is_stopped) };
    motion.run(&prepared.method, allowed)
}

/// The work of the steps of a run in solutions of the equations of motion, times velocities and constraints. Rows are
/// as many in every model.
pub fn counted(prepared: &Model, method: &Method, statistics: Statistics) -> f64 {
    let Dimensions { v, lambda, .. } = prepared.system().dimensions();
    let steps = Statistics { rows: Work::default(), ..statistics };
    worker(method).work(steps) * (v + lambda) as f64
}

fn worker(method: &Method) -> Worker<'_> {
    Worker { method, is_explicit: explicit(method).is_some() }
}

/// Runs a prepared model by its own method and measures it.
///
/// # Errors
/// As [`sampled`].
pub fn measured(
    prepared: &Model,
    promise: &Promise,
    allowed: Duration,
    is_stopped: &(dyn Fn() -> bool + Sync),
) -> Result<ModelRun> {
    let names = promise.names();
    let RunSample { rows, statistics, failure, is_too_slow, seconds, .. } =
        sampled(prepared, &names, allowed, is_stopped)?;
    let Dimensions { v, lambda, .. } = prepared.system().dimensions();
    let errors = failure.is_none().then(|| promise.errors(&rows)).flatten().unwrap_or_default();
    let differences = names.into_iter().zip(errors).map(|(name, error)| Difference { name, error });
    Ok(ModelRun {
        velocities: v,
        constraints: lambda,
        method: prepared.method.clone(),
        seconds,
        work: counted(prepared, &prepared.method, statistics),
        class: worker(&prepared.method).class(),
        outputs: differences.collect(),
        failure,
        is_too_slow,
        rows,
    })
}
