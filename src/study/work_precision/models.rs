//! Cost of a model: models of one mechanism, from coarse to rich, on the same motion.

use crate::error::{Error, Failure, Result};
use crate::formulation::Statistics;
use crate::prepared::{Model, Overrides};
use crate::scene;
use crate::simulate::{Method, Span};
use crate::study::metric::ErrorMetric;
use crate::study::price::median;
use crate::study::run::Motion;
use crate::study::watched::Watched;
use crate::system::{Column, Dimensions};
use crate::tolerances;
use crate::trajectory::recorded;
use serde::Serialize;
use std::path::PathBuf;
use std::time::Duration;

/// A model with its name, such as `rod.json:modes=2`.
pub struct Variant {
    /// Name.
    pub name: String,
    /// The prepared scene.
    pub prepared: Model,
    /// File and options of the scene, from which a finer mesh can be made.
    pub source: Option<(PathBuf, Overrides)>,
}

impl Variant {
    /// Returns the model with twice the elements and modes of its beams; none without beams, or where it cannot be
    /// built.
    fn finer(&self) -> Option<Model> {
        let (path, overrides) = self.source.as_ref()?;
        let text = scene::refined(&scene::read_text(path).ok()?)?;
        let scene = overrides.elements.parse_in(scene::folder(Some(path)), &text, &overrides.set).ok()?;
        Model::new(scene, overrides).and_then(Model::settled).ok()
    }
}

/// Models compared with the richest of them.
#[derive(Clone, Debug, Serialize)]
pub struct ModelCosts {
    /// Outputs of the full model, in which the others are compared.
    #[serde(skip)]
    pub columns: Vec<Column>,
    /// Index of the model with the most velocities.
    pub richest: usize,
    /// Number of times at which they are compared.
    pub rows: usize,
    /// Result for each model.
    pub models: Vec<ModelCost>,
    /// Comparison of the richest with a finer mesh.
    pub finer: Finer,
}

/// Comparison of the full model with a finer one.
#[derive(Clone, Debug, Default, Serialize)]
pub struct Finer {
    /// Number of velocities with twice the elements and modes; none where the richest has no beams to refine.
    pub velocities: Option<usize>,
    /// Differences from the richest.
    pub outputs: Vec<OutputError>,
    /// Reason why the finer one did not complete.
    pub failure: Option<Failure>,
}

impl ModelCosts {
    /// Returns the estimated error of the full model and its output: the larger of the changes by twice the mesh and
    /// by a hundredth of the tolerance. None where it has a mesh and the finer one was not run.
    pub fn uncertainty(&self) -> Option<(f64, &str)> {
        let numerical = (self.models[self.richest].numerical_error?, "the worst output");
        let Finer { velocities, outputs, failure } = &self.finer;
        let mesh = outputs.iter().map(|output| (output.max, output.name.as_str()));
        let is_known = failure.is_none() && (velocities.is_none() || !outputs.is_empty());
        is_known.then(|| mesh.fold(numerical, |most, next| if next.0 > most.0 { next } else { most }))
    }
}

/// Cost and accuracy of a model.
#[derive(Clone, Debug, Default, Serialize)]
pub struct ModelCost {
    /// Name.
    pub name: String,
    /// n_q.
    pub coordinates: usize,
    /// n_v.
    pub velocities: usize,
    /// n_c.
    pub constraints: usize,
    /// Method of its runs.
    pub method: Method,
    /// CPU time of each repetition, s.
    pub cpu_seconds: Vec<f64>,
    /// Counted work.
    #[serde(flatten)]
    pub statistics: Statistics,
    /// Largest relative change of the model's own outputs with a hundredth of the tolerance.
    pub numerical_error: Option<f64>,
    /// Difference of each output that the model has from that of the full model.
    pub outputs: Vec<OutputError>,
    /// Reason why it did not complete.
    pub failure: Option<Failure>,
}

/// Difference of an output relative to its size in the motion of the full model: see `ErrorMetric`.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct OutputError {
    /// Name of the output.
    pub name: String,
    /// Largest relative difference.
    pub max: f64,
    /// Root mean square of the relative difference.
    pub rms: f64,
}

impl ModelCost {
    /// Returns the median CPU time, s.
    pub fn seconds(&self) -> Option<f64> {
        median(&self.cpu_seconds)
    }

    /// Returns the largest difference of all its outputs; none where it has none or failed.
    pub fn error(&self) -> Option<f64> {
        self.outputs.iter().map(|output| output.max).reduce(f64::max)
    }
}

/// Number of times at which models are compared.
const ROWS: usize = 200;

