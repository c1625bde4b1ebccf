//! Test before a run whether stability limits the steps of an explicit method.

use super::automatic::rival;
use super::spectrum::{Spectrum, bound, fastest};
use super::{Method, Span};
use crate::error::{Warning, short, two_digits};
use crate::integrator::{self, Stability};
use crate::modes::SpectralMode;
use crate::system::{MechanicalSystem, OperatingPoint};
use serde::Serialize;
use std::fmt;

/// Steps that an adaptive method may take for stability before anything is asked. Unit: `[steps]`. Test:
/// `shipped_scenes_are_not_warned_of`.
const STEPS_FOR_STABILITY: f64 = 150.0;

/// Modes of the start for which an explicit method is unstable, or needs far more steps than accuracy requires.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Stiffness {
    /// Name of the integrator.
    pub integrator: String,
    /// The mode that limits the steps.
    pub mode: SpectralMode,
    /// The largest stable |lambda| h of the method for this mode.
    pub limit: f64,
    /// The fixed step, s; `None` where the method chooses its steps.
    pub step: Option<f64>,
    /// The longest stable step, s.
    pub stable_step: f64,
    /// Number of the longest stable steps in the run.
    pub steps_for_stability: f64,
    /// Time simulated by an implicit method over that of this one for the same work, where the method chooses its
    /// steps.
    pub implicit_gain: Option<f64>,
    /// Another method or step, as a sentence.
    pub advice: String,
}

/// Warning about an explicit method for a motion from `state`, which has the v' and lambda of the equations, over
/// `span`. `None` where there is nothing to warn of, or nothing is known.
pub fn stiffness(
    system: &dyn MechanicalSystem,
    method: &Method,
    state: OperatingPoint,
    span: Span,
) -> Option<Stiffness> {
    let stability = explicit(method)?;
    let duration = span.end - span.start;
    let longest = method.step.unwrap_or(duration / STEPS_FOR_STABILITY);
    // Far below the limits along its own direction and both axes no mode is critical.
    let is_slow = |rate: f64, directions: &[(f64, f64)]| {
        let mut limits = directions.iter().map(|&(decay, swing)| stability.limit(decay, swing));
        // The estimate of the fastest mode is rough.
        limits.all(|limit| rate * longest < 0.5 * limit)
    };
    let axes = [(1.0, 0.0), (0.0, 1.0)];
    if bound(system, state).is_some_and(|rate| is_slow(rate, &axes)) {
        return None;
    }
    let rough = fastest(system, state)?;
    if is_slow(rough.rate(), &[(rough.decay, rough.swing), axes[0], axes[1]]) {
        return None;
    }
    let (mode, implicit_gain) = match method.step {
        Some(step) => (too_long(system, state, step, duration, &stability)?, None),
        None => {
            let contest = rival(system, method, span, (state.q, state.v))?;
            let gain = Some(contest.gain).filter(|gain| *gain > 3.0)?;
            (contest.mode, Some(gain))
        }
    };
    let limit = stability.limit(mode.decay, mode.swing);
    let stable_step = limit / mode.rate().max(f64::MIN_POSITIVE);
    Some(Stiffness {
        integrator: method.integrator.name.clone(),
        mode,
        limit,
        step: method.step,
        stable_step,
        steps_for_stability: duration / stable_step,
        implicit_gain,
        // As of step control.
        advice: advice(method, 0.9 * stable_step),
    })
}

/// The mode that a fixed step makes grow. Growth by less than e over the whole run is an error of accuracy.
fn too_long(
    system: &dyn MechanicalSystem,
    state: OperatingPoint,
    step: f64,
    duration: f64,
    stability: &Stability,
) -> Option<SpectralMode> {
    let stable = |mode: &SpectralMode| stability.limit(mode.decay, mode.swing) / mode.rate().max(f64::MIN_POSITIVE);
    let modes = Spectrum::at(system, state)?.modes;
    let mode = modes.into_iter().min_by(|a, b| stable(a).total_cmp(&stable(b)))?;
    let growth = duration / step * stability.growth(mode.decay, mode.swing, step);
    (step > stable(&mode) && growth > 1.0).then_some(mode)
}

/// Stability region of the method; `None` for a method without a limit.
pub fn explicit(method: &Method) -> Option<Stability> {
    integrator::find(&method.integrator).ok()?.stability.map(|stability| stability())
}

fn advice(method: &Method, step: f64) -> String {
    let implicit = "an implicit method: --formulation ggl --integrator radau_iia --projection none";
    match method.step {
        Some(_) => format!(
            "take steps below {} s, or {implicit}; generalized_alpha on ggl damps what is too fast for its steps away",
            two_digits(step)
        ),
        None => format!("take {implicit}; `--method auto` chooses on the way"),
    }
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
                two_digits(limit / step)
            ),
            None => write!(
                out,
                "the fastest mode of the start {mode}: {integrator} needs {} steps to stay stable, and radau_iia advances {} \
                 times as far for the same work",
                two_digits(self.steps_for_stability.ceil()),
                two_digits(self.implicit_gain.unwrap_or(1.0))
            ),
        }
    }
}
