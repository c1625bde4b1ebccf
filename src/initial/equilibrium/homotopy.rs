//! Load stepping from the start to an equilibrium.

use super::newton::{Policy, newton};
use super::system::{EquilibriumPoint, EquilibriumSystem};
use crate::initial::continuation;
use crate::tolerances;

/// f - G^T lambda = (1 - s) (f - G^T lambda)(start), s from 0 to 1: the residual force of the start is removed in
/// parts, each solved by Newton's method from the solution before. Where the start is an unloaded equilibrium this is
/// load stepping. Returns the place reached, its s, and the number of steps.
pub(super) fn homotopy(rest: &mut EquilibriumSystem, start: &EquilibriumPoint) -> (EquilibriumPoint, f64, usize) {
    rest.evaluate(&start.q);
    let missing = rest.force(&start.lambda);
    let mut at = start.clone();
    let mut steps = 0;
    let (s, _) = continuation(0.0, 1.0, 0.1, tolerances::LEAST_PART, |next| {
        let goal: Vec<f64> = missing.iter().map(|force| (1.0 - next) * force).collect();
        let (place, contracts) = newton(rest, at.clone(), Some(&goal), Policy::NEAR)?;
        at = place;
        steps += 1;
        Some(if contracts { 2.0 } else { 1.0 })
    });
    (at, s, steps)
}
