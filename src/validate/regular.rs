//! How far motions can be compared: a linear model ends at a singular state, which perturbed motions pass at other
//! times.

use crate::analysis::Watch;
use crate::error::Result;
use crate::linearize::State;
use crate::simulate::{Method, Observation, Sink, Span, simulate};
use crate::system::MechanicalSystem;
use crate::tolerances::math::TRUNCATED_RANK;

struct Watcher<'a>(Watch<'a>);

impl Sink for Watcher<'_> {
    fn accepted(&mut self, state: &Observation) {
        self.0.add(state);
    }
}

/// Returns the time of the first singular state of the motion within `duration`, or the time at which it ends at one.
///
/// # Errors
/// A start that cannot be simulated.
pub fn first_singular(system: &dyn MechanicalSystem, start: &State, duration: f64) -> Result<Option<f64>> {
    if system.dimensions().lambda == 0 {
        return Ok(None);
    }
    let mut watcher = Watcher(Watch::new(system));
    let span = Span { start: start.t, end: start.t + duration, output_step: duration };
    let outcome = simulate(system, &Method::default(), span, (&start.q, &start.v), &mut watcher)?;
    let found = watcher.0.finish();
    let passed = found.passed.iter().find(|passing| passing.is_singular).map(|passing| passing.t);
    let is_near = found.nearest.is_some_and(|nearest| nearest.rank_indicator < TRUNCATED_RANK);
    Ok(passed.or(outcome.failure.filter(|_| is_near).map(|failure| failure.t)))
}
