//! The trapezoidal rule and BDF2 in one step.

use super::esdirk::{Esdirk, Tableau};
use super::{Entry, Integrator, Setup, Steps, Tightening, refuses, stage};
use crate::error::Result;
use std::f64::consts::SQRT_2;

/// ```text
/// x_g = x + g h/2 (x' + x'_g),   x_1 = x + h (w x' + w x'_g + g/2 x'_1),   g = 2 - sqrt 2,  w = sqrt 2/4
/// ```
///
/// with x' = F at t, t + g h and t + h. Source: Bank et al., IEEE Trans. CAD 4 (1985) 436-451; error estimate, damped
/// along stiff directions, of Hosea, Shampine, Appl. Numer. Math. 20 (1996) 21-37. Order 2 in q, v and lambda,
/// L-stable: infinitely fast oscillations vanish after one step. Two stages of two or three evaluations a step, both
/// with one matrix (n_v + n_c unknowns, dense or sparse, from exact K, C, G and L), which is kept while Newton's method
/// converges. For low accuracy in stiff or kinked motions: a digit more costs three times the steps. Projections cost
/// it nothing. Cubic Hermite interpolation.
pub const ENTRY: Entry = Entry {
    name: "tr_bdf2",
    about: "implicit, L-stable, for stiff motions at two or three digits",
    order: 2,
    steps: Steps::Either,
    // Errors over a motion were 1.5 to 3 rtol^(2/3).
    tightening: Tightening { factor: 0.25, power: 1.5 },
    solves: stage::solves,
    refuses: refuses::none,
    options: &[],
    make,
};

const GAMMA: f64 = 1.0 - 0.5 * SQRT_2;
const W: f64 = 0.25 * SQRT_2;

static TABLEAU: Tableau = Tableau {
    order: 2,
    estimate: 3.0,
    c: &[0.0, 2.0 * GAMMA, 1.0],
    a: &[&[0.0], &[GAMMA, GAMMA], &[W, W, GAMMA]],
    // Compared to (1 - w)/3, w + 1/3, g/6 of order 3.
    error: &[(4.0 * W - 1.0) / 3.0, -1.0 / 3.0, 2.0 / 3.0 * GAMMA],
};

fn make<'s>(setup: &Setup<'s>) -> Result<Box<dyn Integrator + 's>> {
    Ok(Box::new(Esdirk::new(&TABLEAU, setup)?))
}
