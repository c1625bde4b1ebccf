//! The subject of a map: a scene, or own equations.

use super::period::period;
use crate::analysis::Recorder;
use crate::clock::Stopwatch;
use crate::error::{Result, Warning};
use crate::formulation::ExponentialMap;
use crate::math::expression::{Number, Parameters};
use crate::math::random::Random;
use crate::prepared::{Model, Overrides};
use crate::scene::{self, Elements};
use crate::simulate::{Method, Span, Stop, simulate};
use crate::study::run::Motion;
use crate::study::watched::Watched;
use crate::system::{Dimensions, MechanicalSystem};
use serde_json::Value;
use std::path::{Path, PathBuf};
use std::sync::Arc;
use std::time::Duration;

/// The scene of a cell as JSON, with its method.
#[derive(Clone, Debug)]
pub struct Case {
    /// The scene, shared with other cases until it is changed; null for own equations.
    pub scene: Arc<Value>,
    /// Parameters with new values.
    pub set: Vec<(String, f64)>,
    /// Method of the simulation.
    pub method: Method,
    /// Simulated time, s.
    pub duration: f64,
    /// Typical sizes of the motion, which do not follow changes.
    pub typical: Typical,
    /// Errors of the start along a fixed pseudo-random direction: of the positions, relative to the scene's size, and
    /// of the velocities, relative to that size over the period.
    pub start_error: [f64; 2],
}

/// Typical times by which default values are chosen.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Typical {
    /// Mean step of the scene's own method, s.
    pub step: f64,
    /// Mean time from one upward crossing of its mean to the next, of the first output or coordinate that has two; the
    /// duration where none has, s.
    pub period: f64,
}

/// A scene or own equations, with typical times.
pub struct Subject<'a> {
    /// Name of the scene or of the equations.
    pub name: String,
    /// Warnings about the scene's start.
    pub doubts: Vec<Warning>,
    /// Values of the scene's parameters.
    pub values: Parameters,
    /// The case without changes.
    #[doc(hidden)]
    pub base: Case,
    /// Numbers of coordinates, velocities and constraints.
    pub dimensions: Dimensions,
    /// Returns true to end all runs; cells without a result are then left out.
    pub is_stopped: &'a (dyn Fn() -> bool + Sync),
    folder: PathBuf,
    elements: Elements,
    own: Option<Own<'a>>,
}

struct Own<'a> {
    system: &'a dyn MechanicalSystem,
    start: f64,
    q: Vec<f64>,
    v: Vec<f64>,
}

/// Output rows of a cell, and of the run from which typical times are taken.
const ROWS: f64 = 100.0;
const TYPICAL_ROWS: f64 = 2000.0;
/// Largest number of values in its rows.
const TYPICAL_NUMBERS: f64 = 1e7;
/// Time limit of the run from which typical times are taken.
const PATIENCE: Duration = Duration::from_secs(3);

impl Subject<'static> {
    /// Reads a scene.
    ///
    /// # Errors
    /// As [`Model::load_with`]; a scene without an end time.
    pub fn load(path: &Path, overrides: &Overrides) -> Result<Self> {
        let prepared = Model::load_with(path, overrides)?.settled()?;
        let span = prepared.span().map_err(|error| error.in_file(path))?;
        let base = Case {
            scene: Arc::new(scene::document::read(&scene::read_text(path)?)?),
            set: overrides
                .set
                .iter()
                .filter_map(|(name, _)| Some((name.clone(), prepared.parameters.get(name)?)))
                .collect(),
            method: prepared.method.clone(),
            duration: span.end - span.start,
            typical: Typical::of(prepared.system(), &prepared.method, span, prepared.start())?,
            start_error: [0.0; 2],
        };
        Ok(Subject {
            doubts: prepared.doubts.clone(),
            name: prepared.name.clone(),
            values: prepared.parameters.clone(),
            base,
            dimensions: prepared.system().dimensions(),
            is_stopped: &|| false,
            folder: scene::folder(Some(path)).to_path_buf(),
            elements: overrides.elements.clone(),
            own: None,
        })
    }
}

impl<'a> Subject<'a> {
    /// A subject of own equations from a consistent start (q, v). Stress parameters of scenes do not apply.
    ///
    /// # Errors
    /// As `simulate`.
    pub fn of_equations(
        name: &str,
        system: &'a dyn MechanicalSystem,
        method: Method,
        span: Span,
        start: (&[f64], &[f64]),
    ) -> Result<Self> {
        let (q, v) = start;
        Ok(Subject {
            doubts: Vec::new(),
            name: name.to_string(),
            values: Parameters::default(),
            dimensions: system.dimensions(),
            is_stopped: &|| false,
            base: Case {
                scene: Arc::new(Value::Null),
                set: Vec::new(),
                duration: span.end - span.start,
                typical: Typical::of(system, &method, span, start)?,
                method,
                start_error: [0.0; 2],
            },
            folder: PathBuf::new(),
            elements: Elements::default(),
            own: Some(Own { system, start: span.start, q: q.to_vec(), v: v.to_vec() }),
        })
    }

