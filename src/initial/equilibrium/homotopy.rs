//! Load stepping from the start to an equilibrium.

use super::newton::{Policy, newton};
use super::system::{EquilibriumSystem, Place};
use crate::tolerances::initial as tolerances;

/// f - G^T lambda = (1 - s) (f - G^T lambda)(start), s from 0 to 1: the residual force of the start is removed in
/// parts, each solved by Newton's method from the solution before. Where the start is an unloaded equilibrium this is
/// load stepping. Returns the place reached, its s, and the number of steps.
pub(super) fn homotopy(rest: &mut EquilibriumSystem, start: &Place) -> (Place, f64, usize) {
    rest.evaluate(&start.q);
    let missing = rest.force(&start.lambda);
    let mut at = start.clone();
    let mut s = 0.0;
    let mut part = tolerances::LOAD_FIRST;
    let mut steps = 0;
    for _ in 0..tolerances::LOAD_CHANGES {
        let next: f64 = if s + part > 1.0 - tolerances::LOAD_SMALLEST { 1.0 } else { s + part };
        let goal: Vec<f64> = missing.iter().map(|force| (1.0 - next) * force).collect();
        match newton(rest, at.clone(), Some(&goal), Policy::NEAR) {
            Some((place, contracts)) => {
                (at, s, steps) = (place, next, steps + 1);
                part *= if contracts { 2.0 } else { 1.0 };
            }
            None => part *= 0.25,
        }
        if s == 1.0 {
            return (at, s, steps);
        }
        if part < tolerances::LOAD_SMALLEST {
            break;
        }
    }
    (at, s, steps)
}
