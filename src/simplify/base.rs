//! The full model: accurately, and by a method whose own error the promise allows.

use super::assembled::carried;
use super::edit::{elements, text};
use super::promise::Promise;
use super::recorded::{Recorded, record};
use super::run::{ModelRun, measured};
use super::search::{NUMERICAL, Trial};
use super::source::{Source, write_method};
use super::{LEAST, SimplificationSettings};
use crate::analysis::Passing;
use crate::error::{Error, Failure, Result, Warning, clock, percent, rounded, short_list, significant};
use crate::integrator;
use crate::prepared::Model;
use crate::simulate::{Method, atol_of};
use crate::study::work_precision::tighter;
use crate::study::{Motion, SecondOpinion, Watched, second_opinion};
use crate::tolerances;
use crate::trajectory::recorded;
use serde_json::json;
use std::time::Duration;

/// Kind of the trials of methods.
pub const METHOD: &str = "method";
/// Rows of the least part of a motion that a promise may be about.
const FEWEST_ROWS: usize = 10;
/// CPU time that the full model may take.
const ALLOWED: Duration = Duration::from_secs(3600);
/// The run of diffsol may take one of so many parts of the budget.
const CONFIRMED: u32 = 10;
/// A tighter method is to have this part of the error that is allowed: predictions are rough.
const AIM: f64 = 0.5;
/// Number of tighter methods that are tried.
const TIGHTENED: usize = 2;
/// A step, and a tolerance, that are so many times that of the accurate run are measured against it.
const COARSER: [f64; 2] = [2.0, 10.0];

/// The accurate run of the full model.
pub struct Accurate {
    /// The scene, until where the time allowed for.
    pub source: Source,
    pub prepared: Model,
    pub recorded: Recorded,
    pub promise: Promise,
    /// True if the time did not allow for the whole.
    is_shorter: bool,
}

/// The full model with its two runs.
pub struct Base {
    pub accurate: Accurate,
    /// Run by the method of the scene, or a tighter one whose own error the promise allows.
    pub richest: ModelRun,
    /// That tighter one, if it took one.
    pub trials: Vec<Trial>,
    pub runs: usize,
    /// Their counted work.
    pub work: f64,
}

impl Accurate {
    /// Runs the model at a hundredth of its tolerance until `is_long`.
    fn new(
        source: &Source,
        settings: &SimplificationSettings,
        is_long: &(dyn Fn() -> bool + Sync),
    ) -> Result<Accurate> {
        let mut prepared = source.prepare(&source.scene)?;
        let source = &carried(source, &prepared);
        let watched = watched(&prepared, settings)?;
        let mut recorded = record(&prepared, &watched, &tighter(&prepared.method), is_long)?;
        recorded.end_on_grid(prepared.span()?);
        let shorter = recorded.stopped.as_ref().map(|stopped| shorter(source, &recorded, stopped)).transpose()?;
        if let Some(source) = &shorter {
            prepared = source.prepare(&source.scene)?;
        }
        let undefined = (0..watched.columns.len()).find(|&i| recorded.rows.iter().any(|row| !row[i].is_finite()));
        if let Some(i) = undefined {
            let name = &watched.columns[i].name;
            return Err(Error::input(format!("the output `{name}` has no value at some time of the motion"))
                .under("outputs")
                .hint("name the others by --outputs"));
        }
        let SimplificationSettings { within, norm, .. } = *settings;
        let promise = Promise::new(within, norm, &watched.columns, recorded.rows.clone(), &recorded.sizes);
        let is_shorter = shorter.is_some();
        Ok(Accurate { source: shorter.unwrap_or_else(|| source.clone()), prepared, recorded, promise, is_shorter })
    }

    /// The same run, as the measure of the scene by another method.
    fn of(&self, source: Source) -> Result<Accurate> {
        let prepared = source.prepare(&source.scene)?;
        let Accurate { recorded, promise, is_shorter, .. } = self;
        Ok(Accurate { source, prepared, recorded: recorded.clone(), promise: promise.clone(), is_shorter: *is_shorter })
    }

    /// Compares the accurate run with one of diffsol, for which a part of the budget is allowed.
    pub fn confirmed(
        &self,
        settings: &SimplificationSettings,
        is_stopped: &(dyn Fn() -> bool + Sync),
    ) -> Option<SecondOpinion> {
        let span = self.prepared.span().ok()?;
        let watched = Watched::new(self.prepared.system(), &settings.outputs).ok()?;
        let motion = Motion { counts_start: true, ..Motion::of(&self.prepared, span, watched, is_stopped) };
        let allowed = settings.budget.map_or(ALLOWED, |budget| budget / CONFIRMED);
        Some(second_opinion(&motion, &self.recorded.rows, &self.prepared.method, allowed.into()))
    }

