//! States of a motion at chosen times.

use super::Variation;
use crate::error::{Error, Result, short};
use crate::initial::assemble;
use crate::prepared::{Model, Overrides};
use crate::run::Run;
use crate::simulate::{Method, Span, Start};
use crate::system::MechanicalSystem;

/// States of a run are integrated at least so well. Unit: `[1]`, rtol.
const RUN_TOLERANCE: f64 = 1e-10;

/// A state on the constraints.
#[derive(Clone, Debug, Default, PartialEq)]
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

    /// A state that should be on the constraints.
    pub fn new(t: f64, q: impl Into<Vec<f64>>, v: impl Into<Vec<f64>>) -> Self {
        State { t, q: q.into(), v: v.into() }
    }

    /// Returns the variational equations at this state.
    ///
    /// # Errors
    /// See [`Variation::new`].
    pub fn variation<'a>(&self, system: &'a dyn MechanicalSystem) -> Result<Variation<'a>> {
        Variation::new(system, self.t, &self.q, &self.v)
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

/// Returns the states of a motion at `times`, in their order, each projected onto the constraints. The motion begins
/// at `start`, by a method with its tolerances: `"index1 + dop853 + manifold"`.
///
/// # Errors
/// A time before the start; a motion that stops before it; bad input, as of [`simulate`](crate::run::simulate).
pub fn states<M: TryInto<Method>>(
    system: &dyn MechanicalSystem,
    method: M,
    start: &State,
    times: &[f64],
) -> Result<Vec<State>>
where
    Error: From<M::Error>,
{
    let last = times.iter().copied().fold(start.t, f64::max);
    let mut run = Run::new(system, method, start.t, (&start.q[..], &start.v[..])).planned_to(last);
    in_order(times, |t| {
        if t == start.t {
            return projected(system, t, (&start.q, &start.v));
        }
        run.to(t)?;
        let reached = run.state()?;
        projected(system, t, (&reached.q, &reached.v))
    })
}

impl Model {
    /// Returns the states of the scene's motion at `times`, in their order, each projected onto the constraints.
    ///
    /// # Errors
    /// A time before the start or after the end of the run; a run that stops before it.
    pub fn states_at(&self, times: &[f64]) -> Result<Vec<State>> {
        states_of(self, times, |_| ())
    }
}

/// The same, with a call for each time that is reached.
pub fn states_of(prepared: &Model, times: &[f64], mut progress: impl FnMut(f64)) -> Result<Vec<State>> {
    within_run(prepared, times)?;
    let mut walk = Walk::new(prepared);
    in_order(times, |t| walk.to(t).inspect(|_| progress(t)))
}

/// Returns the states at `times`, asked for in the order of the times.
fn in_order(times: &[f64], mut state_at: impl FnMut(f64) -> Result<State>) -> Result<Vec<State>> {
    let mut order: Vec<usize> = (0..times.len()).collect();
    order.sort_by(|&i, &j| times[i].total_cmp(&times[j]));
    let mut found = vec![State::default(); times.len()];
    for place in order {
        found[place] = state_at(times[place])?;
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
    projected(prepared.system(), end, (&outcome.q, &outcome.v))
}

/// Projects a state onto the constraints.
fn projected(system: &dyn MechanicalSystem, t: f64, state: (&[f64], &[f64])) -> Result<State> {
    let closed = assemble(system, t, state, &[])?;
    Ok(State { t, q: closed.q, v: closed.v })
}
