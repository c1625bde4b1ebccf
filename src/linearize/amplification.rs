//! Amplification of small changes by a motion.

use super::flow::{Bundle, flow};
use super::least_norm::least_norm;
use super::{Chart, Matrix, State, Variation};
use crate::error::{Error, Result};
use crate::prepared::Model;
use crate::simulate::{Method, Span, stiffness};
use crate::system::{MechanicalSystem, OperatingPoint};
use crate::tolerances;

/// Times at which the growth of small changes is computed.
const AMPLIFIED_TIMES: u32 = 20;

/// Returns the largest growth of any small change of the start up to any of `times` (increasing, after the start): the
/// norm of the transition matrices in mass-orthonormal states (z, y/s). The rate s is the one that makes the norm
/// least, so that an oscillation at one frequency counts 1, and so does free flight. `goes_on` is called with the
/// times.
///
/// # Errors
/// Too many degrees of freedom, a motion that cannot go on, or one that `goes_on` ends.
fn amplification(
    system: &dyn MechanicalSystem,
    start: &State,
    times: &[f64],
    mut goes_on: impl FnMut(f64) -> bool,
) -> Result<f64> {
    let chart = |state: &State| {
        let mut variation = Variation::new(system, state.t, &state.q, &state.v)?;
        Chart::MassOrthogonal.at(&mut variation)
    };
    let at_start = chart(start)?;
    let columns = at_start.changes();
    if columns.q.ncols() > 2 * tolerances::MANY_MODES {
        return Err(Error::input(format!(
            "more than {} degrees of freedom are too many to carry small changes of",
            tolerances::MANY_MODES
        )));
    }
    if columns.q.ncols() == 0 {
        return Ok(1.0);
    }
    let mut found = Vec::new();
    let bundle = Bundle { columns, ..Bundle::of(start) };
    flow(system, &bundle, times, |snapshot| {
        found.push(chart(&snapshot.motion).map(|chart| chart.states_of(&snapshot.columns)));
        goes_on(snapshot.motion.t)
    })?;
    if found.len() < times.len() {
        return Err(Error::input("it was ended"));
    }
    Ok(least_norm(&found.into_iter().collect::<Result<Vec<Matrix>>>()?, at_start.freedom()))
}

/// Returns the largest growth of any small change of the start by a scene's motion. `goes_on` is called with times of it.
///
/// # Errors
/// Too many degrees of freedom, a motion that cannot go on, or one that `goes_on` ends; modes that are too fast for the
/// explicit method that integrates small changes.
pub fn amplified(prepared: &Model, span: Span, goes_on: impl FnMut(f64) -> bool) -> Result<f64> {
    let start = State::start(prepared);
    let state = OperatingPoint {
        t: start.t,
        q: &start.q,
        v: &start.v,
        vdot: &prepared.assembly.vdot,
        lambda: &prepared.assembly.lambda,
    };
    if let Some(stiffness) = stiffness(prepared.system(), &Method::default(), state, span) {
        return Err(Error::input(stiffness.to_string()));
    }
    let time = |i: u32| span.start + (span.end - span.start) * f64::from(i) / f64::from(AMPLIFIED_TIMES);
    amplification(prepared.system(), &start, &(1..=AMPLIFIED_TIMES).map(time).collect::<Vec<f64>>(), goes_on)
}
