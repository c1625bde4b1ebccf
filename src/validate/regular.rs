//! How far motions can be compared: a linear model ends at a singular state and where the equations change their form,
//! which perturbed motions pass at other times.

use crate::analysis::SingularityWatch;
use crate::error::Result;
use crate::linearize::{State, changed_parts};
use crate::simulate::{Method, Observation, Sink, Span, simulate};
use crate::system::MechanicalSystem;
use crate::tolerances::SAME;
use crate::tolerances::TRUNCATED_RANK;

/// A state at which the equations change their form.
#[derive(Clone, Debug, PartialEq, serde::Serialize)]
pub struct Event {
    /// Time, s.
    pub t: f64,
    /// Part of the equations that changes, such as "the force `push`".
    pub owner: String,
}

/// The end of the smooth motion, where there is one within the time.
#[derive(Default)]
pub struct SmoothEnd {
    /// Time of the first singular state, s.
    pub singular: Option<f64>,
    /// The first change of form.
    pub event: Option<Event>,
}

struct Watcher<'a> {
    system: &'a dyn MechanicalSystem,
    rank: SingularityWatch<'a>,
    /// Events are of interest after this time, s.
    after: f64,
    event: Option<Event>,
}

impl Sink for Watcher<'_> {
    fn accepted(&mut self, state: &Observation) {
        if self.system.dimensions().lambda > 0 {
            self.rank.add(state);
        }
    }

    fn watches_events(&self) -> bool {
        true
    }

    fn before_event(&mut self, at: &Observation) {
        if self.event.is_some() || at.t <= self.after {
            return;
        }
        let state = State { t: at.t, q: at.q.to_vec(), v: at.v.to_vec() };
        let parts = changed_parts(self.system, &state).unwrap_or_default();
        self.event = parts.first().map(|owner| Event { t: at.t, owner: owner.to_string() });
    }
}

/// Returns the first singular state of the motion within `duration`, or the time at which it ends at one, and the first
/// change of form.
///
/// # Errors
/// A start that cannot be simulated.
pub fn end(system: &dyn MechanicalSystem, start: &State, duration: f64) -> Result<SmoothEnd> {
    let is_constrained = system.dimensions().lambda > 0;
    if !is_constrained && system.switches().all.is_empty() {
        return Ok(SmoothEnd::default());
    }
    let after = start.t + SAME * duration;
    let mut watcher = Watcher { system, rank: SingularityWatch::new(system), after, event: None };
    let span = Span { start: start.t, end: start.t + duration, output_step: duration };
    let outcome = simulate(system, &Method::default(), span, (&start.q, &start.v), &mut watcher)?;
    let Watcher { rank, event, .. } = watcher;
    let found = rank.finish();
    let passed = found.passed.iter().find(|passing| passing.is_singular).map(|passing| passing.t);
    let is_near = found.nearest.is_some_and(|nearest| nearest.rank_indicator < TRUNCATED_RANK);
    let singular = passed.or(outcome.failure.filter(|_| is_near && is_constrained).map(|failure| failure.t));
    Ok(SmoothEnd { singular, event })
}
