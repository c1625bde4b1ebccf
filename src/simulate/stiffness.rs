//! Whether an explicit method is the wrong one for a motion, said before it runs.

use super::auto::{Explicit, Verdict, Work, count, is_awake};
use super::spectrum::{Mode, Spectrum, fastest};
use super::{Method, Span};
use crate::error::{Warning, short};
use crate::integrator::{self, Setup, Stability, Store};
use crate::system::{Loaded, MechanicalSystem};
use serde::Serialize;
use std::fmt;

/// Modes of the start that an explicit method cannot step over, or only in far more steps than accuracy asks for.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Stiffness {
    pub integrator: String,
    /// The mode that limits the steps, 1/s.
    pub mode: Mode,
    /// |lambda| h from which the method lets it grow.
    pub limit: f64,
    /// The fixed step, s; none where the method chooses its steps.
    pub step: Option<f64>,
    /// The longest stable step, s, and how many of them the run takes.
    pub stable_step: f64,
    pub steps_for_stability: f64,
    /// Steps that the accuracy of the slower modes asks for, where the method chooses them.
    pub steps_for_accuracy: Option<f64>,
    /// A method that can, in words.
    pub advice: String,
}

/// What a rough estimate of the fastest mode may be off by.
const DOUBT: f64 = 0.5;
/// Powers of e that an unstable mode grows by over a run before it counts.
const GROWN: f64 = 1.0;
/// Part of the limit that is advised.
const SAFETY: f64 = 0.9;
/// An adaptive method may take so many steps for stability before anything is asked.
const FEW: f64 = 150.0;

/// Warns of a method that is explicit, for a motion from `state`, which has the v' and lambda of the equations, over
/// `span`. None where nothing is wrong or known.
pub fn stiffness(system: &dyn MechanicalSystem, method: &Method, state: Loaded, span: Span) -> Option<Stiffness> {
    let (order, stability) = explicit(system, method)?;
    let duration = span.end - span.start;
    let rough = fastest(system, state)?;
    // Below the limits along its own direction and both axes by far, no mode needs a closer look.
    let least =
        [(rough.decay, rough.swing), (1.0, 0.0), (0.0, 1.0)].map(|(decay, swing)| stability.limit(decay, swing));
    let longest = method.step.unwrap_or(duration / FEW);
    if least.iter().all(|limit| rough.rate() * longest < DOUBT * limit) {
        return None;
    }
    let spectrum = Spectrum::at(system, state, duration)?;
    let limit = |mode: &Mode| stability.limit(mode.decay, mode.swing);
    let stable_step = |mode: &Mode| limit(mode) / mode.rate().max(f64::MIN_POSITIVE);
    let &mode = spectrum.modes.iter().min_by(|a, b| stable_step(a).total_cmp(&stable_step(b)))?;
    let work = Work::new(&spectrum, duration, method.rtol, Explicit { order, stability: limit(&mode) });
    let awake = is_awake(&spectrum, state, (method.rtol, method.atol));
    let verdict = work.verdict(awake);
    let is_wrong = match method.step {
        // What grows little over the whole run is an error of accuracy.
        Some(step) => {
            step > stable_step(&mode) && duration / step * stability.growth(mode.decay, mode.swing, step) > GROWN
        }
        None => matches!(verdict, Verdict::Damped | Verdict::Asleep) || !awake && work.crawls(),
    };
    is_wrong.then(|| Stiffness {
        integrator: method.integrator.name.clone(),
        mode,
        limit: limit(&mode),
        step: method.step,
        stable_step: stable_step(&mode),
        steps_for_stability: duration / stable_step(&mode),
        steps_for_accuracy: method.step.is_none().then(|| work.asked(awake)),
        advice: advice(method, verdict, SAFETY * stable_step(&mode)),
    })
}

/// Order and stability of the method; none where its steps may be as long as they like.
pub fn explicit(system: &dyn MechanicalSystem, method: &Method) -> Option<(usize, Stability)> {
    let entry = integrator::find(&method.integrator).ok()?;
    let (store, is_fixed) = (Store::default(), method.step.is_some());
    let (integrator, formulation) = (&method.integrator, &method.formulation);
    let integrator = (entry.make)(&Setup { integrator, formulation, system, store: &store, is_fixed }).ok()?;
    Some((integrator.order(), integrator.stability()?))
}

fn advice(method: &Method, verdict: Verdict, step: f64) -> String {
    let implicit = "an implicit method: --formulation ggl --integrator radau_iia --projection none";
    let damps = "generalized_alpha on ggl, which damps the fast oscillation away";
    let other = match verdict {
        Verdict::Awake => damps,
        _ => implicit,
    };
    match method.step {
        Some(_) => format!("take steps below {} s, or {other}", two(step)),
        None => format!("take {other}; `--method auto` chooses by the start"),
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
        match (self.step, self.steps_for_accuracy) {
            (Some(step), _) => write!(
                out,
                "a mode of the start {mode}: {integrator} with steps of {} s is unstable above {} 1/s",
                short(step),
                two(limit / step)
            ),
            (None, accuracy) => write!(
                out,
                "the fastest mode of the start {mode}: {integrator} needs {} steps to stay stable, {} for accuracy",
                count(self.steps_for_stability),
                count(accuracy.unwrap_or(0.0))
            ),
        }
    }
}
