//! Runs of changed models, measured against the richest.

use super::edit::{elements, text};
use super::promise::Promise;
use super::source::Source;
use crate::compare::work_precision::{Allowed, Motion, RunSample, Watched, sample};
use crate::error::{Failure, Result};
use crate::prepared::{AnyMechanism, PreparedScene};
use crate::simulate::Method;
use crate::system::Dimensions;
use serde::Serialize;
use serde_json::Value;
use std::time::Duration;

/// A run of a model.
#[derive(Clone, Debug, Serialize)]
pub struct Run {
    /// n_v.
    pub velocities: usize,
    /// n_c.
    pub constraints: usize,
    /// Method of the run.
    pub method: Method,
    /// CPU time, s.
    pub seconds: f64,
    /// Evaluations, iterations and factorizations, times velocities and constraints.
    pub work: f64,
    /// Difference of each watched output from the richest model; empty where the run failed.
    pub outputs: Vec<Difference>,
    /// Reason why it did not complete.
    pub failure: Option<Failure>,
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

impl Run {
    /// The output that is farthest off; none where the run failed.
    pub fn worst(&self) -> Option<&Difference> {
        self.outputs.iter().max_by(|a, b| a.error.total_cmp(&b.error))
    }

    /// The largest difference; infinite where the run failed.
    pub fn error(&self) -> f64 {
        self.worst().map_or(f64::INFINITY, |worst| worst.error)
    }
}

/// Where models are run: the promise, and how many runs are left.
pub struct Bench<'a> {
    /// The richest model as JSON.
    pub source: &'a Source,
    /// The watched outputs of the richest model.
    pub promise: &'a Promise,
    /// True if the user asks to stop.
    pub is_stopped: &'a (dyn Fn() -> bool + Sync),
    /// Called before each run with what is run and the number of runs done.
    pub watch: &'a mut dyn FnMut(&str, usize),
    /// Runs done.
    pub runs: usize,
    /// Runs allowed.
    pub at_most: usize,
}

impl Bench<'_> {
    /// True if no run may be done any more, or but `reserved` are.
    pub fn is_over(&self, reserved: usize) -> bool {
        self.runs + reserved >= self.at_most || (self.is_stopped)()
    }

    /// Runs a scene for `allowed` CPU time at most.
    ///
    /// # Errors
    /// Reason why the scene cannot be run.
    pub fn run(&mut self, scene: &Value, what: &str, allowed: Duration) -> std::result::Result<Run, String> {
        let prepared = self.source.prepare(scene).map_err(|error| error.to_string())?;
        (self.watch)(what, self.runs);
        self.runs += 1;
        measured(&prepared, self.promise, allowed, self.is_stopped).map_err(|error| error.to_string())
    }

    /// See [`size`].
    ///
    /// # Errors
    /// As [`size`].
    pub fn size(&self, scene: &Value) -> std::result::Result<usize, String> {
        let names: Vec<String> = self.promise.columns.iter().map(|column| column.name.clone()).collect();
        size(self.source, &names, scene)
    }
}

/// Number of velocities and constraints of a scene that has all watched outputs.
///
/// # Errors
/// Reason why it is none.
pub fn size(source: &Source, watched: &[String], scene: &Value) -> std::result::Result<usize, String> {
    let outputs = elements(scene, "outputs");
    let is_lost = |name: &&String| outputs.iter().all(|output| text(output, "name") != name.as_str());
    let lost: Vec<&String> = watched.iter().filter(is_lost).collect();
    if let [name, rest @ ..] = &lost[..] {
        let more = if rest.is_empty() { String::new() } else { format!(" and {} more", rest.len()) };
        return Err(format!("takes away the watched output `{name}`{more}"));
    }
    let scene = source.elements.parse_in(&source.folder, &scene.to_string(), &[]);
    let mechanism = AnyMechanism::new(scene.map_err(|error| error.to_string())?.model);
    let Dimensions { v, lambda, .. } = mechanism.system().dimensions();
    Ok(v + lambda)
}

/// Wall-clock time that a run may take on a busy machine: so many times its CPU time, and this more.
const BUSY: u32 = 20;
const WAIT: Duration = Duration::from_secs(60);

/// Runs a prepared model by its own method.
///
/// # Errors
/// It has not all outputs, or no end time.
pub fn sampled(
    prepared: &PreparedScene,
    names: &[String],
    allowed: Duration,
    is_stopped: &(dyn Fn() -> bool + Sync),
) -> Result<RunSample> {
    let (system, method) = (prepared.system(), &prepared.method);
    let watched = Watched::new(system, names)?;
    let span = prepared.span()?;
    let between = (span.start, span.end);
    let ratio = method.atol / method.rtol;
    let motion = Motion { system, start: prepared.start(), between, ratio, counts_start: true, is_stopped };
    sample(&motion, &watched, method, span, Allowed { cpu: allowed, wall: BUSY * allowed + WAIT })
}

/// Runs a prepared model by its own method and measures it.
///
/// # Errors
/// As [`sampled`].
pub fn measured(
    prepared: &PreparedScene,
    promise: &Promise,
    allowed: Duration,
    is_stopped: &(dyn Fn() -> bool + Sync),
) -> Result<Run> {
    let names: Vec<String> = promise.columns.iter().map(|column| column.name.clone()).collect();
    let RunSample { rows, statistics, failure, seconds, .. } = sampled(prepared, &names, allowed, is_stopped)?;
    let Dimensions { v, lambda, .. } = prepared.system().dimensions();
    let errors = failure.is_none().then(|| promise.errors(&rows)).flatten().unwrap_or_default();
    let differences = names.into_iter().zip(errors).map(|(name, error)| Difference { name, error });
    let counted = statistics.rhs_evaluations + statistics.newton_iterations + 2 * statistics.factorizations;
    Ok(Run {
        velocities: v,
        constraints: lambda,
        method: prepared.method.clone(),
        seconds,
        work: counted as f64 * (v + lambda) as f64,
        outputs: differences.collect(),
        failure,
        rows,
    })
}
