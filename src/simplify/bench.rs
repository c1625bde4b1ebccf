//! Where models are run and counted.

use super::edit::{elements, text};
use super::nearby::{Neighbourhood, Robustness};
use super::promise::Promise;
use super::run::{Difference, ModelRun, measured};
use super::source::Source;
use crate::error::{Error, percent};
use crate::prepared::AnyMechanism;
use crate::study::price::{Class, Prices};
use serde_json::Value;
use std::time::Duration;

/// Where models are run: the promise, and how many runs are left.
pub struct Bench<'a> {
    /// The full model as JSON.
    pub source: &'a Source,
    /// The watched outputs of the full model.
    pub promise: &'a Promise,
    /// True if the user asks to stop.
    pub is_stopped: &'a (dyn Fn() -> bool + Sync),
    /// Called before each run with what is run and the number of runs done.
    pub watch: &'a mut dyn FnMut(&str, usize),
    /// Runs done.
    pub runs: usize,
    /// Their counted work, in that of one of the full model.
    pub cost: f64,
    /// A run of the full model.
    pub richest: &'a ModelRun,
    /// Runs allowed, and work.
    pub at_most: usize,
    /// Motions on which a model has to keep the promise, too.
    pub neighbourhood: Option<&'a Neighbourhood<'a>>,
    /// CPU times of a unit of the work that was run.
    pub prices: Prices<WorkKind>,
}

/// Part of the allowed work that may be counted. The rest is for what is not: estimates, and scenes that are built in
/// vain, which take 1.2 runs of `n_four_bar`.
const COUNTED: f64 = 0.9;
/// CPU time that a run may take more than it is allowed: the clock of Windows counts it in steps of 1/64 s.
const TICKS: Duration = Duration::from_millis(if cfg!(windows) { 50 } else { 0 });

/// Runs with the same kind of work on models of the same size, whose time per unit is the same.
type WorkKind = (Class, [usize; 2]);

fn kind(run: &ModelRun) -> WorkKind {
    (run.class.clone(), [run.velocities, run.constraints])
}

impl Bench<'_> {
    /// True if no run may be done any more, or but `reserved` are.
    pub fn is_over(&self, reserved: usize) -> bool {
        let at_most = self.at_most as f64;
        let reserved = reserved as f64;
        let is_done = self.runs as f64 + reserved >= at_most || self.cost + reserved >= COUNTED * at_most;
        is_done || (self.is_stopped)()
    }

    /// Runs a scene, for little more CPU time, s, than `seconds` and than the runs that are left may take.
    ///
    /// # Errors
    /// Reason why the scene cannot be run.
    pub fn run(&mut self, scene: &Value, what: &str, seconds: f64) -> std::result::Result<ModelRun, String> {
        let prepared = self.source.prepare(scene).map_err(impossible)?;
        (self.watch)(what, self.runs);
        self.runs += 1;
        let left = (COUNTED * self.at_most as f64 - self.cost).max(0.0) * self.richest.seconds;
        let allowed = Duration::from_secs_f64(seconds.min(left)) + TICKS;
        let run = measured(&prepared, self.promise, allowed, self.is_stopped).map_err(impossible)?;
        // What was stopped by the clock has taken that time, whatever it counts by then.
        self.cost += if run.is_too_slow { run.seconds / self.richest.seconds } else { run.work / self.richest.work };
        self.enter(&run);
        Ok(run)
    }

    /// Enters the price of a run.
    pub fn enter(&mut self, run: &ModelRun) {
        self.prices.enter(kind(run), run.seconds, run.work);
    }

    /// CPU time of a run, s: its counted work at the median price of its kind, so that the clock of a busy machine does
    /// not decide between two.
    pub fn cost(&self, run: &ModelRun) -> f64 {
        self.prices.cost(&kind(run), run.work).unwrap_or(run.seconds)
    }

    /// Tries a model that keeps the promise on motions nearby.
    ///
    /// # Errors
    /// Reason why it does not keep it there.
    pub fn robustness(&mut self, scene: &Value) -> std::result::Result<Option<Robustness>, String> {
        let Some(neighbourhood) = self.neighbourhood else { return Ok(None) };
        (self.watch)("motions nearby", self.runs);
        let found = neighbourhood.robustness(scene);
        if (self.is_stopped)() {
            return Err("the time was over before it was tried on all motions nearby".to_string());
        }
        let Robustness { counted, kept, .. } = found;
        let worst = found.worst().filter(|worst| worst.error > self.promise.within);
        let off = |worst: &Difference| format!("{} is off by up to {}", worst.name, percent(worst.error));
        let worst = worst.map_or("it does not complete all".to_string(), off);
        if found.is_kept() {
            Ok(Some(found))
        } else {
            Err(format!("kept on {kept} of {counted} motions nearby only: {worst}"))
        }
    }

    /// See [`mechanism`].
    ///
    /// # Errors
    /// As [`mechanism`].
    pub fn mechanism(&self, scene: &Value) -> std::result::Result<AnyMechanism, String> {
        mechanism(self.source, &self.promise.names(), scene)
    }
}

/// Why a changed scene is none, without the place in a file that nobody has seen.
fn impossible(error: Error) -> String {
    let reason = match error {
        Error::Input(input) => match &input.element {
            Some(element) => format!("`{element}`: {}", input.message),
            None => input.message,
        },
        other => other.to_string(),
    };
    format!("what is left is no scene: {}", reason.lines().next().unwrap_or_default())
}

/// The mechanism of a scene that has all watched outputs.
///
/// # Errors
/// Reason why it is none.
pub fn mechanism(source: &Source, watched: &[String], scene: &Value) -> std::result::Result<AnyMechanism, String> {
    let outputs = elements(scene, "outputs");
    let is_lost = |name: &&String| outputs.iter().all(|output| text(output, "name") != name.as_str());
    let lost: Vec<&String> = watched.iter().filter(is_lost).collect();
    if let [name, rest @ ..] = &lost[..] {
        let more = if rest.is_empty() { String::new() } else { format!(" and {} more", rest.len()) };
        return Err(format!("takes away the watched output `{name}`{more}"));
    }
    let scene = source.elements.parse_in(&source.folder, &scene.to_string(), &[]);
    Ok(AnyMechanism::new(scene.map_err(impossible)?.model))
}