    /// Runs the model by its own method.
    fn measured(&self, is_stopped: &(dyn Fn() -> bool + Sync)) -> Result<ModelRun> {
        let run = measured(&self.prepared, &self.promise, ALLOWED, is_stopped)?;
        run.failure.clone().map_or(Ok(run), |failure| Err(failure.into()))
    }
}

impl Base {
    /// Runs the full model: at a hundredth of its tolerance until `is_long`, by its own method and, where the error
    /// of that is too much, by a tighter one.
    ///
    /// # Errors
    /// Unknown outputs, a scene without outputs, settings out of range; a richest model that does not complete.
    pub fn new(
        source: &Source,
        settings: &SimplificationSettings,
        is_long: &(dyn Fn() -> bool + Sync),
        is_stopped: &(dyn Fn() -> bool + Sync),
        watch: &mut dyn FnMut(&str, usize),
    ) -> Result<Base> {
        watch("the full model, accurately", 0);
        let accurate = Accurate::new(source, settings, is_long)?;
        watch("the full model", 1);
        let richest = accurate.measured(is_stopped)?;
        let work = accurate.recorded.work + richest.work;
        let mut base = Base { accurate, richest, trials: Vec::new(), runs: 2, work };
        for _ in 0..TIGHTENED {
            let Some(method) = base.sufficient().filter(|_| !is_stopped()) else { break };
            watch("the full model by a tighter method", base.runs);
            // Where that does not complete it stays as it is, and its error is told.
            let Ok(tightened) = base.tightened(&method, settings, is_long, is_stopped) else { break };
            base = tightened;
        }
        Ok(base)
    }

    /// The method of which an error within the allowed one is expected; none where that of the run is.
    fn sufficient(&self) -> Option<Method> {
        let method = &self.richest.method;
        let error = self.richest.error();
        let allowed = NUMERICAL * self.accurate.promise.within;
        if error <= allowed {
            return None;
        }
        let factor = AIM * allowed / error;
        Some(match method.step {
            Some(step) => {
                let order = integrator::find(&method.integrator).map_or(1, |entry| entry.order);
                Method { step: Some(rounded(step * factor.powf(1.0 / order as f64), 0)), ..method.clone() }
            }
            None => at(method, (factor * method.rtol).max(10.0 * tolerances::TIGHTEST)),
        })
        .filter(|finer| finer.step < method.step || finer.rtol < method.rtol)
    }

    /// The full model by a tighter method, against the accurate run that is there where that is accurate enough.
    fn tightened(
        &self,
        method: &Method,
        settings: &SimplificationSettings,
        is_long: &(dyn Fn() -> bool + Sync),
        is_stopped: &(dyn Fn() -> bool + Sync),
    ) -> Result<Base> {
        let known = tighter(&self.richest.method);
        let mut source = self.accurate.source.clone();
        write_method(&mut source.scene, method);
        let is_known = match (method.step, known.step) {
            (Some(step), Some(known)) => step >= COARSER[0] * known,
            _ => method.rtol >= COARSER[1] * known.rtol,
        };
        let accurate = if is_known { self.accurate.of(source)? } else { Accurate::new(&source, settings, is_long)? };
        if let Some(stopped) = accurate.recorded.stopped.clone().filter(|_| !is_known) {
            return Err(stopped.into());
        }
        let richest = accurate.measured(is_stopped)?;
        let trial = Trial {
            candidate: METHOD.to_string(),
            subjects: vec![method.triple()],
            what: vec![format!("the scene as it is at {}", accuracy(method))],
            why: format!("the error of {} is {}", accuracy(&self.richest.method), percent(self.richest.error())),
            estimated: NUMERICAL * self.accurate.promise.within,
            run: Some(richest.clone()),
            is_kept: true,
            reason: String::new(),
        };
        let again = if is_known { 0.0 } else { accurate.recorded.work };
        let runs = self.runs + if is_known { 1 } else { 2 };
        let work = self.work + again + richest.work;
        Ok(Base { accurate, richest, trials: vec![trial], runs, work })
    }
}

