//! Backward differentiation formulas.

use super::diffsol_backend::{self, Newton, Traits, serve, start_state};
use super::{Entry, Integrator, Setup, Steps, Tightening, refuses};
use crate::error::Result;

/// ```text
/// sum_{j=1..k} (1/j) nabla^j x_1 - kappa_k gamma_k (x_1 - x_0) = h F(t_1, x_1),   gamma_k = sum_{j=1..k} 1/j
/// ```
///
/// with backward differences nabla^j and the prediction x_0 from the last k steps: the NDF of order k = 1 to 5, k and h
/// chosen by the error. Source: Shampine, Reichelt, SIAM J. Sci. Comput. 18 (1997) 1-22; by diffsol. Order in q, v and
/// lambda: 5 where tolerances are tight. With `ggl` phi and G v + phi_t vanish to the tolerance of Newton's iteration,
/// a hundredth of the error tolerance, and the motion is one or two digits better than with `index1`.
///
/// For smooth stiff motions: two or three evaluations a step, and about every tenth step a dense matrix (n_q + n_v
/// unknowns, with `ggl` 2 (n_v + n_c) more: hundreds at most) from exact K, C, G and L. It allocates. Orders 3 to 5 are
/// not stable for fast undamped oscillations, which are then followed in tiny steps: use `esdirk34` or
/// `generalized_alpha` there. Projections are refused: after a projection the past states do not fit, and the order
/// would fall to 1 at every step. Interpolation by the polynomial of the step.
pub const ENTRY: Entry = Entry {
    name: "bdf",
    about: "implicit, order 1 to 5 by itself, for stiff motions that are smooth; chooses its steps",
    order: 5,
    steps: Steps::Own,
    // At order 5, which tight tolerances select; errors over a motion were 7 rtol^(5/6) in the median of the scenes.
    tightening: Tightening { factor: 0.1, power: 1.2 },
    solves: diffsol_backend::solves,
    refuses: refuses::all,
    options: &[],
    make,
};

fn make<'s>(setup: &Setup<'s>) -> Result<Box<dyn Integrator + 's>> {
    // A run starts with order 1, whose error is O(h^2): the power of h by which the first step is chosen.
    let traits = Traits { order: 2, follows: false };
    diffsol_backend::make(setup, traits, |problem, exchange| {
        Box::pin(async move { serve(problem.bdf_solver::<Newton>(start_state(&exchange)), &exchange).await })
    })
}
