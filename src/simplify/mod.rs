//! Only what a motion requires: the least model of a scene, and the cheapest method for it, that keep a promise.
//!
//! 1. The scene is the full model. It is run twice: at a hundredth of its tolerance for the outputs that all others are
//!    compared with ([`Promise`]) and for what its parts do ([`Facts`]); by its own method for its cost and own error.
//!    Where that is more than a tenth of the promise a tighter tolerance or a shorter step takes its place.
//! 2. Each [`Candidate`] looks at the facts and proposes changes of the scene, with a rough estimate of their effect:
//!    shares of energy and work, relative motions, deflections; at least what they do at once to the outputs at states of
//!    the motion, accelerations and reactions with them. What they do later would take the state-transition matrix, which
//!    costs 10 to 100 runs of the full model, where the search runs fewer than two models in vain; or the equations
//!    linearized about the run, for changes that keep the coordinates: in 92 searches, of all scenes within 10 % and 1 %,
//!    20 of these were run in vain for their effect, and 27 searches would have had to pay for the estimate.
//! 3. Changes are tried where they save most, all of a kind together and, where that is refused, in halves. What is run is
//!    always the whole model with all that was kept before, so that changes which are harmless alone and wrong together
//!    are found out. A change is kept if every watched output stays within the promise, numerical error included. Where it
//!    is not, what was measured corrects what is expected of its alternatives, and the doubtful ones come last.
//! 4. Methods and tolerances are tried on the model that is found: their own error is to be a tenth of the promise.
//! 5. With [`Nearby`] a change, or a method, is kept only if it keeps the promise on motions near the given one, too.
//!
//! To add a kind: a file with a [`Candidate`] and a line in [`registry`], or from outside the crate in the list that
//! [`simplify`] takes.

mod assembled;
mod base;
mod bench;
mod candidate;
mod candidates;
mod displaced;
mod facts;
mod grid;
mod held;
mod modes;
mod moved;
mod nearby;
mod numerics;
mod promise;
mod recorded;
mod relative;
mod rods;
mod run;
mod search;
mod source;
mod start;

pub use crate::study::Norm;
pub use candidate::{Candidate, Edit, Proposal};
pub use candidates::registry;
pub use facts::{Facts, PlacedMarker};
pub use nearby::{Nearby, NearbyMotion, Robustness, Which};
pub use promise::Promise;
pub use relative::Relative;
pub use rods::RodForce;
pub use run::{Difference, ModelRun};
pub use search::Trial;
pub use source::Source;
pub use start::{Hint, Hints, Unseen, hints};

use crate::error::{Result, Warning, percent};
use crate::scene::document as edit;
use crate::study::price::Prices;
use crate::study::{Budget, SecondOpinion};
use base::{Accurate, Base, METHOD, contradicted, doubts};
use bench::Bench;
use nearby::Neighbourhood;
use search::FoundModel;
use serde::Serialize;
use serde_json::{Value, json};
use std::time::Duration;

/// What is promised, and how much it may cost to find the model.
#[derive(Clone, Debug, PartialEq)]
pub struct SimplificationSettings {
    /// Allowed difference of every watched output from the full model: 0.1 for 10 %.
    pub within: f64,
    /// How the difference is taken.
    pub norm: Norm,
    /// Names of the watched outputs; all where it is empty.
    pub outputs: Vec<String>,
    /// Number of runs in all, and of runs of the full model that take the same work; those of
    /// [`nearby`](Self::nearby) apart.
    pub at_most: usize,
    /// Time for all of it, those of [`nearby`](Self::nearby) included; none: no limit. Where it does not suffice for
    /// the motion of the full model, the promise is about the first part of that.
    pub budget: Option<Duration>,
    /// Motions on which the promise is tried.
    pub nearby: Option<Nearby>,
}

impl Default for SimplificationSettings {
    fn default() -> Self {
        SimplificationSettings {
            within: 0.05,
            norm: Norm::Range,
            outputs: Vec::new(),
            at_most: 15,
            budget: None,
            nearby: None,
        }
    }
}

