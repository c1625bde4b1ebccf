//! Drift of one scene under every stabilization that its integrator can be combined with.

use super::pool::{cores, run_all};
use crate::analysis::{Drift, EnergyBalance, Record, Recorder, Singularity};
use crate::clock::Stopwatch;
use crate::error::{Error, Failure, Result, significant};
use crate::method_spec::MethodSpec;
use crate::prepared::Model;
use crate::simulate::{Method, Outcome, Stop, simulate};
use crate::system::Names;
use crate::trajectory::Trajectory;
use serde::Serialize;

/// Largest number of rows of [`StabilizedRun::motion`].
const MOST_ROWS: usize = 300;

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
    /// Rows of the motion, at most 300.
    #[serde(skip)]
    pub motion: Trajectory,
}

/// Runs the scene under every stabilization. Gains follow from the mean step of the run without one, which comes first;
/// `stop` is asked whether a run should end, `done` is called after each run.
///
/// # Errors
/// Only one stabilization; bad input of any kind: see `simulate`.
pub fn drift_under_stabilizations(
    prepared: &Model,
    stop: impl Fn() -> Option<Stop> + Sync,
    done: impl Fn() + Sync,
) -> Result<Vec<StabilizedRun>> {
    let run = |method: Method| {
        let run = one(prepared, method, &stop);
        done();
        run
    };
    let plain = run(stabilizations(prepared, 1.0)?.swap_remove(0))?;
    let span = prepared.span()?;
    let step = prepared.method.step.unwrap_or((span.end - span.start) / plain.steps.max(1) as f64);
    let others = run_all(cores(), stabilizations(prepared, step)?.into_iter().skip(1), run);
    [Ok(plain)].into_iter().chain(others).collect()
}

/// Returns the method of the scene with every formulation and projection that its integrator can be combined with, the
/// least stabilization first. Gains are those for steps of size `step`, s: alpha = beta = 1/step is the pair (2/h, 1/h^2).
///
/// # Errors
/// There is only one.
pub fn stabilizations(prepared: &Model, step: f64) -> Result<Vec<Method>> {
    let gain = significant(1.0 / step, 3);
    let baumgarte = format!("baumgarte:alpha={gain},beta={gain}");
    let invariant_manifold = format!("invariant_manifold:gamma={gain}");
    let pairs = [
        ["index1", "none"],
        ["baumgarte", "none"],
        [&baumgarte, "none"],
        [&invariant_manifold, "none"],
        ["index1", "position"],
        ["index1", "velocity"],
        ["index1", "manifold"],
        ["index1", "manifold:sweeps=2"],
        ["index1", "full"],
        ["index1", "exact"],
        ["index2", "none"],
        ["index2", "position"],
        ["index3", "none"],
        ["index3", "velocity"],
        ["ggl", "none"],
        ["stabilized_index1", "none"],
    ];
    let mut methods = Vec::new();
    for [formulation, projection] in pairs {
        let formulation = MethodSpec::parse(formulation)?;
        let projection = MethodSpec::parse(projection)?;
        methods.push(Method { formulation, projection, ..prepared.method.clone() });
    }
    methods.retain(|method| method.check().is_ok());
    if methods.len() > 1 {
        return Ok(methods);
    }
    let Method { integrator, formulation, .. } = &prepared.method;
    let because = prepared.chosen_because.as_ref().map_or(String::new(), |because| format!("; auto: {because}"));
    let message = format!("{integrator} goes with {formulation} alone: there is nothing to compare{because}");
    let path = if prepared.chosen_because.is_some() { "--method" } else { "simulation.integrator" };
    Err(Error::input(message).under(path).hint("name another, as in --integrator dop853 or --integrator radau_iia"))
}

fn one(prepared: &Model, method: Method, stop: impl Fn() -> Option<Stop>) -> Result<StabilizedRun> {
    let mut recorder = Recorder::new(prepared.system()).with_stop(stop);
    let watch = Stopwatch::start();
    let Outcome { statistics, failure, .. } =
        simulate(prepared.system(), &method, prepared.span()?, prepared.start(), &mut recorder)?;
    let wall_seconds = watch.wall().as_secs_f64();
    let mut record = recorder.finish();
    // There are many records: figures show their times alone, and a page shows some of their rows.
    let rows = record.trajectory.times().map(|t| vec![t]).collect();
    let mut motion = record.trajectory;
    let stride = motion.rows.len().div_ceil(MOST_ROWS).max(1);
    motion.rows = motion.rows.into_iter().step_by(stride).collect();
    record.trajectory = Trajectory { names: Names::default(), outputs: Vec::new(), rows };
    let Method { formulation, projection, .. } = method;
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
        motion,
    })
}
