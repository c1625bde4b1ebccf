//! The classical Runge-Kutta method of order 4.

use super::explicit::{ErrorEstimate, Explicit, Tableau};
use super::{Control, Entry, Steps, Tightening, refuses, takes};

/// Kutta (1901). Order 4 in q and v (and lambda, which is computed from them); four evaluations a step; fixed steps.
pub const ENTRY: Entry = Entry {
    name: "rk4",
    about: "the classical method, 4 evaluations a step, fixed steps",
    order: 4,
    steps: Steps::Fixed,
    tightening: Tightening::NONE,
    solves: takes::vector_fields,
    refuses: refuses::none,
    options: &[],
    make: |setup| Ok(Box::new(Explicit::new(&TABLEAU, setup.len()))),
};

static TABLEAU: Tableau = Tableau {
    order: 4,
    c: &[0.0, 0.5, 0.5, 1.0],
    a: &[&[], &[0.5], &[0.0, 0.5], &[0.0, 0.0, 1.0]],
    b: &[1.0 / 6.0, 1.0 / 3.0, 1.0 / 3.0, 1.0 / 6.0],
    error: ErrorEstimate::None,
    dense: &[],
    control: || Control::new(4.0, 0.2, 5.0),
};
