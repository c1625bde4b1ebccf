//! Index 3: the position constraint itself.

use super::index1::Index1;
use super::{Entry, Rows};

/// ```text
/// q' = N v,   M v' + G^T lambda = f,   phi = 0
/// ```
///
/// For integrators that discretize the constraint itself: it holds at every step to round-off. No vector field is
/// integrated; the one made here observes: v' and lambda are those of the equations of motion at (q, v), and so of the
/// order of q and v.
pub const ENTRY: Entry = Entry {
    name: "index3",
    about: "phi = 0 itself, for integrators that solve it",
    options: &[],
    rows: Some(Rows::Position),
    make: |_, _| Ok(Box::new(Index1::default())),
};