/// A warning if diffsol differs from the accurate run by more than a promise allows for numerical errors.
pub fn contradicted(opinion: &SecondOpinion, within: f64) -> Option<Warning> {
    let difference = opinion.difference.filter(|difference| *difference > NUMERICAL * within)?;
    let text = format!("diffsol, by {}, differs from the accurate run by {}", opinion.method, percent(difference));
    Some(Warning::new(text, "give the scene a tighter rtol and atol: one of the two runs is wrong by that"))
}

/// What is doubtful about the full model.
pub fn doubts(accurate: &Accurate, richest: &ModelRun) -> Vec<Warning> {
    let own = richest.error();
    let worst = richest.worst().map_or("", |worst| &worst.name);
    let coarse = (own > NUMERICAL * accurate.promise.within).then(|| {
        let text = format!("the full model's own numerical error is {} ({worst})", percent(own));
        Warning::new(text, "give it a tighter rtol and atol, or a shorter step")
    });
    let part = accurate.is_shorter.then(|| {
        let end = clock(accurate.recorded.end());
        let text = format!("the time sufficed for the motion until t = {end} s, which the promise is about");
        Warning::new(text, "give more time by --budget, or shorten the motion by --until")
    });
    coarse.into_iter().chain(part).chain(undetermined(accurate)).collect()
}

/// A warning about the watched reactions of joints whose rows depend on each other at singular states of the motion: what
/// the joints share there the equations do not tell, and a row may fall on such a state.
fn undetermined(accurate: &Accurate) -> Option<Warning> {
    let Accurate { source, recorded, promise, .. } = accurate;
    let singular: Vec<&Passing> = recorded.singularity.passed.iter().filter(|state| state.is_singular).collect();
    // Of large systems the joints are not known.
    let is_of = |joint: &str| {
        singular.iter().any(|state| state.joints.is_empty() || state.joints.iter().any(|own| own == joint))
    };
    let outputs = elements(&source.scene, "outputs").iter();
    let reactions = outputs.filter(|output| text(output, "measure") == "reaction" && is_of(text(output, "of")));
    let watched = promise.names();
    let names = reactions.map(|output| text(output, "name").to_string()).filter(|name| watched.contains(name));
    let names: Vec<String> = names.collect();
    let times: Vec<String> = singular.iter().map(|state| significant(state.t, 4)).collect();
    let text = format!(
        "the motion passes singular states, at t = {} s, where {} {} not determined: the promise holds beside these",
        short_list(&times),
        short_list(&names),
        if names.len() == 1 { "is" } else { "are" }
    );
    (!names.is_empty()).then(|| Warning::new(text, "name the other outputs by --outputs"))
}

/// Its tolerance, or its step, in words.
pub fn accuracy(method: &Method) -> String {
    method.step.map_or_else(|| format!("rtol {:e}", method.rtol), |step| format!("step {step:e} s"))
}

/// A method at another relative tolerance, of one digit.
pub fn at(method: &Method, rtol: f64) -> Method {
    let rtol = rounded(rtol, 0);
    Method { rtol, atol: atol_of(rtol, method.atol / method.rtol), ..method.clone() }
}

/// The scene until the last row that the time allowed for.
fn shorter(source: &Source, recorded: &Recorded, stopped: &Failure) -> Result<Source> {
    if recorded.rows.len() < FEWEST_ROWS {
        let reason = format!("the full model came to t = {} s only", clock(stopped.t));
        let hint = "give it more time by --budget, a shorter motion by --until, or the scene a faster method: an implicit one \
             where it is stiff; `holonom check` says what looks superfluous from the start alone";
        return Err(Failure { reason, hint: hint.to_string(), t: stopped.t }.into());
    }
    let mut source = source.clone();
    source.scene["simulation"]["t_end"] = json!(recorded.end());
    Ok(source)
}

fn watched(prepared: &Model, settings: &SimplificationSettings) -> Result<Watched> {
    if !(settings.within > 0.0 && settings.within < 1.0) {
        return Err(Error::input("a promise is above 0 % and below 100 %").under("--within").hint("write --within 5%"));
    }
    if settings.at_most < LEAST {
        return Err(Error::input(format!("{} runs are too few", settings.at_most))
            .under("--at-most")
            .hint(format!("{LEAST} at least: two of the full model, and one of another")));
    }
    if recorded(prepared.system()).is_empty() {
        return Err(Error::input("the scene has no outputs that a promise could be about")
            .under("outputs")
            .hint("give it \"outputs\""));
    }
    Watched::new(prepared.system(), &settings.outputs).map_err(|error| error.under("--outputs"))
}
