//! Brasey and Hairer's half-explicit methods.

use super::half_explicit::{HalfExplicit, Tableau};
use super::{Control, IntegratorEntry, takes};

/// Source: Brasey, Hairer, SIAM J. Numer. Anal. 30 (1993) 538-552. Order 3 in q, v and lambda; three solutions a step
/// and one for v' and lambda of the output; fixed steps; interpolation of order 3.
pub const HEM3: IntegratorEntry = IntegratorEntry {
    solves: takes::velocity_rows,
    stability: Some(|| THIRD.stability()),
    ..IntegratorEntry::new("hem3", "half-explicit, 3 stages, fixed steps", 3, |setup| {
        Ok(Box::new(HalfExplicit::new(&THIRD, setup)?))
    })
};

/// Source: as [`HEM3`]. Order 4 in q, v and lambda; five solutions a step and one for the output; fixed steps.
pub const HEM4: IntegratorEntry = IntegratorEntry {
    solves: takes::velocity_rows,
    stability: Some(|| FOURTH.stability()),
    ..IntegratorEntry::new("hem4", "half-explicit, 5 stages, fixed steps", 4, |setup| {
        Ok(Box::new(HalfExplicit::new(&FOURTH, setup)?))
    })
};

/// Source: Brasey, Computing 48 (1992) 191-201 (HEM5). Order 5 in q, v and lambda; eight solutions a step and one
/// for the output; fixed steps; interpolation of order 4 with an evaluation of its own.
pub const HEM5: IntegratorEntry = IntegratorEntry {
    solves: takes::velocity_rows,
    stability: Some(|| FIFTH.stability()),
    ..IntegratorEntry::new("hem5", "half-explicit, 8 stages, fixed steps", 5, |setup| {
        Ok(Box::new(HalfExplicit::new(&FIFTH, setup)?))
    })
};

static THIRD: Tableau = Tableau {
    order: 3,
    explicit: None,
    constraint: &[&[1.0 / 3.0], &[-1.0, 2.0], &[0.0, 0.75, 0.25]],
    nodes: &[1.0 / 3.0, 1.0, 1.0],
    control: || Control::new(3.0, 0.2, 5.0),
};

/// sqrt 6
const R: f64 = 2.449489742783178;

static FOURTH: Tableau = Tableau {
    order: 4,
    explicit: None,
    constraint: &[
        &[0.3],
        &[(1.0 + R) / 30.0, (11.0 - 4.0 * R) / 30.0],
        &[(-79.0 - 31.0 * R) / 150.0, (-1.0 - 4.0 * R) / 30.0, (24.0 + 11.0 * R) / 25.0],
        &[(14.0 + 5.0 * R) / 6.0, (-8.0 + 7.0 * R) / 6.0, (-9.0 - 7.0 * R) / 4.0, (9.0 - R) / 4.0],
        &[0.0, 0.0, (16.0 - R) / 36.0, (16.0 + R) / 36.0, 1.0 / 9.0],
    ],
    nodes: &[0.3, (4.0 - R) / 10.0, (4.0 + R) / 10.0, 1.0, 1.0],
    control: || Control::new(4.0, 0.2, 5.0),
};

#[rustfmt::skip]
static FIFTH: Tableau = Tableau {
    order: 5,
    explicit: None,
    constraint: &[
        &[0.1],
        &[0.0375, 0.1125],
        &[0.3222169236216038, -1.188883322987607, 1.228145134023366],
        &[-0.03501123898129943, 0.3725420601086163, -0.2721053535582034, 0.01993037578575077],
        &[-0.5576547055042005, 1.367307289645883, -1.732236360460725, 0.4587772007467548, 0.963806575572288],
        &[
            0.08654517193566155, -0.08810082847945416, 0.1981275547329404, -0.4645422679331083, 0.1615170091109488,
            0.906453360633012,
        ],
        &[0.0, 0.0, 0.0, 3.624477248753816, -0.4617724189181256, -3.198024628164272, 1.03531979832874],
        &[
            0.0, 0.0, 0.0, 0.2467760667636791, 0.2106594087489728, 0.1769218149125021, 0.3064446444147922,
            0.05919806516005373,
        ],
    ],
    nodes: &[0.1, 0.15, 0.3614787346573635, 0.08535584335486351, 0.5, 0.8, 1.0, 1.0],
    control: || Control::new(5.0, 0.2, 5.0),
};
