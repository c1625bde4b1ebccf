//! Index 3: the position constraint itself.

use super::{Dae, DaeRow, FormulationEntry};

/// ```text
/// q' = N v,   M v' + G^T lambda = f,   phi = 0
/// ```
///
/// For integrators that discretize the constraint itself: it is satisfied at every step to round-off.
pub const ENTRY: FormulationEntry = FormulationEntry {
    name: "index3",
    about: "phi = 0 itself, for integrators that solve it",
    options: &[],
    dae: Some(|_| Ok(Dae::with(DaeRow::POSITION))),
    field: None,
};
