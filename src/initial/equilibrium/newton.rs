//! Newton's method on the equations of rest.

use super::rest::{Place, Rest};
use crate::math::largest;

/// How Newton's method is kept from going astray.
#[derive(Clone, Copy)]
pub(super) struct Policy {
    most: usize,
    /// It gives up where steps shrink less than this; infinite where it may take any way.
    contraction: f64,
    is_damped: bool,
}

impl Policy {
    /// Bent beams need steps that grow before they shrink.
    pub const FULL: Policy = Policy { most: 40, contraction: f64::INFINITY, is_damped: false };
    pub const DAMPED: Policy = Policy { most: 60, contraction: f64::INFINITY, is_damped: true };
    /// Near a solution.
    pub const NEAR: Policy = Policy { most: 12, contraction: 0.5, is_damped: false };
}

/// Steps that shrink by this from the first lead to the one solution around the start (P. Deuflhard, Newton Methods for
/// Nonlinear Problems, 2011, section 5.1).
const CONTRACTION: f64 = 0.25;
/// Change of q, m or rad over 1 and the largest q, that is round-off; and below which it may stop falling.
const ROUND_OFF: f64 = 1e-14;
const SMALL: f64 = 1e-8;
/// Steps so many times longer than 1 and the largest q lead nowhere.
const FAR: f64 = 100.0;
/// The shortest damped step.
const SHORTEST: f64 = 1e-3;

/// Solves f - G^T lambda = `goal` (zero where none) with phi = 0; the place, and whether all steps contracted. None where
/// Newton's method fails.
pub(super) fn newton(rest: &mut Rest, start: Place, goal: Option<&[f64]>, policy: Policy) -> Option<(Place, bool)> {
    let (mut at, mut last, mut contracts) = (start, f64::INFINITY, true);
    let mut was_still = false;
    for _ in 0..policy.most {
        rest.evaluate(&at.q);
        let force = left(rest, &at, goal);
        let factored = rest.factor(&at, 0.0);
        let is_still = rest.is_round_off(&at, &force);
        if is_still && (was_still || !factored) {
            return Some((at, contracts));
        }
        was_still = is_still;
        if !factored {
            return None;
        }
        let change = rest.solve(&force)?;
        let (size, longest, reach) = (rest.size(&change.q), largest(&change.q), 1.0 + largest(&at.q));
        let ratio = size / last;
        if !longest.is_finite() || longest > FAR * reach {
            return None;
        }
        if longest <= ROUND_OFF * reach || longest <= SMALL * reach && ratio > CONTRACTION {
            return Some((rest.moved(&at, &change, 1.0), contracts));
        }
        if ratio > policy.contraction {
            return None;
        }
        contracts &= last.is_infinite() || ratio <= CONTRACTION;
        last = size;
        at = match policy.is_damped {
            true => damped(rest, &at, &change, size)?,
            false => rest.moved(&at, &change, 1.0),
        };
    }
    None
}

/// f - G^T lambda - goal of the terms.
fn left(rest: &Rest, at: &Place, goal: Option<&[f64]>) -> Vec<f64> {
    let mut force = rest.force(&at.lambda);
    force.iter_mut().zip(goal.unwrap_or_default()).for_each(|(force, goal)| *force -= goal);
    force
}

/// The longest step, halved, after which the same matrix would ask for a shorter one: the natural monotonicity test,
/// which does not depend on the units of forces and constraints (Deuflhard, section 3.3).
fn damped(rest: &mut Rest, at: &Place, change: &super::rest::Change, size: f64) -> Option<Place> {
    let mut part = 1.0;
    while part > SHORTEST {
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