/// The least model that was found.
#[derive(Clone, Debug, Serialize)]
pub struct Simplification {
    /// Name of the richest scene.
    pub scene: String,
    /// Promised difference.
    pub within: f64,
    /// Norm of the difference.
    pub norm: Norm,
    /// The watched outputs.
    pub outputs: Vec<String>,
    /// Run of the full model by its own method.
    pub richest: ModelRun,
    /// The difference of the accurate run of the full model from a run of diffsol.
    pub second_opinion: Option<SecondOpinion>,
    /// All changes in the order in which they were tried; the last ones of kind `method`.
    pub trials: Vec<Trial>,
    /// Run of the model that is chosen.
    pub chosen: ModelRun,
    /// Number of runs.
    pub runs: usize,
    /// Their counted work, in that of one of the full model.
    pub cost: f64,
    /// The promise on motions nearby.
    pub robustness: Option<Robustness>,
    /// What has to be known about the result.
    #[serde(skip)]
    pub warnings: Vec<Warning>,
    /// The model that is chosen, as a scene.
    #[serde(skip)]
    pub simplified: Value,
}

impl Simplification {
    /// True if anything but the method is simpler than in the full model.
    pub fn is_simpler(&self) -> bool {
        self.left_out().next().is_some()
    }

    /// What the chosen run is off by, if that is more than was promised: no method that was tried keeps the promise.
    pub fn broken(&self) -> Option<String> {
        let Simplification { chosen, within, .. } = self;
        chosen.refusal(*within).map(|reason| format!("no run keeps within {}: {reason}", percent(*within)))
    }

    /// The changes of the model that were kept, without those of the method.
    pub fn left_out(&self) -> impl Iterator<Item = &Trial> {
        self.trials.iter().filter(|trial| trial.is_kept && trial.candidate != METHOD)
    }
}

/// Part of the runs that the search for a model leaves to that for a method.
const RESERVED: usize = 3;
/// The least number of runs: two of the full model, and one of another.
const LEAST: usize = 3;
/// Its accurate run may take one of so many parts of the budget.
const RICHEST: u32 = 4;
/// Motions nearby begin with the full model, until one of so many parts of the budget is over.
const NEARBY: u32 = 2;

/// Finds the least model of a scene that keeps a promise.
///
/// `watch` is called before each run with what is run and the number of runs done.
///
/// # Errors
/// Unknown outputs, a scene without outputs, settings out of range; a richest model that does not complete.
pub fn simplify(
    source: &Source,
    settings: &SimplificationSettings,
    candidates: &[&dyn Candidate],
    is_stopped: &(dyn Fn() -> bool + Sync),
    watch: &mut dyn FnMut(&str, usize),
) -> Result<Simplification> {
    let budget = settings.budget.map(Budget::begin);
    let is_late = |part: u32| budget.is_some_and(|budget| budget.spent() >= budget.all / part);
    let is_over = || is_stopped() || is_late(1);
    let is_long = || is_stopped() || is_late(RICHEST);
    let is_near_long = || is_stopped() || is_late(NEARBY);
    let (full, mut warnings) = FullModel::new(source, settings, &is_long, &is_over, watch)?;
    let neighbourhood = full.neighbourhood(settings, &is_near_long, &is_over, watch)?;
    warnings.extend(neighbourhood.as_ref().and_then(Neighbourhood::doubt));
    let mut bench = Bench {
        source: &full.facts.source,
        promise: &full.promise,
        is_stopped: &is_over,
        watch,
        runs: full.runs,
        cost: full.work / full.richest.work,
        richest: &full.richest,
        at_most: settings.at_most,
        neighbourhood: neighbourhood.as_ref().filter(|near| !near.is_empty()),
        prices: Prices::new(),
    };
    let least = least_model(&mut bench, &full, candidates);
    let mut result = Simplification {
        scene: full.facts.prepared.name.clone(),
        within: settings.within,
        norm: settings.norm,
        outputs: full.promise.names(),
        richest: full.richest.clone(),
        second_opinion: full.second_opinion.clone(),
        trials: least.trials,
        chosen: least.run,
        runs: bench.runs,
        cost: bench.cost,
        robustness: least.robustness,
        warnings,
        simplified: Value::Null,
    };
    complete(&mut result, least.scene, source, &full.facts, is_late(1))?;
    Ok(result)
}

/// The full model with what its runs say.
struct FullModel {
    facts: Facts,
    promise: Promise,
    richest: ModelRun,
    /// The change of its method, if there was one.
    trials: Vec<Trial>,
    runs: usize,
    /// Their counted work.
    work: f64,
    second_opinion: Option<SecondOpinion>,
}

