//! Gear, Gupta, Leimkuhler: position and velocity constraints together.

use super::index1::Index1;
use super::{Entry, Rows};

/// ```text
/// M (q' - N v) + G^T mu = 0,   M v' + G^T lambda = f,   phi = 0,   G v + phi_t = 0
/// ```
///
/// with the rate of q along the directions of v in the first line. Source: Gear, Gupta, Leimkuhler, J. Comput. Appl.
/// Math. 12 (1985) 77-90, with G^T mu weighted by M^-1 so that unlike units do not meet. mu = 0 for the exact motion.
/// Index 2, for integrators that solve it: both constraints hold at every step as far as their iteration goes, and in rows
/// between steps to round-off, by a projection. Redundant constraints are refused. No vector field is integrated; the one
/// made here observes: v' and lambda are those of the equations of motion at (q, v), and so of the order of q and v.
pub const ENTRY: Entry = Entry {
    name: "ggl",
    about: "phi = 0 and G v + phi_t = 0 together, stabilized index 2, for integrators that solve both",
    options: &[],
    rows: Some(Rows::PositionAndVelocity),
    make: |_, _| Ok(Box::new(Index1::default())),
};
