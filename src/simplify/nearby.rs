//! The promise on motions near the one that it was made for.

use super::facts::Facts;
use super::moved::{Movable, Move};
use super::promise::Promise;
use super::run::{Difference, ModelRun, measured, sampled};
use super::source::Source;
use crate::error::{Error, Result, Warning};
use crate::study::RunSample;
use crate::study::pool::{cores, run_all};
use serde::Serialize;
use serde_json::Value;
use std::time::Duration;

/// Motions near the given one. Times 1 + u: each parameter that is a number, all velocities at the start together, and
/// all inputs and signals together. The positions at the start go u of the way that the motion takes, back where u is
/// negative: as far as the bodies go from there, or turn, at most; not where there are beams, which assembly would
/// strain. Each u is evenly distributed between -by and by, and the same in every run.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub struct Nearby {
    /// Largest relative change.
    pub by: f64,
    /// Number of motions; from 20, where the full model takes much work, to 60 where none is given.
    pub samples: Option<usize>,
}

/// The promise on motions nearby.
#[derive(Clone, Debug, Serialize)]
pub struct Robustness {
    /// How far the motions are from the given one.
    pub by: f64,
    /// Parameters that were moved.
    pub parameters: Vec<String>,
    /// True if the velocities at the start were moved, too.
    pub velocities: bool,
    /// True if the positions at the start were.
    pub positions: bool,
    /// Inputs and signals that were.
    pub inputs: Vec<String>,
    /// The motions that were tried.
    pub motions: Vec<NearbyMotion>,
    /// Number of motions that the full model completes.
    pub counted: usize,
    /// Number of these on which the promise is kept.
    pub kept: usize,
}

/// A motion nearby.
#[derive(Clone, Debug, Serialize)]
pub struct NearbyMotion {
    /// The watched output that is farthest off; none where a model does not complete.
    pub worst: Option<Difference>,
    /// Model that does not complete, and why.
    pub failure: Option<(Which, String)>,
}

/// One of the two models.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize)]
#[serde(rename_all = "snake_case")]
pub enum Which {
    /// The richest one.
    Richest,
    /// The simplified one.
    Simplified,
}

/// CPU time that a run of either model may take.
const ALLOWED: Duration = Duration::from_secs(600);
/// Part of the motions that may break the promise: half of the twentieth that is granted, the other half being a
/// reserve for motions that are not tried.
const MAY_BREAK: f64 = 0.5 * 0.05;
/// Work of the full model on all motions together up to which there are more than the least number of them.
const AFFORDED: f64 = 1e8;
/// Least and largest number of motions: 60 of 60 say with 95 % certainty that the promise is kept on 95 % of all.
const SAMPLES: [usize; 2] = [20, 60];
/// Number of motions after which a model that breaks the promise too often is given up.
const TOGETHER: usize = 10;

impl Robustness {
    /// True if the promise is kept on so many of the motions that it can be given for those nearby.
    pub fn is_kept(&self) -> bool {
        (self.counted - self.kept) as f64 <= MAY_BREAK * self.counted as f64
    }

    /// The output that is farthest off on any of the motions.
    pub fn worst(&self) -> Option<&Difference> {
        self.errors().max_by(|a, b| a.error.total_cmp(&b.error))
    }

    fn errors(&self) -> impl Iterator<Item = &Difference> {
        self.motions.iter().filter_map(|motion| motion.worst.as_ref())
    }

    /// Number of motions that a model does not complete.
    pub fn incomplete(&self, which: Which) -> usize {
        let is_of = |motion: &&NearbyMotion| motion.failure.as_ref().is_some_and(|(own, _)| *own == which);
        self.motions.iter().filter(is_of).count()
    }
}

/// What is moved, with the promise about that motion, or the reason why the full model does not complete it.
type Moved = std::result::Result<(Move, Promise), String>;

/// The full model on motions nearby.
pub struct Neighbourhood<'a> {
    source: &'a Source,
    within: f64,
    by: f64,
    movable: Movable<'a>,
    motions: Vec<Moved>,
    /// Number of motions that there were to be.
    wanted: usize,
    is_stopped: &'a (dyn Fn() -> bool + Sync),
}

