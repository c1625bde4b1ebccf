//! The error that a run has reached, by one that is more accurate.

use crate::analysis::Recorder;
use crate::error::Failure;
use crate::linearize::amplified;
use crate::prepared::PreparedScene;
use crate::simulate::{Method, Span, Stop};
use crate::trajectory::Trajectory;
use serde::{Serialize, Serializer};

/// How a run differs from the same one with closer steps.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct CheckError {
    /// Of the second run.
    pub rtol: f64,
    pub atol: f64,
    pub step: Option<f64>,
    /// Over the rows that both have. Coordinates where the scene has no outputs.
    #[serde(serialize_with = "by_name")]
    pub outputs: Vec<(String, Difference)>,
    /// How much the motion amplifies small changes of its start, or why that is not known.
    #[serde(serialize_with = "if_known")]
    pub amplification: Result<f64, String>,
    /// Why the second run ended early.
    pub failure: Option<Failure>,
}

/// Of a quantity in two runs, in its unit, which is empty where it is not known.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Difference {
    pub max: f64,
    #[serde(rename = "final")]
    pub last: f64,
    pub unit: String,
}

/// Runs the scene again with closer steps, and compares the `first` run with that. `show` is told the times, `stop` asked
/// whether to end.
pub fn check_error(
    prepared: &PreparedScene,
    span: Span,
    first: &Trajectory,
    (show, stop): (impl Fn(f64), impl Fn() -> Option<Stop>),
) -> CheckError {
    let method = closer(&prepared.method);
    let mut recorder = Recorder::new(prepared.system()).with_progress(&show).with_stop(&stop);
    let outcome = prepared.simulate(&method, span, &mut recorder);
    let second = recorder.finish();
    let failure = match outcome {
        Ok((outcome, _)) => second.singularity.failure().or(outcome.failure),
        Err(error) => Some(Failure { t: span.start, reason: error.to_string(), hint: String::new() }),
    };
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
        amplification: amplification.map_err(|error| error.to_string()),
        failure,
    }
}

/// The same method at a tenth of the tolerance, or half the step.
fn closer(method: &Method) -> Method {
    let mut closer = method.clone();
    match &mut closer.step {
        Some(step) => *step *= 0.5,
        None => (closer.rtol, closer.atol) = (method.rtol / 10.0, method.atol / 10.0),
    }
    closer
}

fn differences(first: &Trajectory, second: &Trajectory) -> Vec<(String, Difference)> {
    let has_outputs = !first.outputs.is_empty();
    let values = |of: &Trajectory, row: &[f64]| match has_outputs {
        true => of.row_outputs(row).to_vec(),
        false => of.row_state(row).0.to_vec(),
    };
    let both = first.rows.iter().zip(&second.rows).take_while(|(one, other)| one[0] == other[0]);
    let rows: Vec<[Vec<f64>; 2]> = both.map(|(one, other)| [values(first, one), values(second, other)]).collect();
    let difference = |i: usize| {
        let all = || rows.iter().map(|[one, other]| (one[i] - other[i]).abs());
        (all().fold(f64::NAN, f64::max), all().next_back().unwrap_or(f64::NAN))
    };
    let named = |(i, (name, unit)): (usize, (&String, &str))| {
        let (max, last) = difference(i);
        (name.clone(), Difference { max, last, unit: unit.to_string() })
    };
    match has_outputs {
        true => {
            first.outputs.iter().map(|column| (&column.name, column.unit.as_str())).enumerate().map(named).collect()
        }
        false => first.names.q.iter().map(|name| (name, "")).enumerate().map(named).collect(),
    }
}

fn by_name<S: Serializer>(outputs: &[(String, Difference)], serializer: S) -> Result<S::Ok, S::Error> {
    serializer.collect_map(outputs.iter().map(|(name, difference)| (name, difference)))
}

fn if_known<S: Serializer>(amplification: &Result<f64, String>, serializer: S) -> Result<S::Ok, S::Error> {
    amplification.as_ref().ok().serialize(serializer)
}
