//! Index 2: the velocity constraint itself.

use super::{Dae, DaeRow, FormulationEntry};

/// ```text
/// q' = N v,   M v' + G^T lambda = f,   G v + phi_t = 0
/// ```
///
/// For integrators that discretize the constraint itself: it is satisfied at every step to round-off, while an error
/// eps of phi stays eps.
pub const ENTRY: FormulationEntry = FormulationEntry {
    name: "index2",
    about: "G v + phi_t = 0 itself, for integrators that solve it; phi drifts as h^p",
    options: &[],
    dae: Some(|_| Ok(Dae::with(DaeRow::VELOCITY))),
    field: None,
};