/// Runs all models over the span of the first, each with its own method, `repeats` times in turn; `watch` is called
/// with the next one and the number of runs done. `outputs` names the outputs to compare, all of the full model
/// where it is empty.
///
/// # Errors
/// Fewer than two models; unknown outputs; a model that starts at another time or state than the first.
pub fn compare(
    variants: &[Variant],
    outputs: &[String],
    repeats: usize,
    allowed: Duration,
    mut watch: impl FnMut(&str, usize),
) -> Result<ModelCosts> {
    let velocities = |variant: &Variant| variant.prepared.system().dimensions().v;
    let richest = (0..variants.len()).max_by_key(|i| (velocities(&variants[*i]), variants.len() - i));
    let (Some(richest), [first, _, ..]) = (richest, variants) else {
        return Err(Error::input("there is only one model").under("--variants").hint("name others to compare it with"));
    };
    let columns = Watched::new(variants[richest].prepared.system(), outputs)?.columns;
    let span = first.prepared.span()?;
    let span = Span { output_step: (span.end - span.start) / ROWS as f64, ..span };
    let mut runs: Vec<Measurement> =
        variants.iter().map(|variant| Measurement::new(variant, &columns, span)).collect::<Result<_>>()?;
    for round in 0..=repeats {
        for (i, run) in runs.iter_mut().enumerate() {
            watch(&run.cost.name, round * variants.len() + i);
            run.repeat(round, allowed)?;
        }
    }
    let rich = runs[richest].tight.clone().ok_or_else(|| runs[richest].failure(span.start))?;
    watch("the full model with a finer mesh", (repeats + 1) * variants.len());
    let finer = finer(&variants[richest], &columns, span, allowed, &rich)?;
    let models = runs.into_iter().map(|run| run.finish(&rich)).collect();
    Ok(ModelCosts { richest, rows: ROWS, models, columns, finer })
}

/// Compares the full model with itself on twice the mesh.
fn finer(richest: &Variant, columns: &[Column], span: Span, allowed: Duration, rich: &ErrorMetric) -> Result<Finer> {
    let Some(prepared) = richest.finer() else { return Ok(Finer::default()) };
    let velocities = Some(prepared.system().dimensions().v);
    let variant = Variant { name: String::new(), prepared, source: None };
    let mut run = Measurement::new(&variant, columns, span)?;
    run.repeat(0, allowed)?;
    let ModelCost { outputs, failure, .. } = run.finish(rich);
    Ok(Finer { velocities, outputs, failure })
}

/// The runs of one model so far.
struct Measurement<'a> {
    motion: Motion<'a>,
    cost: ModelCost,
    /// The run at a tighter tolerance.
    tight: Option<ErrorMetric>,
}

impl<'a> Measurement<'a> {
    fn new(variant: &'a Variant, columns: &[Column], span: Span) -> Result<Self> {
        let Variant { name, prepared, .. } = variant;
        let system = prepared.system();
        let own = recorded(system);
        let shared = columns.iter().filter(|column| own.iter().any(|own| own.name == column.name));
        let shared: Vec<String> = shared.map(|column| column.name.clone()).collect();
        if shared.is_empty() {
            return Err(Error::input(format!("`{name}` has none of the outputs to compare"))
                .under("--variants")
                .hint("give the models outputs of the same names"));
        }
        let Dimensions { q, v, lambda, .. } = system.dimensions();
        let cost = ModelCost {
            name: name.clone(),
            coordinates: q,
            velocities: v,
            constraints: lambda,
            method: prepared.method.clone(),
            ..ModelCost::default()
        };
        let motion = Motion::of(prepared, span, Watched::new(system, &shared)?, &|| false);
        Ok(Measurement { motion, cost, tight: None })
    }

    /// Runs once with a tighter tolerance, then for the time.
    fn repeat(&mut self, round: usize, allowed: Duration) -> Result<()> {
        let Measurement { motion, cost, tight } = self;
        if cost.failure.is_some() {
            return Ok(());
        }
        let method = if round == 0 { tighter(&cost.method) } else { cost.method.clone() };
        let run = motion.run(&method, allowed)?;
        if round > 0 {
            cost.cpu_seconds.push(run.seconds);
            cost.statistics = run.statistics;
            cost.numerical_error = tight.as_ref().map(|own| own.error(&run.rows).0);
        } else if run.failure.is_none() {
            *tight = Some(ErrorMetric::of(&motion.watched, &run));
        }
        cost.failure = run.failure;
        Ok(())
    }

    fn failure(&self, t: f64) -> Error {
        let none = || Failure {
            t,
            reason: "the full model was not run".to_string(),
            hint: "choose another method or tolerance".to_string(),
        };
        let failure = self.cost.failure.clone().unwrap_or_else(none);
        Failure { reason: format!("the full model, `{}`: {}", self.cost.name, failure.reason), ..failure }.into()
    }

    /// Returns the result, with the differences from the full model.
    fn finish(self, rich: &ErrorMetric) -> ModelCost {
        let Measurement { cost, tight, .. } = self;
        let Some(tight) = tight.filter(|_| cost.failure.is_none()) else {
            return ModelCost { statistics: Statistics::default(), numerical_error: None, ..cost };
        };
        let output = |(place, name): (usize, &String)| {
            let values: Vec<f64> = tight.rows.iter().map(|row| row[place]).collect();
            let (max, rms) = rich.spread(name, &values)?;
            Some(OutputError { name: name.clone(), max, rms })
        };
        ModelCost { outputs: tight.names.iter().enumerate().filter_map(output).collect(), ..cost }
    }
}

/// The method at the tolerance against which models are compared: a hundredth, or a tenth of the step.
pub fn tighter(method: &Method) -> Method {
    if let Some(step) = method.step {
        return Method { step: Some(0.1 * step), ..method.clone() };
    }
    // Below this, only round-off remains.
    // Two digits more.
    let rtol = (1e-2 * method.rtol).max(tolerances::TIGHTEST).min(method.rtol);
    Method { rtol, atol: method.atol * rtol / method.rtol, ..method.clone() }
}
