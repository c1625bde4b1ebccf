//! The promise on motions near the one that it was made for.

use super::bench::{measured, sampled};
use super::edit::{elements, mentions};
use super::promise::{Norm, Promise};
use super::source::Source;
use crate::compare::work_precision::Watched;
use crate::error::{Error, Result};
use crate::prepared::PreparedScene;
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
    /// Number of motions.
    pub samples: usize,
}

/// A promise about outputs of these names.
#[derive(Clone, Copy, Debug)]
pub struct Terms<'a> {
    /// Names of the outputs.
    pub outputs: &'a [String],
    /// Allowed difference.
    pub within: f64,
    /// Norm of the difference.
    pub norm: Norm,
}

/// The promise on motions nearby.
#[derive(Clone, Debug, Serialize)]
pub struct Robustness {
    /// What was asked for.
    #[serde(flatten)]
    pub nearby: Nearby,
    /// Parameters that were moved.
    pub parameters: Vec<String>,
    /// True if the velocities at the start were moved, too.
    pub velocities: bool,
    /// The motions.
    pub motions: Vec<NearbyMotion>,
    /// Number of motions that the richest model completes.
    pub counted: usize,
    /// Number of these on which the promise is kept.
    pub kept: usize,
}

/// A motion nearby.
#[derive(Clone, Debug, Serialize)]
pub struct NearbyMotion {
    /// Largest difference of a watched output; none where a model does not complete.
    pub error: Option<f64>,
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

/// Runs both models on motions nearby.
///
/// # Errors
/// Nothing can be moved.
pub fn robustness(
    source: &Source,
    simplified: &Value,
    terms: Terms,
    nearby: Nearby,
    is_stopped: &(dyn Fn() -> bool + Sync),
) -> Result<Robustness> {
    let scenes = [&source.scene, simplified];
    let parameters = movable(source, scenes, nearby.by);
    let velocities = source.prepare(scenes[0])?.start().1.iter().any(|v| *v != 0.0);
    if parameters.is_empty() && !velocities {
        return Err(Error::input("the scene has no parameter and no velocity at the start that could be moved")
            .under("--robust")
            .hint("name its numbers in \"parameters\""));
    }
    let one = |sample: usize| {
        let mut random = Random(1 + sample as u64);
        let moves: Vec<f64> = (0..=parameters.len()).map(|_| nearby.by * random.next()).collect();
        motion(source, scenes.map(|scene| moved(scene, &parameters, &moves)), terms, is_stopped)
    };
    let motions: Vec<NearbyMotion> = (0..nearby.samples).into_par_iter().map(one).collect();
    let is_counted = |motion: &&NearbyMotion| !matches!(motion.failure, Some((Which::Richest, _)));
    let counted = motions.iter().filter(is_counted).count();
    let kept = motions.iter().filter(|motion| motion.error.is_some_and(|error| error <= terms.within)).count();
    Ok(Robustness { nearby, parameters, velocities, motions, counted, kept })
}

/// Parameters that both models can be built with at both ends of their range; numbers of elements and modes stay.
fn movable(source: &Source, scenes: [&Value; 2], by: f64) -> Vec<String> {
    let numbers = source.scene["parameters"].as_object().into_iter().flatten();
    let numbers = numbers.filter(|(_, value)| value.as_f64().is_some_and(|value| value != 0.0)).map(|(name, _)| name);
    let counts = |name: &str| {
        let bodies = elements(&source.scene, "bodies").iter();
        bodies.flat_map(|body| [&body["elements"], &body["modes"]]).any(|count| mentions(count, name))
    };
    let is_possible = |name: &&String| {
        let builds = |scene: &Value, u: f64| source.prepare(&moved(scene, &[name.to_string()], &[u, 0.0])).is_ok();
        !counts(name) && scenes.iter().all(|scene| builds(scene, by) && builds(scene, -by))
    };
    numbers.filter(is_possible).cloned().collect()
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

fn motion(
    source: &Source,
    [richest, simplified]: [Value; 2],
    terms: Terms,
    is_stopped: &(dyn Fn() -> bool + Sync),
) -> NearbyMotion {
    let failed = |which| move |reason: String| NearbyMotion { error: None, failure: Some((which, reason)) };
    let promise = match promise(source, &richest, terms, is_stopped) {
        Ok(promise) => promise,
        Err(reason) => return failed(Which::Richest)(reason),
    };
    let run = source.prepare(&simplified).and_then(|prepared| measured(&prepared, &promise, ALLOWED, is_stopped));
    match run {
        Err(error) => failed(Which::Simplified)(error.to_string()),
        Ok(run) => match run.failure {
            Some(failure) => failed(Which::Simplified)(failure.reason),
            None => NearbyMotion { error: Some(run.error()), failure: None },
        },
    }
}

/// The promise about a motion of the richest model.
fn promise(
    source: &Source,
    scene: &Value,
    terms: Terms,
    is_stopped: &(dyn Fn() -> bool + Sync),
) -> std::result::Result<Promise, String> {
    let run = |prepared: &PreparedScene| {
        let columns = Watched::new(prepared.system(), terms.outputs)?.columns;
        Ok((columns, sampled(prepared, terms.outputs, ALLOWED, is_stopped)?))
    };
    let (columns, run) =
        source.prepare(scene).and_then(|prepared| run(&prepared)).map_err(|error| error.to_string())?;
    match run.failure {
        Some(failure) => Err(failure.reason),
        None => Ok(Promise::new((terms.within, terms.norm), &columns, run.rows, &run.sizes)),
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
