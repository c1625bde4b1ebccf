//! Newton's method on the equations of equilibrium.

use super::system::{EquilibriumChange, EquilibriumPoint, EquilibriumSystem};
use crate::math::largest;
use crate::math::newton::{Limits, Monitor};
use crate::tolerances;

/// Iterations at most: bent beams need steps that grow before they shrink.
const BALANCING_ITERATIONS: usize = 60;

/// Safeguards of Newton's method.
#[derive(Clone, Copy)]
pub(super) struct Policy {
    limits: Limits,
    is_damped: bool,
}

impl Policy {
    /// Undamped, without a limit on contraction: the steps of bent beams grow before they shrink.
    pub const FULL: Policy = Policy { limits: Limits { most: BALANCING_ITERATIONS, ..Limits::NONE }, is_damped: false };
    pub const DAMPED: Policy =
        Policy { limits: Limits { most: BALANCING_ITERATIONS, ..Limits::NONE }, is_damped: true };
    /// Near a solution: every step contracts.
    pub const NEAR: Policy = Policy {
        limits: Limits { most: tolerances::CLOSING_ITERATIONS, contraction: tolerances::NEWTON_HALVES, ..Limits::NONE },
        is_damped: false,
    };
}

/// Solves f - G^T lambda = `goal` (zero where none) with phi = 0. Returns the place, and true if all steps contracted;
/// `None` where Newton's method fails.
pub(super) fn newton(
    rest: &mut EquilibriumSystem,
    start: EquilibriumPoint,
    goal: Option<&[f64]>,
    policy: Policy,
) -> Option<(EquilibriumPoint, bool)> {
    let mut at = start;
    let mut newton = Monitor::default();
    let mut was_still = false;
    let mut was_small = false;
    let converged: Result<bool, ()> = newton.solve(policy.limits, |_| {
        rest.evaluate(&at.q);
        let force = residual(rest, &at, goal);
        let factored = rest.factor(&at, 0.0);
        let is_still = rest.is_round_off(&at, &force);
        if is_still && (was_still || !factored) {
            return Ok(0.0);
        }
        was_still = is_still;
        let change = if factored { rest.solve(&force) } else { None }.ok_or(())?;
        let size = rest.size(&change.q);
        let part = largest(&change.q) / (1.0 + largest(&at.q));
        if part > tolerances::AWAY {
            return Err(());
        }
        let is_small = part <= tolerances::ROOT_OF_ROUND_OFF;
        let is_damped = policy.is_damped && !is_small;
        let next = if is_damped { damped(rest, &at, &change, size) } else { Some(rest.moved(&at, &change, 1.0)) };
        at = next.ok_or(())?;
        let is_round_off = std::mem::replace(&mut was_small, is_small) && is_small;
        Ok(if is_round_off { 0.0 } else { size.max(f64::MIN_POSITIVE) })
    });
    (converged == Ok(true)).then_some((at, newton.slowest <= tolerances::UNIQUE_CONTRACTION))
}

/// Residual f - G^T lambda - goal of the present terms.
fn residual(rest: &EquilibriumSystem, at: &EquilibriumPoint, goal: Option<&[f64]>) -> Vec<f64> {
    let mut force = rest.force(&at.lambda);
    force.iter_mut().zip(goal.unwrap_or_default()).for_each(|(force, goal)| *force -= goal);
    force
}

/// The longest step, by halving, after which the same matrix gives a shorter next one: the natural monotonicity test,
/// which does not depend on the units of forces and constraints (Deuflhard, section 3.3).
fn damped(
    rest: &mut EquilibriumSystem,
    at: &EquilibriumPoint,
    change: &EquilibriumChange,
    size: f64,
) -> Option<EquilibriumPoint> {
    let mut part = 1.0;
    while part > tolerances::UNSEEN {
        let next = rest.moved(at, change, part);
        rest.evaluate(&next.q);
        let force = rest.force(&next.lambda);
        let then = rest.solve(&force).map(|change| rest.size(&change.q));
        if then.is_some_and(|then| then <= (1.0 - 0.5 * part) * size) {
            return Some(next);
        }
        part *= 0.5;
    }
    None
}
