//! A singly diagonally implicit Runge-Kutta method of four stages, the first explicit.

use super::diffsol_backend::{self, Newton, Traits, serve, start_state};
use super::{Entry, Integrator, Setup, Steps, Tightening, refuses};
use crate::error::Result;

/// ```text
/// x'_i = F(t + c_i h, x + h sum_{j<=i} a_ij x'_j),   a_11 = 0, a_ii = 0.4358...,   x_1 = x + h sum b_j x'_j,  b = a_4
/// ```
///
/// Source: Jorgensen, Kristensen, Thomsen, arXiv:1803.01613 (2018), the error by an embedded method of order 4; by
/// diffsol. Order 3 in q, v and lambda, L-stable and stiffly accurate: fast oscillations are damped out, whatever the
/// tolerance, and `ggl` satisfies its constraints at every step. Three stages of three or four evaluations a step, all
/// with one dense matrix, which serves about ten steps, from exact K, C, G and L, and one evaluation for the work. It
/// allocates. Projections cost it nothing. Cubic Hermite interpolation.
pub const ENTRY: Entry = Entry {
    name: "esdirk34",
    about: "implicit, L-stable, for stiff motions, also those that nothing damps; chooses its steps",
    order: 3,
    steps: Steps::Own,
    // Errors over a motion were 5 rtol^(3/4).
    tightening: Tightening { factor: 0.1, power: 4.0 / 3.0 },
    solves: diffsol_backend::solves,
    refuses: refuses::none,
    options: &[],
    make,
};

fn make<'s>(setup: &Setup<'s>) -> Result<Box<dyn Integrator + 's>> {
    let traits = Traits { order: ENTRY.order, follows: true };
    diffsol_backend::make(setup, traits, |problem, exchange| {
        Box::pin(async move { serve(problem.esdirk34_solver::<Newton>(start_state(&exchange)), &exchange).await })
    })
}