impl FullModel {
    /// Runs the full model, its accurate run until `is_long`. Returns also what is doubtful about it.
    fn new(
        source: &Source,
        settings: &SimplificationSettings,
        is_long: &(dyn Fn() -> bool + Sync),
        is_over: &(dyn Fn() -> bool + Sync),
        watch: &mut dyn FnMut(&str, usize),
    ) -> Result<(FullModel, Vec<Warning>)> {
        let Base { accurate, richest, trials, runs, work } = Base::new(source, settings, is_long, is_over, watch)?;
        let mut warnings = doubts(&accurate, &richest);
        watch("the full model by diffsol", runs);
        let second_opinion = accurate.confirmed(settings, is_over);
        warnings.extend(second_opinion.as_ref().and_then(|opinion| contradicted(opinion, settings.within)));
        let Accurate { source, prepared, recorded, promise, .. } = accurate;
        let facts = Facts::new(source, prepared, promise.names(), recorded);
        Ok((FullModel { facts, promise, richest, trials, runs, work, second_opinion }, warnings))
    }

    /// Runs it on the motions nearby that the settings ask for, until `is_long`.
    fn neighbourhood<'a>(
        &'a self,
        settings: &SimplificationSettings,
        is_long: &'a (dyn Fn() -> bool + Sync),
        is_over: &'a (dyn Fn() -> bool + Sync),
        watch: &mut dyn FnMut(&str, usize),
    ) -> Result<Option<Neighbourhood<'a>>> {
        let Some(nearby) = settings.nearby else { return Ok(None) };
        watch("the full model on motions nearby", self.runs);
        Neighbourhood::new(&self.facts, &self.promise, nearby, self.richest.work, is_long, is_over).map(Some)
    }
}

/// Returns the least model, and the cheapest method for it.
fn least_model(bench: &mut Bench, full: &FullModel, candidates: &[&dyn Candidate]) -> FoundModel {
    bench.enter(&full.richest);
    let reserved = RESERVED.min((bench.at_most - LEAST) / 2);
    let mut least = search::search(bench, &full.facts, candidates, full.trials.clone(), reserved);
    numerics::cheapest(bench, &mut least);
    // Where nothing was changed it has not been tried.
    if least.robustness.is_none() && !(bench.is_stopped)() {
        least.robustness = bench.neighbourhood.map(|near| near.robustness(&least.scene));
    }
    least
}

/// Adds the chosen scene over the whole time of the `source`, and warnings about the search and the modes that are lost.
fn complete(
    result: &mut Simplification,
    mut scene: Value,
    source: &Source,
    facts: &Facts,
    is_late: bool,
) -> Result<()> {
    scene["simulation"]["t_end"] = source.scene["simulation"]["t_end"].clone();
    result.simplified = described(source.anywhere(&scene), result);
    if is_late {
        let text = "the time was over before all changes and methods were tried".to_string();
        result.warnings.push(Warning::new(text, "give more time by --budget"));
    }
    if result.is_simpler() {
        result.warnings.extend(modes::lost(&facts.prepared, &facts.source.prepare(&scene)?));
    }
    Ok(())
}

/// The scene with what was left out, and why, in its words.
fn described(mut scene: Value, result: &Simplification) -> Value {
    let changes: Vec<String> =
        result.left_out().map(|trial| format!("{} ({})", trial.what.join(", "), trial.why)).collect();
    // What the scene says of itself may no longer be so.
    let about = scene["about"].as_str().map_or(String::new(), |about| format!(" About {}: {about}", result.scene));
    let left_out = if changes.is_empty() { "nothing can be left out".to_string() } else { changes.join("; ") };
    let promise = match result.broken() {
        Some(broken) => format!(" ({broken})"),
        None if result.warnings.is_empty() => {
            format!(", within {} in {}", percent(result.within), result.outputs.join(", "))
        }
        // Where the full model's own error is larger nobody knows.
        None => String::new(),
    };
    scene["about"] = json!(format!("Simplified from {}{promise}: {left_out}.{about}", result.scene));
    scene["name"] = json!(format!("{}_simplified", result.scene));
    scene
}
