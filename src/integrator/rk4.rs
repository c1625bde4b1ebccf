//! The classical Runge-Kutta method of order 4.

use super::explicit::{ErrorEstimate, Explicit, Tableau};
use super::{Control, IntegratorEntry};

/// Kutta (1901). Order 4 in q and v (and lambda, which is computed from them); four evaluations a step; fixed steps.
pub const ENTRY: IntegratorEntry = IntegratorEntry {
    stability: Some(|| TABLEAU.stability()),
    ..IntegratorEntry::new("rk4", "the classical method, 4 evaluations a step, fixed steps", 4, |setup| {
        Ok(Box::new(Explicit::new(&TABLEAU, setup.len())))
    })
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
