//! Dormand and Prince's method of order 8(5,3).

use super::dop853_tableau::{A, B, C, D, E3, E5};
use super::explicit::{ErrorEstimate, Explicit, Tableau};
use super::{Control, IntegratorEntry, Steps, Tightening};

/// Source: Hairer, Norsett, Wanner, Solving Ordinary Differential Equations I, II.5 (code DOP853); interpolation of
/// order 7. Order 8 in q and v (and lambda); twelve evaluations a step, three more where output rows are in the step.
pub const ENTRY: IntegratorEntry = IntegratorEntry {
    steps: Steps::Either,
    // Errors over a motion were 3 times rtol, and 10 to 20 in long ones.
    tightening: Tightening::new(0.2, 1.0),
    stability: Some(|| TABLEAU.stability()),
    ..IntegratorEntry::new(
        "dop853",
        "Dormand-Prince 8(5,3), 12 evaluations a step, adaptive; the choice for high accuracy",
        8,
        |setup| Ok(Box::new(Explicit::new(&TABLEAU, setup.len()))),
    )
};

static TABLEAU: Tableau = Tableau {
    order: 8,
    c: &C,
    a: &A,
    b: &B,
    error: ErrorEstimate::Pair { fifth: &E5, third: &E3 },
    dense: &[&D[0], &D[1], &D[2], &D[3]],
    control: || Control::new(8.0, 0.333, 6.0),
};
