//! Descent along the forces to an equilibrium.

use super::newton::{Policy, newton};
use super::system::{Balance, EquilibriumChange, EquilibriumPoint, EquilibriumSystem};
use crate::math::newton::{Limits, Monitor};
use crate::math::{dot, largest, norm};
use crate::tolerances;

/// Steps at most.
const DESCENT_STEPS: usize = 500;

/// Limits of the return to phi = 0, in units of the scene's scale: round-off, also of nearly dependent rows.
const CLOSING: Limits = Limits {
    most: tolerances::CLOSING_ITERATIONS,
    round_off: tolerances::ROUND_OFF_OF_SUMS,
    stagnation: tolerances::ROUND_OFF_OF_PHI,
    contraction: 1.0,
    ..Limits::NONE
};

/// Result of a descent.
pub(super) enum DescentEnd {
    Equilibrium(EquilibriumPoint),
    /// The coordinate moves without bound.
    Away(usize),
    /// The steps are used up, none goes down, or constraints become dependent there, as in a folded arm.
    Stuck(EquilibriumPoint),
}

/// Pseudo-transient continuation: dq/dtau = f - G^T lambda on phi = 0, by implicit Euler steps of one iteration each
/// where that suffices,
///
/// ```text
/// [ K + I/dtau  G^T ] [ dq      ]   [ f - G^T lambda ]
/// [ G           0   ] [ dlambda ] = [ -phi           ]
/// ```
///
/// and back to phi = 0. A step is judged as in trust-region methods, by the work of the forces over it against what K
/// predicts; so no potential is needed. Source: Kelley, Keyes, SIAM J. Numer. Anal. 35 (1998) 508-523; Conn, Gould,
/// Toint, Trust-Region Methods, 2000, chapter 6. Returns the result and the number of steps.
pub(super) fn descend(rest: &mut EquilibriumSystem, q: &[f64]) -> (DescentEnd, usize) {
    let Some(mut at) = rest.balance(q) else {
        return (DescentEnd::Stuck(EquilibriumPoint { q: q.to_vec(), lambda: Vec::new() }), 0);
    };
    // The first step is a tenth of a metre or radian long: rotations must stay small.
    let mut shift = largest(&at.force) / 0.1;
    // Steps of 1e-13 m or rad move nothing.
    let most = 1e12 * shift;
    let mut tried = norm(&at.force);
    for step in 0..DESCENT_STEPS {
        // Newton's method is tried again when the force has fallen.
        if norm(&at.force) <= 0.03 * tried {
            tried = norm(&at.force);
            if let Some((place, true)) = newton(rest, at.place.clone(), None, Policy::NEAR) {
                return (DescentEnd::Equilibrium(place), step);
            }
        }
        rest.evaluate(&at.place.q);
        let factored = rest.factor(&at.place, shift);
        if rest.is_round_off(&at.place, &at.force) {
            return (DescentEnd::Equilibrium(at.place), step);
        }
        match if factored { advance(rest, &at, shift) } else { None } {
            Some((next, gain)) => {
                shift *= match gain {
                    // As in trust regions: the work over what K predicts.
                    gain if gain > 0.75 => 0.25,
                    gain if gain < 0.4 => 2.0,
                    _ => 1.0,
                };
                at = next;
            }
            None => shift *= 4.0,
        }
        if let Some(coordinate) = gone(&at.place.q, q) {
            return (DescentEnd::Away(coordinate), step);
        }
        if shift > most {
            break;
        }
    }
    (DescentEnd::Stuck(at.place), DESCENT_STEPS)
}

/// The coordinate farthest from the start, if its distance is beyond the limit.
pub(super) fn gone(now: &[f64], start: &[f64]) -> Option<usize> {
    let way = |i: usize| (now[i] - start[i]).abs();
    let farthest = (0..now.len()).max_by(|&i, &j| way(i).total_cmp(&way(j)))?;
    (way(farthest) > tolerances::AWAY * (1.0 + largest(start))).then_some(farthest)
}

/// One step with the present factors; `None` where it goes up or does not return to phi = 0.
fn advance(rest: &mut EquilibriumSystem, at: &Balance, shift: f64) -> Option<(Balance, f64)> {
    let change = rest.solve(&at.force)?;
    let size = norm(&change.q);
    let before = dot(&at.force, &change.q);
    // Work of a force along dq that decreases by K dq: force . dq - dq K dq / 2.
    let predicted = 0.5 * (before + shift * size * size);
    if !(before > 0.0 && predicted.is_finite()) {
        return None;
    }
    let mut next = onward(rest, &at.place, &change, size)?;
    let mut way = change.q;
    relax(rest, &mut next, &mut way, shift, norm(&at.force))?;
    let gain = 0.5 * (dot(&at.force, &way) + dot(&next.force, &way)) / predicted;
    (gain > tolerances::SUFFICIENT_STEP).then_some((next, gain))
}

/// The place after a change, returned to phi = 0 and balanced.
fn onward(
    rest: &mut EquilibriumSystem,
    from: &EquilibriumPoint,
    change: &EquilibriumChange,
    size: f64,
) -> Option<Balance> {
    let there = rest.moved(from, change, 1.0);
    let q = close(rest, there, size)?;
    rest.balance(&q)
}

/// Iterates force = dq/dtau until the residual is at most the force before the step: a stiff beam that rotates moves
/// on a circle, and one iteration moves along the tangent, which stretches it.
fn relax(rest: &mut EquilibriumSystem, at: &mut Balance, way: &mut [f64], shift: f64, enough: f64) -> Option<()> {
    let mut last = f64::INFINITY;
    // Further iterations at the same shift.
    for _ in 0..6 {
        let left: Vec<f64> = at.force.iter().zip(&*way).map(|(force, way)| force - shift * way).collect();
        let size = norm(&left);
        if size <= enough {
            return Some(());
        }
        if size >= last {
            return None;
        }
        last = size;
        rest.factor(&at.place, shift);
        let change = rest.solve(&left)?;
        way.iter_mut().zip(&change.q).for_each(|(way, dq)| *way += dq);
        *at = onward(rest, &at.place, &change, norm(way))?;
    }
    None
}

/// Returns to phi = 0 by least changes; `None` where these together exceed half the step.
fn close(rest: &mut EquilibriumSystem, place: EquilibriumPoint, size: f64) -> Option<Vec<f64>> {
    let mut at = place;
    let mut way = 0.0;
    let mut is_evaluated = false;
    let closed: Result<bool, ()> = Monitor::default().solve(CLOSING, |_| {
        if std::mem::replace(&mut is_evaluated, true) {
            let change = rest.closing().ok_or(())?;
            way += norm(&change.q);
            at = rest.moved(&at, &change, 1.0);
        }
        rest.evaluate(&at.q);
        if way > 0.5 * size { Err(()) } else { Ok(rest.gap()) }
    });
    (closed == Ok(true)).then_some(at.q)
}
