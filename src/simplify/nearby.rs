//! The promise on motions near the one that it was made for.

use super::edit::{elements, mentions};
use super::promise::Promise;
use super::run::{Difference, Run, measured, sampled};
use super::source::Source;
use crate::compare::work_precision::RunSample;
use crate::error::{Error, Result, Warning};
use rayon::prelude::*;
use serde::Serialize;
use serde_json::{Value, json};
use std::time::Duration;

/// Motions near the given one: each parameter that is a number, and all velocities at the start together, times 1 + u,
/// with u evenly distributed between -by and by, the same ones in every run.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub struct Nearby {
    /// Largest relative change.
    pub by: f64,
    /// Number of motions; from 20, where the richest model takes much work, to 60 where none is given.
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
    /// The motions that were tried.
    pub motions: Vec<NearbyMotion>,
    /// Number of motions that the richest model completes.
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
/// Work of the richest model on all motions together up to which there are more than the least number of them.
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

/// The richest model on motions nearby.
pub struct Neighbourhood<'a> {
    source: &'a Source,
    within: f64,
    by: f64,
    parameters: Vec<String>,
    velocities: bool,
    /// Relative change of each parameter, and of the velocities, with the promise about that motion or the reason why
    /// the richest model does not complete it.
    motions: Vec<(Vec<f64>, std::result::Result<Promise, String>)>,
    /// Number of motions that there were to be.
    wanted: usize,
    is_stopped: &'a (dyn Fn() -> bool + Sync),
}

