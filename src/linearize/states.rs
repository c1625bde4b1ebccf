//! States of a motion at chosen times.

use super::Variation;
use crate::error::{Error, Result, short};
use crate::initial::assemble;
use crate::prepared::{Model, Overrides};
use crate::simulate::{Method, Span, Start};

/// States of a run are integrated at least so well. Unit: `[1]`, rtol.
const RUN_TOLERANCE: f64 = 1e-10;

/// A state on the constraints.
#[derive(Clone, Debug, PartialEq)]
pub struct State {
    /// Time, s.
    pub t: f64,
    /// Coordinates, n_q.
    pub q: Vec<f64>,
    /// Velocities, n_v.
    pub v: Vec<f64>,
}

impl State {
    /// The consistent start of a scene.
    pub fn start(prepared: &Model) -> Self {
        let (q, v) = prepared.start();
        State { t: prepared.start_time(), q: q.to_vec(), v: v.to_vec() }
    }

    /// Returns the variational equations at this state.
    ///
    /// # Errors
    /// See [`Variation::new`].
    pub fn variation<'a>(&self, prepared: &'a Model) -> Result<Variation<'a>> {
        Variation::new(prepared.system(), self.t, &self.q, &self.v)
    }
}

/// Tightens the tolerances that the command line does not give, so that states are more accurate than what is derived
/// from them.
pub fn tighten(prepared: &mut Model, given: &Overrides) {
    let Method { rtol, atol, step, .. } = &mut prepared.method;
    if step.is_some() {
        return;
    }
    *rtol = given.rtol.unwrap_or(rtol.min(RUN_TOLERANCE));
    *atol = given.atol.unwrap_or(atol.min(RUN_TOLERANCE.max(*rtol)));
}

/// Returns the states of the scene's motion at `times`, in their order, each projected onto the constraints.
///
/// # Errors
/// A time before the start or after the end of the run; a run that stops before it.
pub fn states(prepared: &Model, times: &[f64], progress: impl FnMut(f64)) -> Result<Vec<State>> {
    within_run(prepared, times)?;
    let mut order: Vec<usize> = (0..times.len()).collect();
    order.sort_by(|&i, &j| times[i].total_cmp(&times[j]));
    let mut walk = Walk::new(prepared);
    let mut found = vec![walk.last.clone(); times.len()];
    let mut progress = progress;
    for place in order {
        found[place] = walk.to(times[place])?;
        progress(times[place]);
    }
    Ok(found)
}

/// The scene's motion, integrated from one time to the next.
pub(super) struct Walk<'a> {
    prepared: &'a Model,
    last: State,
}

impl<'a> Walk<'a> {
    pub fn new(prepared: &'a Model) -> Self {
        Walk { prepared, last: State::start(prepared) }
    }

    /// Returns the state at a time that is not before the last one.
    pub fn to(&mut self, t: f64) -> Result<State> {
        if t > self.last.t {
            // Methods with fixed steps carry a history, such as accelerations: a new start would give another motion.
            let from = if self.prepared.method.step.is_some() { &State::start(self.prepared) } else { &self.last };
            self.last = follow(self.prepared, from, t)?;
        }
        Ok(self.last.clone())
    }
}

/// Refuses times outside the run.
///
/// # Errors
/// The first such time.
pub fn within_run(prepared: &Model, times: &[f64]) -> Result<()> {
    let start = prepared.start_time();
    let end = prepared.span().map_or(f64::INFINITY, |span| span.end);
    let Some(t) = times.iter().find(|t| !(start..=end).contains(*t)) else { return Ok(()) };
    let t = short(*t);
    let start = short(start);
    let end = short(end);
    Err(Error::input(format!("t = {t} s is outside the run, which goes from {start} s to {end} s"))
        .under("--at")
        .hint("choose a time within it, or run longer with --until T"))
}

/// Integrates to `end` and projects the state onto the constraints.
pub(super) fn follow(prepared: &Model, from: &State, end: f64) -> Result<State> {
    let span = Span { start: from.t, end, output_step: end - from.t };
    let start = Start::State(&from.q, &from.v);
    let (outcome, _, _) = prepared.simulate_from(&prepared.method, span, start, &mut ())?;
    if let Some(failure) = outcome.failure {
        return Err(failure.into());
    }
    let closed = assemble(prepared.system(), end, (&outcome.q, &outcome.v), &[])?;
    Ok(State { t: end, q: closed.q, v: closed.v })
}
