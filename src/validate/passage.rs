//! Perturbed motions through changes of form of the equations, against the variational equations with their jumps there.

use super::Decay;
use super::perturb::{are_alike, moved};
use super::subject::Subject;
use crate::linearize::flow::{Bundle, flow_through};
use crate::linearize::{Matrix, State};
use crate::simulate::{Method, Sink, Span, Stop, simulate};
use crate::system::MechanicalSystem;
use crate::tolerances;
use serde::Serialize;

/// Sizes of the perturbation; the errors of the last ones are rounding. Each motion is a run of its own, which ends at
/// changes of form: their differences have an error of some 1e-11, that of events among it.
const EPSILONS: [f64; 9] = [1e-1, 3e-2, 1e-2, 3e-3, 1e-3, 3e-4, 1e-4, 1.3e-9, 1e-9];

/// Motions that pass a change of form, each at a time of its own. Small changes jump there by the saltation matrix.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct EventPassage {
    /// Time of the comparison, s.
    pub t: f64,
    /// Sizes of (dq, dv/rate), m or rad.
    pub epsilons: Vec<f64>,
    /// Norm of the difference of both motions less its prediction.
    pub errors: Vec<f64>,
    /// Order of these errors in epsilon.
    pub order: Decay,
}

/// Perturbs the start along x0 and compares at the time `t`; none where the motion does not come through, or stays on a
/// threshold.
pub(super) fn passage(subject: &Subject, x0: &Matrix, t: f64) -> Option<EventPassage> {
    let Subject { system, start, model, norm, is_over, .. } = subject;
    let bundle = Bundle { columns: model.coordinates.changes_of(x0), ..Bundle::of(start) };
    let mut predicted = None;
    flow_through(*system, &bundle, &[t], |snapshot| {
        predicted = Some(snapshot.clone());
        true
    })
    .ok()?;
    let mut end = predicted?;
    end.motion = reached(*system, start, t, *is_over)?;
    let perturbed = |&eps: &f64| {
        let member = moved(*system, start, &model.coordinates, x0, eps)?;
        if !are_alike(*system, start, &member) {
            return None;
        }
        Some((eps, reached(*system, &member, t, *is_over)?))
    };
    let (epsilons, members): (Vec<f64>, Vec<State>) = EPSILONS.iter().filter_map(perturbed).unzip();
    end.members = members;
    let errors = norm.errors(*system, &end, &end.columns, &epsilons);
    let order = norm.order(*system, &end, &epsilons, &errors);
    Some(EventPassage { t, epsilons, errors, order })
}

/// Returns the state of a motion at the time `t`; none where it does not come so far.
fn reached(system: &dyn MechanicalSystem, start: &State, t: f64, is_over: &dyn Fn() -> bool) -> Option<State> {
    let method = Method { rtol: tolerances::FLOW_RTOL, atol: tolerances::TIGHTEST, ..Method::default() };
    let span = Span { start: start.t, end: t, output_step: t - start.t };
    let outcome = simulate(system, &method, span, (&start.q, &start.v), &mut TimeLimited(is_over)).ok()?;
    outcome.failure.is_none().then_some(State { t, q: outcome.q, v: outcome.v })
}

/// Ends a run when the time is over.
struct TimeLimited<'t>(&'t dyn Fn() -> bool);

impl Sink for TimeLimited<'_> {
    fn watches(&self) -> bool {
        false
    }

    fn stops(&self) -> Option<Stop> {
        (self.0)().then(|| Stop { reason: "the time is over".to_string(), hint: "give more time".to_string() })
    }
}
