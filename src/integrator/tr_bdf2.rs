//! The trapezoidal rule and BDF2 in one step.

use super::diffsol_backend::{self, Newton, Traits, serve, start_state};
use super::{Entry, Integrator, Setup, Steps, Tightening, refuses};
use crate::error::Result;

/// ```text
/// x_g = x + g h/2 (x' + x'_g),   x_1 = x + h (w x' + w x'_g + g/2 x'_1),   g = 2 - sqrt 2,  w = sqrt 2/4
/// ```
///
/// with x' = F at t, t + g h and t + h. Source: Bank et al., IEEE Trans. CAD 4 (1985) 436-451; error estimate of Hosea,
/// Shampine, Appl. Numer. Math. 20 (1996) 21-37; by diffsol. Order 2 in q, v and lambda, L-stable: infinitely fast
/// oscillations vanish after one step. Two stages of two or three evaluations a step, both with one dense matrix, which
/// serves about ten steps, from exact K, C, G and L, and one evaluation for the work. It allocates. For low accuracy in
/// stiff or kinked motions: a digit more costs three times the steps. Projections cost it nothing. Interpolation of
/// order 2.
pub const ENTRY: Entry = Entry {
    name: "tr_bdf2",
    about: "implicit, L-stable, for stiff motions at two or three digits; chooses its steps",
    order: 2,
    steps: Steps::Own,
    // Errors over a motion were 1.5 to 3 rtol^(2/3).
    tightening: Tightening { factor: 0.25, power: 1.5 },
    solves: diffsol_backend::solves,
    refuses: refuses::none,
    options: &[],
    make,
};

fn make<'s>(setup: &Setup<'s>) -> Result<Box<dyn Integrator + 's>> {
    let traits = Traits { order: ENTRY.order, follows: true };
    diffsol_backend::make(setup, traits, |problem, exchange| {
        Box::pin(async move { serve(problem.tr_bdf2_solver::<Newton>(start_state(&exchange)), &exchange).await })
    })
}
