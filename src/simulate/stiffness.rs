//! Whether an explicit method is the wrong one for a motion, said before it runs.

use super::automatic::rival;
use super::spectrum::{SpectralMode, Spectrum, fastest};
use super::{Method, Span};
use crate::error::{Warning, short};
use crate::integrator::Stability;
use crate::system::{MechanicalSystem, OperatingPoint};
use crate::tolerances::simulate as tolerances;
use serde::Serialize;
use std::fmt;

/// Modes of the start that an explicit method cannot step over, or only in far more steps than accuracy asks for.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Stiffness {
    /// Name of the integrator.
    pub integrator: String,
    /// The mode that limits the steps, 1/s.
    pub mode: SpectralMode,
    /// |lambda| h from which the method lets it grow.
    pub limit: f64,
    /// The fixed step, s; none where the method chooses its steps.
    pub step: Option<f64>,
    /// The longest stable step, s.
    pub stable_step: f64,
    /// Number of the longest stable steps in the run.
    pub steps_for_stability: f64,
    /// How much farther an implicit method comes for the same work, where the method chooses its steps.
    pub implicit_gain: Option<f64>,
    /// A method that can, in words.
    pub advice: String,
}

/// Warns of a method that is explicit, for a motion from `state`, which has the v' and lambda of the equations, over
/// `span`. None where nothing is wrong or known.
pub fn stiffness(
    system: &dyn MechanicalSystem,
    method: &Method,
    state: OperatingPoint,
    span: Span,
) -> Option<Stiffness> {
    let stability = explicit(system, method)?;
    let duration = span.end - span.start;
    let rough = fastest(system, state)?;
    // Below the limits along its own direction and both axes by far, no mode needs a closer look.
    let least =
        [(rough.decay, rough.swing), (1.0, 0.0), (0.0, 1.0)].map(|(decay, swing)| stability.limit(decay, swing));
    let longest = method.step.unwrap_or(duration / tolerances::STEPS_FOR_STABILITY);
    if least.iter().all(|limit| rough.rate() * longest < tolerances::DOUBTED_MODE * limit) {
        return None;
    }
    match method.step {
        Some(step) => too_long(system, state, step, duration, &stability),
        None => too_many(system, method, state, span),
    }
    .map(|(mode, gain)| {
        let limit = stability.limit(mode.decay, mode.swing);
        let stable_step = limit / mode.rate().max(f64::MIN_POSITIVE);
        Stiffness {
            integrator: method.integrator.name.clone(),
            mode,
            limit,
            step: method.step,
            stable_step,
            steps_for_stability: duration / stable_step,
            implicit_gain: gain,
            advice: advice(method, tolerances::ADVISED_STEP * stable_step),
        }
    })
}

/// The mode that a fixed step makes grow. What grows little over the whole run is an error of accuracy.
fn too_long(
    system: &dyn MechanicalSystem,
    state: OperatingPoint,
    step: f64,
    duration: f64,
    stability: &Stability,
) -> Option<(SpectralMode, Option<f64>)> {
    let spectrum = Spectrum::at(system, state)?;
    let stable = |mode: &SpectralMode| stability.limit(mode.decay, mode.swing) / mode.rate().max(f64::MIN_POSITIVE);
    let &mode = spectrum.modes.iter().min_by(|a, b| stable(a).total_cmp(&stable(b)))?;
    let grows = duration / step * stability.growth(mode.decay, mode.swing, step) > tolerances::UNSTABLE_MODE;
    (step > stable(&mode) && grows).then_some((mode, None))
}

/// The mode for whose sake alone an adaptive method takes its steps.
fn too_many(
    system: &dyn MechanicalSystem,
    method: &Method,
    state: OperatingPoint,
    span: Span,
) -> Option<(SpectralMode, Option<f64>)> {
    let contest = rival(system, method, span, (state.q, state.v))?;
    (contest.gain > tolerances::ANOTHER_METHOD).then_some((contest.mode, Some(contest.gain)))
}

/// Stability of the method; none where its steps may be as long as they like.
pub fn explicit(system: &dyn MechanicalSystem, method: &Method) -> Option<Stability> {
    method.make_integrator(system).ok()?.stability()
}

fn advice(method: &Method, step: f64) -> String {
    let implicit = "an implicit method: --formulation ggl --integrator radau_iia --projection none";
    match method.step {
        Some(_) => format!(
            "take steps below {} s, or {implicit}; generalized_alpha on ggl damps what is too fast for its steps away",
            two(step)
        ),
        None => format!("take {implicit}; `--method auto` chooses on the way"),
    }
}

/// With two digits.
fn two(value: f64) -> String {
    short(format!("{value:.1e}").parse().unwrap_or(value))
}

impl From<&Stiffness> for Warning {
    fn from(stiffness: &Stiffness) -> Self {
        Warning::new(stiffness.to_string(), stiffness.advice.clone())
    }
}

impl fmt::Display for Stiffness {
    fn fmt(&self, out: &mut fmt::Formatter<'_>) -> fmt::Result {
        let Stiffness { integrator, mode, limit, .. } = self;
        match self.step {
            Some(step) => write!(
                out,
                "a mode of the start {mode}: {integrator} with steps of {} s is unstable above {} 1/s",
                short(step),
                two(limit / step)
            ),
            None => write!(
                out,
                "the fastest mode of the start {mode}: {integrator} needs {} steps to stay stable, and radau_iia comes {} \
                 times as far for the same work",
                two(self.steps_for_stability.ceil()),
                two(self.implicit_gain.unwrap_or(1.0))
            ),
        }
    }
}
