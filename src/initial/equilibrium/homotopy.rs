//! The load grown in steps.

use super::newton::{Policy, newton};
use super::rest::{Place, Rest};

/// First part of the load, the smallest, and how often it may change.
const FIRST: f64 = 0.1;
const SMALLEST: f64 = 1e-4;
const MOST: usize = 400;

/// f - G^T lambda = (1 - s) (f - G^T lambda)(start), s from 0 to 1: the force that is missing at the start is taken away
/// in parts, each solved by Newton's method from the solution before. Where the start is an unloaded equilibrium that is
/// load stepping. The place that it came to, the part s of the
/// way that this is, and the steps taken.
pub(super) fn homotopy(rest: &mut Rest, start: &Place) -> (Place, f64, usize) {
    rest.evaluate(&start.q);
    let missing = rest.force(&start.lambda);
    let (mut at, mut s, mut part, mut steps) = (start.clone(), 0.0, FIRST, 0);
    for _ in 0..MOST {
        let next: f64 = if s + part > 1.0 - SMALLEST { 1.0 } else { s + part };
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
        if part < SMALLEST {
            break;
        }
    }
    (at, s, steps)
}
