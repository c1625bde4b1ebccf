//! Index 2: the velocity constraint itself.

use super::index1::Index1;
use super::{Entry, Rows};

/// ```text
/// q' = N v,   M v' + G^T lambda = f,   G v + phi_t = 0
/// ```
///
/// For integrators that discretize the constraint itself: it holds at every step to round-off, while an error eps of
/// phi stays eps. No vector field is integrated; the one made here observes: v' and lambda are those of the equations
/// of motion at (q, v), and so of the order of q and v.
pub const ENTRY: Entry = Entry {
    name: "index2",
    about: "G v + phi_t = 0 itself, for integrators that solve it; phi drifts as h^p",
    options: &[],
    rows: Some(Rows::Velocity),
    make: |_, _| Ok(Box::new(Index1::default())),
};
