//! Heun's method of order 2.

use super::explicit::{ErrorEstimate, Explicit, Tableau};
use super::{Control, IntegratorEntry};

/// Explicit trapezoidal rule: k2 = F(t + h, y + h k1), y_1 = y + h (k1 + k2)/2. Order 2 in q, v (and lambda, which is
/// computed from them); two evaluations a step; fixed steps.
pub const ENTRY: IntegratorEntry = IntegratorEntry {
    stability: Some(|| TABLEAU.stability()),
    ..IntegratorEntry::new("heun", "explicit trapezoidal rule, 2 evaluations a step, fixed steps", 2, |setup| {
        Ok(Box::new(Explicit::new(&TABLEAU, setup.len())))
    })
};

static TABLEAU: Tableau = Tableau {
    order: 2,
    c: &[0.0, 1.0],
    a: &[&[], &[1.0]],
    b: &[0.5, 0.5],
    error: ErrorEstimate::None,
    dense: &[],
    control: || Control::new(2.0, 0.2, 5.0),
};
