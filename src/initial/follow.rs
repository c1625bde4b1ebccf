//! Continuation of an assembled state to a nearby one on the same branch.

use super::{Metric, continuation, holds};
use crate::error::Result;
use crate::math::largest;
use crate::math::newton::{Limits, Monitor};
use crate::system::MechanicalSystem;
use crate::tolerances;

/// Positions that satisfy the constraints.
#[derive(Clone, Debug, PartialEq)]
pub struct Followed {
    /// Coordinates, n_q.
    pub q: Vec<f64>,
    /// Rank indicator of the constraints with the held directions: 0 at a singular state.
    pub rank_indicator: f64,
    /// Constraints that depend on the others.
    pub dependent: Vec<usize>,
}

/// Limits of Newton's method, relative to 1 m or rad or the largest coordinate, to round-off, also near a singular
/// state. Where its changes contract at this rate from the second on, there is one solution around the guess, and it is
/// the continuation of the state from which the guess was taken; convergence to other solutions is slower (P.
/// Deuflhard, Newton Methods for Nonlinear Problems, 2011, section 5.1).
const LIMITS: Limits = Limits {
    most: 20,
    round_off: tolerances::ROUND_OFF_OF_PHI,
    contraction: tolerances::UNIQUE_CONTRACTION,
    ..Limits::NONE
};

/// Closes the joints from a nearby guess; `None` where Newton's method does not contract from its first step on, so
/// that it may lead to another branch or nowhere, or leaves one open. Rows named in `dependent` are dropped and checked at the end.
///
/// # Errors
/// Constraints that are infinite at the guess or on the way, names in `hold` that do not exist.
pub fn follow(
    system: &dyn MechanicalSystem,
    t: f64,
    guess: &[f64],
    hold: &[String],
    dependent: &[usize],
) -> Result<Option<Followed>> {
    let mut metric = Metric::new(system, holds::directions(system, hold)?);
    metric.kkt.drop_rows(dependent);
    let mut q = guess.to_vec();
    let mut moved = vec![0.0; system.dimensions().v];
    system.normalize(&mut q);
    if !newton(&mut metric, t, &mut q, &mut moved)? {
        return Ok(None);
    }
    metric.at_rest(t, &q)?;
    if !metric.is_closed(&q) {
        return Ok(None);
    }
    let rows = metric.kkt.left_out().iter().copied();
    let dependent: Vec<usize> = rows.filter(|row| *row < metric.terms.phi.len()).collect();
    // The rank indicator of the other rows.
    metric.kkt.drop_rows(&dependent);
    metric.at_rest(t, &q)?;
    Ok(Some(Followed { q, rank_indicator: metric.kkt.rank_indicator(), dependent }))
}

/// Newton's method on phi; true if it contracts from its first step on. Adds its steps to `moved`.
fn newton(metric: &mut Metric, t: f64, q: &mut [f64], moved: &mut [f64]) -> Result<bool> {
    let mut d = vec![0.0; moved.len()];
    Monitor::default().solve(LIMITS, |_| {
        metric.at_rest(t, q)?;
        metric.step(None, &mut d)?;
        let start = q.to_vec();
        metric.go(&start, &d, 1.0, q);
        moved.iter_mut().zip(&d).for_each(|(moved, d)| *moved += d);
        Ok(largest(&d) / largest(q).max(1.0))
    })
}

/// Moves q along the path on which phi of some rows, open by `gap` at q, goes to zero as (1 - s) gap. Returns s where it
/// ends; the terms are those at q.
pub(super) fn path(all: &mut Metric, rows: &[usize], t: f64, q: &mut [f64], moved: &mut [f64]) -> f64 {
    all.residual(t, q);
    let mut gap = vec![0.0; all.terms.phi.len()];
    rows.iter().for_each(|row| gap[*row] = all.terms.phi[*row]);
    let (done, _) = continuation(0.0, 1.0, 1.0, tolerances::LEAST_PART, |next| {
        let mut ahead = q.to_vec();
        let mut change = moved.to_vec();
        all.ahead = gap.iter().map(|gap| (1.0 - next) * gap).collect();
        let contracts = newton(all, t, &mut ahead, &mut change).unwrap_or(false);
        let is_there = contracts && all.residual(t, &ahead).is_finite() && all.is_closed(&ahead);
        is_there.then(|| {
            q.copy_from_slice(&ahead);
            moved.copy_from_slice(&change);
            2.0
        })
    });
    all.ahead.clear();
    all.residual(t, q);
    done
}
