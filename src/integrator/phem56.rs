//! Murua's partitioned half-explicit method of order 5.

use super::dopri5;
use super::half_explicit::{HalfExplicit, Tableau};
use super::{Control, IntegratorEntry, Steps, Tightening, takes};

/// Source: Murua, BIT 37 (1997) 641-662 (PHEM56): the stages of DOPRI5, each with a constraint of its own. Order 5 in
/// q, v and lambda; six solutions a step: the first stage, which is also the end of the step before, uses the
/// accelerations of the equations of motion where Murua's seventh row approximates them (lambda is evaluated there
/// anyway). One more evaluation after a projection that moves the state. Interpolation of order 4, with an evaluation
/// of its own.
pub const ENTRY: IntegratorEntry = IntegratorEntry {
    steps: Steps::Either,
    // Errors over a motion were 3 rtol^0.9, and 30 in long ones.
    tightening: Tightening::new(0.06, 1.1),
    solves: takes::velocity_rows,
    stability: Some(|| TABLEAU.stability()),
    ..IntegratorEntry::new("phem56", "half-explicit, 6 or (projected) 7 solutions a step, adaptive", 5, |setup| {
        Ok(Box::new(HalfExplicit::new(&TABLEAU, setup)?))
    })
};

static TABLEAU: Tableau = Tableau {
    order: 5,
    explicit: Some(&dopri5::TABLEAU),
    constraint: &[
        // The first stage is given.
        &[],
        &[3.0 / 40.0, 9.0 / 40.0],
        &[21.0 / 256.0, 45.0 / 256.0, 15.0 / 128.0],
        &[19235.0 / 98784.0, -225.0 / 392.0, 6235.0 / 6174.0, 2755.0 / 32928.0],
        &[-293.0 / 1152.0, 85.0 / 48.0, -2275.0 / 1908.0, 35.0 / 32.0, -2835.0 / 6784.0],
        &[35.0 / 384.0, 0.0, 500.0 / 1113.0, 125.0 / 192.0, -2187.0 / 6784.0, 11.0 / 84.0],
    ],
    nodes: &[0.0, 3.0 / 10.0, 3.0 / 8.0, 5.0 / 7.0, 1.0, 1.0],
    control: || Control::new(5.0, 0.2, 10.0),
};
