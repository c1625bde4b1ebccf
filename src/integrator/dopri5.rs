//! Dormand and Prince's method of order 5(4).

use super::explicit::{ErrorEstimate, Explicit, Tableau};
use super::{Control, IntegratorEntry, Steps, Tightening};

/// Source: Dormand, Prince, J. Comput. Appl. Math. 6 (1980) 19-26; interpolation of order 4 as in Hairer's
/// DOPRI5. Order 5 in q and v (and lambda); six evaluations a step, and one more after a projection, which
/// moves the state at which the last stage was evaluated.
pub const ENTRY: IntegratorEntry = IntegratorEntry {
    steps: Steps::Either,
    // Errors over a motion were 5 to 20 times rtol, and 40 in long ones.
    tightening: Tightening::new(0.1, 1.0),
    stability: Some(|| TABLEAU.stability()),
    ..IntegratorEntry::new(
        "dopri5",
        "Dormand-Prince 5(4), 6 or (projected) 7 evaluations a step, adaptive",
        5,
        |setup| Ok(Box::new(Explicit::new(&TABLEAU, setup.len()))),
    )
};

#[rustfmt::skip]
pub(super) static TABLEAU: Tableau = Tableau {
    order: 5,
    c: &[0.0, 0.2, 0.3, 0.8, 8.0 / 9.0, 1.0, 1.0],
    a: &[
        &[],
        &[0.2],
        &[3.0 / 40.0, 9.0 / 40.0],
        &[44.0 / 45.0, -56.0 / 15.0, 32.0 / 9.0],
        &[19372.0 / 6561.0, -25360.0 / 2187.0, 64448.0 / 6561.0, -212.0 / 729.0],
        &[9017.0 / 3168.0, -355.0 / 33.0, 46732.0 / 5247.0, 49.0 / 176.0, -5103.0 / 18656.0],
        &[35.0 / 384.0, 0.0, 500.0 / 1113.0, 125.0 / 192.0, -2187.0 / 6784.0, 11.0 / 84.0],
    ],
    b: &[35.0 / 384.0, 0.0, 500.0 / 1113.0, 125.0 / 192.0, -2187.0 / 6784.0, 11.0 / 84.0],
    error: ErrorEstimate::Embedded(&[
        71.0 / 57600.0, 0.0, -71.0 / 16695.0, 71.0 / 1920.0, -17253.0 / 339200.0, 22.0 / 525.0, -1.0 / 40.0,
    ]),
    dense: &[&[
        -12715105075.0 / 11282082432.0, 0.0, 87487479700.0 / 32700410799.0, -10690763975.0 / 1880347072.0,
        701980252875.0 / 199316789632.0, -1453857185.0 / 822651844.0, 69997945.0 / 29380423.0,
    ]],
    control: || Control::new(5.0, 0.2, 10.0),
};