    /// Returns the names of the scene's parameters.
    pub fn parameters(&self) -> impl Iterator<Item = &str> {
        let parameters = self.base.scene.get("parameters").and_then(Value::as_object);
        parameters.into_iter().flat_map(|map| map.keys().map(String::as_str))
    }

    /// Prepares a case and passes its motion to `run`.
    ///
    /// # Errors
    /// The changed scene is not valid.
    #[doc(hidden)]
    pub fn with<T>(&self, case: &Case, run: impl FnOnce(&Motion) -> Result<T>) -> Result<T> {
        let span = |start: f64| Span { start, end: start + case.duration, output_step: case.duration / ROWS };
        let perturbed = |system: &dyn MechanicalSystem, start: f64, state: (&[f64], &[f64])| {
            let (q, v) = perturbed(system, state, case.start_error, case.typical.period);
            let watched = Watched::new(system, &[])?;
            run(&Motion {
                system,
                start: (&q, &v),
                span: span(start),
                watched,
                ratio: 1.0,
                counts_start: true,
                is_stopped: self.is_stopped,
            })
        };
        if let Some(own) = &self.own {
            return perturbed(own.system, own.start, (&own.q, &own.v));
        }
        let set: Vec<(String, Number)> = case.set.iter().map(|(name, value)| (name.clone(), (*value).into())).collect();
        let scene = self.elements.resolve(&self.folder, Value::clone(&case.scene), &set)?;
        let span = span(scene.start_time()?);
        let method = &case.method;
        let overrides = Overrides {
            formulation: Some(method.formulation.clone()),
            integrator: Some(method.integrator.clone()),
            projection: Some(method.projection.clone()),
            step: method.step,
            until: Some(span.end),
            output_step: Some(span.output_step),
            ..Overrides::default()
        };
        let prepared = Model::new(scene, &overrides)?;
        perturbed(prepared.system(), span.start, prepared.start())
    }
}

/// Returns the start perturbed along a fixed pseudo-random direction, each component by the error times a number
/// between -1 and 1.
fn perturbed(
    system: &dyn MechanicalSystem,
    start: (&[f64], &[f64]),
    start_error: [f64; 2],
    period: f64,
) -> (Vec<f64>, Vec<f64>) {
    let [position, velocity] = start_error;
    let mut q = start.0.to_vec();
    let mut v = start.1.to_vec();
    if position == 0.0 && velocity == 0.0 {
        return (q, v);
    }
    let size = system.facts().scales.iter().copied().fold(0.0, f64::max).max(f64::MIN_POSITIVE);
    let mut random = Random(1);
    let dq: Vec<f64> = v.iter().map(|_| position * size * random.uniform()).collect();
    let from = q.clone();
    ExponentialMap::new(system).apply(system, &from, &dq, &mut q);
    v.iter_mut().for_each(|v| *v += velocity * size / period * random.uniform());
    (q, v)
}

impl Typical {
    fn of(system: &dyn MechanicalSystem, method: &Method, span: Span, start: (&[f64], &[f64])) -> Result<Self> {
        let watch = Stopwatch::start();
        let stop = || (watch.wall() > PATIENCE).then(|| Stop::deadline(PATIENCE));
        let mut recorder = Recorder::new(system).with_stop(stop);
        let duration = span.end - span.start;
        let Dimensions { q, v, lambda, .. } = system.dimensions();
        let rows = (TYPICAL_NUMBERS / (1 + q + v + lambda) as f64).clamp(2.0, TYPICAL_ROWS);
        let span = Span { output_step: duration / rows, ..span };
        let outcome = simulate(system, method, span, start, &mut recorder)?;
        let trajectory = recorder.finish().trajectory;
        let steps = outcome.statistics.steps.max(1) as f64;
        let step = if outcome.t > span.start { (outcome.t - span.start) / steps } else { duration / TYPICAL_ROWS };
        let columns = trajectory.rows.first().map_or(0, Vec::len);
        let n = trajectory.names.q.len();
        let outputs = trajectory.outputs.len();
        let mut candidates = (columns - outputs..columns).chain(1..=n.min(columns));
        let times: Vec<f64> = trajectory.times().collect();
        let period = candidates.find_map(|i| {
            let values: Vec<f64> = trajectory.rows.iter().map(|row| row[i]).collect();
            period(&times, &values)
        });
        Ok(Typical { step, period: period.unwrap_or(duration) })
    }
}