impl<'a> Neighbourhood<'a> {
    /// Runs the full model, a run of which takes `work`, on the motions near that of `promise`, until `is_long`;
    /// models are tried on them until `is_stopped`.
    ///
    /// # Errors
    /// Nothing can be moved; the full model completes none of the motions, though there is time.
    pub fn new(
        facts: &'a Facts,
        promise: &Promise,
        nearby: Nearby,
        work: f64,
        is_long: &'a (dyn Fn() -> bool + Sync),
        is_stopped: &'a (dyn Fn() -> bool + Sync),
    ) -> Result<Neighbourhood<'a>> {
        let Nearby { by, samples } = nearby;
        let source = &facts.source;
        let movable = Movable::new(source, facts, by);
        if movable.is_empty() {
            return Err(Error::input("the scene has no parameter, input or motion at the start that could be moved")
                .under("--robust")
                .hint("name its numbers in \"parameters\""));
        }
        let motion = |sample: usize| {
            if is_long() {
                return None;
            }
            let change = movable.draw(sample as u64, by);
            let there = change.and_then(|(change, scene)| Ok((change, promised(source, &scene, promise, is_long)?)));
            // What was not completed for want of time says nothing.
            (there.is_ok() || !is_long()).then_some(there)
        };
        let samples = samples.unwrap_or(((AFFORDED / work) as usize).clamp(SAMPLES[0], SAMPLES[1]));
        let motions: Vec<Moved> = run_all(cores(), 0..samples, motion).into_iter().flatten().collect();
        match motions.iter().all(Result::is_err).then(|| motions.first()).flatten() {
            Some(Err(reason)) => {
                Err(Error::input(format!("the full model completes none of the motions nearby: {reason}"))
                    .under("--robust")
                    .hint("move the scene by less"))
            }
            _ => {
                let within = promise.within;
                let wanted = samples;
                Ok(Neighbourhood { source, within, by, movable, motions, wanted, is_stopped })
            }
        }
    }

    /// True if the time allowed for none of the motions.
    pub fn is_empty(&self) -> bool {
        self.motions.is_empty()
    }

    /// A warning where the time did not allow for all motions.
    pub fn doubt(&self) -> Option<Warning> {
        let text = match self.motions.len() {
            0 => "the time did not suffice for motions nearby: the promise is about the given motion alone".to_string(),
            count => format!("the time sufficed for {count} of {} motions nearby", self.wanted),
        };
        (self.motions.len() < self.wanted).then(|| Warning::new(text, "give more time by --budget"))
    }

    /// Tries a model on them, until it breaks the promise on too many.
    pub fn robustness(&self, scene: &Value) -> Robustness {
        let counted = self.motions.iter().filter(|motion| motion.is_ok()).count();
        let Movable { parameters, velocities, positions, inputs, .. } = &self.movable;
        let mut found = Robustness {
            by: self.by,
            parameters: parameters.clone(),
            velocities: *velocities,
            positions: *positions,
            inputs: inputs.clone(),
            motions: Vec::new(),
            counted,
            kept: 0,
        };
        for motions in self.motions.chunks(TOGETHER) {
            found.motions.extend(run_all(cores(), motions.iter(), |motion| self.motion(scene, motion)));
            found.counted = found.motions.len() - found.incomplete(Which::Richest);
            found.kept = found.errors().filter(|worst| worst.error <= self.within).count();
            if (found.counted - found.kept) as f64 > MAY_BREAK * counted as f64 {
                break;
            }
        }
        found
    }
}

impl Neighbourhood<'_> {
    fn motion(&self, scene: &Value, motion: &Moved) -> NearbyMotion {
        let failed = |which, reason: String| NearbyMotion { worst: None, failure: Some((which, reason)) };
        let (change, promise) = match motion {
            Ok(motion) => motion,
            Err(reason) => return failed(Which::Richest, reason.clone()),
        };
        let prepared = self.source.prepare(&self.movable.moved(scene, change));
        match prepared.and_then(|prepared| measured(&prepared, promise, ALLOWED, self.is_stopped)) {
            Err(error) => failed(Which::Simplified, format!("{error:#}")),
            Ok(ModelRun { failure: Some(failure), .. }) => failed(Which::Simplified, failure.reason),
            Ok(run) => NearbyMotion { worst: run.worst().cloned(), failure: None },
        }
    }
}

/// The promise about another motion of the full model.
fn promised(
    source: &Source,
    scene: &Value,
    promise: &Promise,
    is_stopped: &(dyn Fn() -> bool + Sync),
) -> std::result::Result<Promise, String> {
    let run = source.prepare(scene).and_then(|prepared| sampled(&prepared, &promise.names(), ALLOWED, is_stopped));
    match run.map_err(|error| format!("{error:#}"))? {
        RunSample { failure: Some(failure), .. } => Err(failure.reason),
        run => Ok(promise.about(run.rows, &run.sizes)),
    }
}