impl<'a> Neighbourhood<'a> {
    /// Runs the richest model, a run of which takes `work`, on the motions near that of `promise`, until `is_long`;
    /// models are tried on them until `is_stopped`.
    ///
    /// # Errors
    /// Nothing can be moved; the richest model completes none of the motions, though there is time.
    pub fn new(
        source: &'a Source,
        promise: &Promise,
        Nearby { by, samples }: Nearby,
        work: f64,
        [is_long, is_stopped]: [&'a (dyn Fn() -> bool + Sync); 2],
    ) -> Result<Neighbourhood<'a>> {
        let parameters = movable(source, by);
        let velocities = source.prepare(&source.scene)?.start().1.iter().any(|v| *v != 0.0);
        if parameters.is_empty() && !velocities {
            return Err(Error::input("the scene has no parameter and no velocity at the start that could be moved")
                .under("--robust")
                .hint("name its numbers in \"parameters\""));
        }
        let motion = |sample: usize| {
            let mut random = Random(1 + sample as u64);
            let moves: Vec<f64> = (0..=parameters.len()).map(|_| by * random.next()).collect();
            let there = promised(source, &moved(&source.scene, &parameters, &moves), promise, is_long);
            // What was not completed for want of time says nothing.
            (there.is_ok() || !is_long()).then_some((moves, there))
        };
        let samples = samples.unwrap_or(((AFFORDED / work) as usize).clamp(SAMPLES[0], SAMPLES[1]));
        let motions: Vec<_> = (0..samples).into_par_iter().filter_map(motion).collect();
        match motions.iter().all(|(_, there)| there.is_err()).then(|| motions.first()).flatten() {
            Some((_, Err(reason))) => {
                Err(Error::input(format!("the richest model completes none of the motions nearby: {reason}"))
                    .under("--robust")
                    .hint("move the scene by less"))
            }
            _ => {
                let (within, wanted) = (promise.within, samples);
                Ok(Neighbourhood { source, within, by, parameters, velocities, motions, wanted, is_stopped })
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
        let counted = self.motions.iter().filter(|(_, there)| there.is_ok()).count();
        let Neighbourhood { by, velocities, .. } = *self;
        let mut found =
            Robustness { by, parameters: self.parameters.clone(), velocities, motions: Vec::new(), counted, kept: 0 };
        for motions in self.motions.chunks(TOGETHER) {
            found.motions.par_extend(motions.par_iter().map(|motion| self.motion(scene, motion)));
            found.counted = found.motions.len() - found.incomplete(Which::Richest);
            found.kept = found.errors().filter(|worst| worst.error <= self.within).count();
            if (found.counted - found.kept) as f64 > MAY_BREAK * counted as f64 {
                break;
            }
        }
        found
    }
}

/// Parameters that the richest model can be built with at both ends of their range; numbers of elements and modes stay.
fn movable(source: &Source, by: f64) -> Vec<String> {
    let scene = &source.scene;
    let numbers = scene["parameters"].as_object().into_iter().flatten();
    let numbers = numbers.filter(|(_, value)| value.as_f64().is_some_and(|value| value != 0.0)).map(|(name, _)| name);
    let counts = |name: &str| {
        let bodies = elements(scene, "bodies").iter();
        bodies.flat_map(|body| [&body["elements"], &body["modes"]]).any(|count| mentions(count, name))
    };
    let builds = |name: &str, u: f64| source.prepare(&moved(scene, &[name.to_string()], &[u, 0.0])).is_ok();
    let is_possible = |name: &&String| !counts(name) && builds(name, by) && builds(name, -by);
    numbers.collect::<Vec<_>>().into_par_iter().filter(is_possible).cloned().collect()
}

const VELOCITIES: [&str; 3] = ["velocity", "angular_velocity", "elastic_velocity"];

/// The scene with these parameters times 1 + u, and the velocities by the last u.
fn moved(scene: &Value, parameters: &[String], u: &[f64]) -> Value {
    let mut scene = scene.clone();
    for (name, u) in parameters.iter().zip(u) {
        let value = scene["parameters"][name].as_f64().unwrap_or(0.0);
        scene["parameters"][name] = json!(value * (1.0 + u));
    }
    let factor = 1.0 + u.last().copied().unwrap_or(0.0);
    let bodies = scene.get_mut("bodies").and_then(Value::as_array_mut).into_iter().flatten();
    for initial in bodies.filter_map(|body| body.get_mut("initial")) {
        VELOCITIES.iter().filter_map(|key| initial.get_mut(key).map(|value| scale(value, factor))).for_each(drop);
    }
    let of_joints = scene.get_mut("initial").and_then(Value::as_object_mut).into_iter().flatten();
    of_joints.filter(|(name, _)| name.ends_with('\'')).for_each(|(_, value)| scale(value, factor));
    scene
}

/// Multiplies all numbers of a value.
fn scale(value: &mut Value, factor: f64) {
    match value {
        Value::Number(number) => *value = json!(factor * number.as_f64().unwrap_or(0.0)),
        Value::String(text) => *text = format!("{factor}*({text})"),
        Value::Array(all) => all.iter_mut().for_each(|value| scale(value, factor)),
        Value::Object(keys) => keys.values_mut().for_each(|value| scale(value, factor)),
        _ => {}
    }
}

impl Neighbourhood<'_> {
    fn motion(
        &self,
        scene: &Value,
        (moves, promise): &(Vec<f64>, std::result::Result<Promise, String>),
    ) -> NearbyMotion {
        let failed = |which, reason: String| NearbyMotion { worst: None, failure: Some((which, reason)) };
        let promise = match promise {
            Ok(promise) => promise,
            Err(reason) => return failed(Which::Richest, reason.clone()),
        };
        let prepared = self.source.prepare(&moved(scene, &self.parameters, moves));
        match prepared.and_then(|prepared| measured(&prepared, promise, ALLOWED, self.is_stopped)) {
            Err(error) => failed(Which::Simplified, error.to_string()),
            Ok(Run { failure: Some(failure), .. }) => failed(Which::Simplified, failure.reason),
            Ok(run) => NearbyMotion { worst: run.worst().cloned(), failure: None },
        }
    }
}

/// The promise about another motion of the richest model.
fn promised(
    source: &Source,
    scene: &Value,
    promise: &Promise,
    is_stopped: &(dyn Fn() -> bool + Sync),
) -> std::result::Result<Promise, String> {
    let run = source.prepare(scene).and_then(|prepared| sampled(&prepared, &promise.names(), ALLOWED, is_stopped));
    match run.map_err(|error| error.to_string())? {
        RunSample { failure: Some(failure), .. } => Err(failure.reason),
        run => Ok(promise.about(run.rows, &run.sizes)),
    }
}

/// Numbers evenly distributed between -1 and 1 (splitmix64, Steele, Lea, Flood 2014).
struct Random(u64);

impl Random {
    fn next(&mut self) -> f64 {
        self.0 = self.0.wrapping_add(0x9E37_79B9_7F4A_7C15);
        let mut z = self.0;
        z = (z ^ (z >> 30)).wrapping_mul(0xBF58_476D_1CE4_E5B9);
        z = (z ^ (z >> 27)).wrapping_mul(0x94D0_49BB_1331_11EB);
        z ^= z >> 31;
        (z >> 11) as f64 / (1u64 << 52) as f64 - 1.0
    }
}
