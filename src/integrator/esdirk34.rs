//! A singly diagonally implicit Runge-Kutta method of four stages, the first explicit.

use super::esdirk::{Esdirk, Tableau};
use super::{Entry, Integrator, Setup, Steps, Tightening, refuses, stage};
use crate::error::Result;

/// ```text
/// x'_i = F(t + c_i h, x + h sum_{j<=i} a_ij x'_j),   a_11 = 0, a_ii = 0.4358...,   x_1 = x + h sum b_j x'_j,  b = a_4
/// ```
///
/// Source: Jorgensen, Kristensen, Thomsen, arXiv:1803.01613 (2018), the error by an embedded method of order 4, damped
/// along stiff directions. Order 3 in q, v and lambda, L-stable and stiffly accurate: fast oscillations are damped out,
/// whatever the tolerance, and `ggl` satisfies its constraints at every step. Three stages of two or three evaluations
/// a step, all with one matrix (n_v + n_c unknowns, dense or sparse, from exact K, C, G and L), which is kept while
/// Newton's method converges. Projections cost it nothing. Cubic Hermite interpolation.
pub const ENTRY: Entry = Entry {
    name: "esdirk34",
    about: "implicit, L-stable, for stiff motions, also those that nothing damps",
    order: 3,
    steps: Steps::Either,
    // Errors over a motion were 5 rtol^(3/4).
    tightening: Tightening { factor: 0.1, power: 4.0 / 3.0 },
    solves: stage::solves,
    refuses: refuses::none,
    options: &[],
    make,
};

const GAMMA: f64 = 0.435_866_521_508_459;

static TABLEAU: Tableau = Tableau {
    order: 3,
    estimate: 4.0,
    c: &[0.0, 2.0 * GAMMA, 0.468_238_744_851_844_4, 1.0],
    a: &[
        &[0.0],
        &[GAMMA, GAMMA],
        &[0.140_737_774_724_706_2, -0.108_365_551_381_320_8, GAMMA],
        &[0.102_399_400_619_911, -0.376_878_452_255_556_1, 0.838_612_530_127_186_1, GAMMA],
    ],
    error: &[-0.054_625_497_240_413_94, -0.494_208_893_625_994_96, 0.221_934_499_735_064_66, 0.326_899_891_131_344_27],
};

fn make<'s>(setup: &Setup<'s>) -> Result<Box<dyn Integrator + 's>> {
    Ok(Box::new(Esdirk::new(&TABLEAU, setup)?))
}
