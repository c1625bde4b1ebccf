//! Error of a run, by comparison with a more accurate one.

use super::work_precision::{Allowed, Motion, SecondOpinion, Watched, second_opinion};
use crate::analysis::Recorder;
use crate::error::Failure;
use crate::integrator::{Tightening, Tolerance, find};
use crate::linearize::amplified;
use crate::prepared::PreparedScene;
use crate::simulate::{Method, Span, Stop};
use crate::tolerances::simulate as tolerances;
use crate::trajectory::Trajectory;
use serde::{Serialize, Serializer};
use std::time::Duration;

/// Difference of a run from the same one with smaller steps.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct CheckError {
    /// Relative tolerance of the second run.
    pub rtol: f64,
    /// Absolute tolerance of the second run.
    pub atol: f64,
    /// Fixed step of the second run, s; none with an error estimate.
    pub step: Option<f64>,
    /// Differences over the common rows; of coordinates where the scene has no outputs.
    #[serde(serialize_with = "by_name")]
    pub outputs: Vec<(String, Difference)>,
    /// The difference of the second run from a run of diffsol; none where the second run ended early.
    pub second_opinion: Option<SecondOpinion>,
    /// Factor by which the motion amplifies small changes of its start, or the reason why it is not known.
    #[serde(serialize_with = "if_known")]
    pub amplification: Result<f64, String>,
    /// Reason why the second run ended early.
    pub failure: Option<Failure>,
}

/// Difference of a quantity in two runs.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Difference {
    /// Largest difference over the rows, in `unit`.
    pub max: f64,
    /// Difference at the last row, in `unit`.
    #[serde(rename = "final")]
    pub last: f64,
    /// Unit; empty where it is not known.
    pub unit: String,
}

/// Runs the scene again with smaller steps, and compares the `first` run with that. `show` is called with the times,
/// `stop` asked whether the run should end.
pub fn check_error(
    prepared: &PreparedScene,
    span: Span,
    first: &Trajectory,
    (show, stop): (impl Fn(f64), impl Fn() -> Option<Stop> + Sync),
) -> CheckError {
    let method = closer(prepared);
    let mut recorder = Recorder::new(prepared.system()).with_progress(&show).with_stop(&stop);
    let outcome = prepared.simulate(&method, span, &mut recorder);
    let second = recorder.finish();
    let failure = match outcome {
        Ok((outcome, _)) => second.singularity.failure().or(outcome.failure),
        Err(error) => Some(Failure { t: span.start, reason: error.to_string(), hint: String::new() }),
    };
    let opinion = failure
        .is_none()
        .then(|| confirm(prepared, span, (&second.trajectory, &method), &|| stop().is_some()))
        .flatten();
    let amplification = amplified(prepared, span, |t| {
        show(t);
        stop().is_none()
    });
    let Method { rtol, atol, step, .. } = method;
    CheckError {
        rtol,
        atol,
        step,
        outputs: differences(first, &second.trajectory),
        second_opinion: opinion,
        amplification: amplification.map_err(|error| error.to_string()),
        failure,
    }
}

/// Compares the run of `method` with one of diffsol.
fn confirm(
    prepared: &PreparedScene,
    span: Span,
    (trajectory, method): (&Trajectory, &Method),
    is_stopped: &(dyn Fn() -> bool + Sync),
) -> Option<SecondOpinion> {
    let motion = Motion { counts_start: true, ..Motion::of(prepared, span, is_stopped) };
    let watched = Watched::new(prepared.system(), &[]).ok()?;
    let rows: Vec<Vec<f64>> = trajectory.watched().collect();
    let allowed = Allowed { cpu: Duration::MAX, wall: Duration::MAX };
    Some(second_opinion(&motion, &watched, span, (&rows, method), allowed))
}

/// Returns the same method with a tenth of the tolerance, or half the step. Where the steps of the run are at their
/// tightest, and those of a tenth of its tolerance too, that is a tenth of what its steps were controlled by: else two
/// equal runs would be compared.
fn closer(prepared: &PreparedScene) -> Method {
    let mut closer = prepared.method.clone();
    let Method { rtol, atol, step, integrator, .. } = &prepared.method;
    let tightening = find(integrator).map_or(Tightening::NONE, |entry| entry.tightening);
    let of_steps = |rtol: f64| tightening.of_steps(&Tolerance::new(rtol, *atol, prepared.system())).rtol;
    let is_same = of_steps(0.1 * rtol) > tolerances::FINER_STEPS * of_steps(*rtol);
    match step {
        Some(step) => closer.step = Some(0.5 * step),
        None => {
            closer.rtol = 0.1 * if is_same { of_steps(*rtol) } else { *rtol };
            closer.atol = atol * closer.rtol / rtol;
        }
    }
    closer
}

fn differences(first: &Trajectory, second: &Trajectory) -> Vec<(String, Difference)> {
    let same = first.times().zip(second.times()).take_while(|(one, other)| one == other).count();
    let rows: Vec<(Vec<f64>, Vec<f64>)> = first.watched().zip(second.watched()).take(same).collect();
    let named = |(i, (name, unit)): (usize, (&str, &str))| {
        let all = || rows.iter().map(|(one, other)| (one[i] - other[i]).abs());
        let (max, last) = (all().fold(f64::NAN, f64::max), all().next_back().unwrap_or(f64::NAN));
        (name.to_string(), Difference { max, last, unit: unit.to_string() })
    };
    match first.outputs.is_empty() {
        true => first.names.q.iter().map(|name| (name.as_str(), "")).enumerate().map(named).collect(),
        false => first.named_outputs().enumerate().map(named).collect(),
    }
}

fn by_name<S: Serializer>(outputs: &[(String, Difference)], serializer: S) -> Result<S::Ok, S::Error> {
    serializer.collect_map(outputs.iter().map(|(name, difference)| (name, difference)))
}

fn if_known<S: Serializer>(amplification: &Result<f64, String>, serializer: S) -> Result<S::Ok, S::Error> {
    amplification.as_ref().ok().serialize(serializer)
}
