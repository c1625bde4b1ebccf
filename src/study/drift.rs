//! Drift of one scene under every stabilization that its integrator can be combined with.

use super::pool::{cores, run_all};
use crate::analysis::{Drift, EnergyBalance, Record, Recorder, Singularity};
use crate::clock::Stopwatch;
use crate::error::{Error, Failure, Result, significant};
use crate::method_spec::MethodSpec;
use crate::prepared::PreparedScene;
use crate::simulate::{Method, Outcome, Stop, simulate};
use crate::system::Names;
use crate::trajectory::Trajectory;
use serde::Serialize;

/// A run under one stabilization.
#[derive(Serialize)]
pub struct StabilizedRun {
    /// Name in tables: the formulation, or the projection after index 1.
    pub method: String,
    /// Formulation with its gains.
    pub formulation: MethodSpec,
    /// Projection after each step.
    pub projection: MethodSpec,
    /// `completed` or `failed`.
    pub status: &'static str,
    /// Reason of a failed run.
    pub failure: Option<Failure>,
    /// Constraint drift.
    pub drift: Drift,
    /// Energy balance; none where the system defines no potential.
    pub energy: Option<EnergyBalance>,
    /// Singular states on the way.
    pub singularity: Singularity,
    /// Accepted steps.
    pub steps: u64,
    /// Evaluations of the right-hand side.
    pub rhs_evaluations: u64,
    /// Factorizations of matrices.
    pub factorizations: u64,
    /// Wall-clock time, s.
    pub wall_seconds: f64,
    /// Record of the run; of its trajectory the times only.
    #[serde(skip)]
    pub record: Record,
}

/// Runs the scene under every stabilization. Gains follow from the mean step of the run without one, which comes first;
/// `stop` is asked whether a run should end, `done` is called after each run.
///
/// # Errors
/// Only one stabilization; bad input of any kind: see [`simulate`].
pub fn drift_under_stabilizations(
    prepared: &PreparedScene,
    stop: impl Fn() -> Option<Stop> + Sync,
    done: impl Fn() + Sync,
) -> Result<Vec<StabilizedRun>> {
    let run = |(formulation, projection): (MethodSpec, MethodSpec)| {
        let run = one(prepared, formulation, projection, &stop);
        done();
        run
    };
    let plain = run(stabilizations(prepared, 1.0)?.swap_remove(0))?;
    let span = prepared.span()?;
    let step = prepared.method.step.unwrap_or((span.end - span.start) / plain.steps.max(1) as f64);
    let others = run_all(cores(), stabilizations(prepared, step)?.into_iter().skip(1), run);
    [Ok(plain)].into_iter().chain(others).collect()
}

/// Returns the pairs of formulation and projection that the integrator of the scene can be combined with, the least
/// stabilization first, with gains for steps of size `step`, s.
///
/// # Errors
/// There is only one pair.
pub fn stabilizations(prepared: &PreparedScene, step: f64) -> Result<Vec<(MethodSpec, MethodSpec)>> {
    let accepted =
        |(formulation, projection): &(MethodSpec, MethodSpec)| of(prepared, formulation, projection).check().is_ok();
    let all: Vec<_> = all(step).into_iter().filter(accepted).collect();
    if all.len() > 1 {
        return Ok(all);
    }
    let Method { integrator, formulation, .. } = &prepared.method;
    let because = prepared.chosen_because.as_ref().map_or(String::new(), |because| format!("; auto: {because}"));
    let message = format!("{integrator} goes with {formulation} alone: there is nothing to compare{because}");
    let path = if prepared.chosen_because.is_some() { "--method" } else { "simulation.integrator" };
    Err(Error::input(message).under(path).hint("name another, as in --integrator dop853 or --integrator radau_iia"))
}

fn of(prepared: &PreparedScene, formulation: &MethodSpec, projection: &MethodSpec) -> Method {
    Method { formulation: formulation.clone(), projection: projection.clone(), ..prepared.method.clone() }
}

/// Returns every stabilization, the least first, with gains for steps of size `step`: alpha = beta = 1/step is the pair
/// (2/h, 1/h^2).
fn all(step: f64) -> Vec<(MethodSpec, MethodSpec)> {
    let gain = significant(1.0 / step, 3);
    let gained =
        |name: &str, keys: &[&str]| keys.iter().fold(MethodSpec::named(name), |spec, key| spec.with(key, &gain));
    let sweeps = MethodSpec::named("manifold").with("sweeps", "2");
    let index1 = || MethodSpec::named("index1");
    let none = || MethodSpec::named("none");
    let other = |formulation: &str, projection: &str| (MethodSpec::named(formulation), MethodSpec::named(projection));
    vec![
        (index1(), none()),
        (MethodSpec::named("baumgarte"), none()),
        (gained("baumgarte", &["alpha", "beta"]), none()),
        (gained("invariant_manifold", &["gamma"]), none()),
        (index1(), MethodSpec::named("position")),
        (index1(), MethodSpec::named("velocity")),
        (index1(), MethodSpec::named("manifold")),
        (index1(), sweeps),
        (index1(), MethodSpec::named("full")),
        (index1(), MethodSpec::named("exact")),
        other("index2", "none"),
        other("index2", "position"),
        other("index3", "none"),
        other("index3", "velocity"),
        other("ggl", "none"),
        other("stabilized_index1", "none"),
    ]
}

fn one(
    prepared: &PreparedScene,
    formulation: MethodSpec,
    projection: MethodSpec,
    stop: impl Fn() -> Option<Stop>,
) -> Result<StabilizedRun> {
    let method = of(prepared, &formulation, &projection);
    let mut recorder = Recorder::new(prepared.system()).with_stop(stop);
    let watch = Stopwatch::start();
    let Outcome { statistics, failure, .. } =
        simulate(prepared.system(), &method, prepared.span()?, prepared.start(), &mut recorder)?;
    let wall_seconds = watch.wall().as_secs_f64();
    let mut record = recorder.finish();
    // Only the times of the motion are shown, and there are many records.
    let rows = record.trajectory.times().map(|t| vec![t]).collect();
    record.trajectory = Trajectory { names: Names::default(), outputs: Vec::new(), rows };
    Ok(StabilizedRun {
        method: match (formulation.name.as_str(), projection.name.as_str()) {
            ("index1", "none") => formulation.to_string(),
            ("index1", _) => projection.to_string(),
            (_, "none") => formulation.to_string(),
            _ => format!("{formulation} + {projection}"),
        },
        formulation,
        projection,
        status: if failure.is_some() { "failed" } else { "completed" },
        failure,
        drift: record.drift.clone(),
        energy: record.energy,
        singularity: record.singularity.clone(),
        steps: statistics.steps,
        rhs_evaluations: statistics.rhs_evaluations,
        factorizations: statistics.factorizations,
        wall_seconds,
        record,
    })
}
