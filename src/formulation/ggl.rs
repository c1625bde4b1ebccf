//! Gear, Gupta, Leimkuhler: position and velocity constraints together.

use super::{Dae, DaeRow, FormulationEntry};

/// ```text
/// q' = N (v + u),   M u + G^T mu = 0,   M v' + G^T lambda = f,   phi = 0,   G v + phi_t = 0
/// ```
///
/// Source: Gear, Gupta, Leimkuhler, J. Comput. Appl. Math. 12 (1985) 77-90, with G^T mu weighted by M^-1 so that unlike
/// units are not added; radau_iia uses M + S there, with S = h^2 K_ii for stiff coordinates. mu = 0 for the exact
/// motion. Index 2, for integrators that solve it: both constraints are satisfied at every step to the tolerance of the
/// iteration, and in output rows between steps to round-off, by a projection.
pub const ENTRY: FormulationEntry = FormulationEntry {
    name: "ggl",
    about: "phi = 0 and G v + phi_t = 0 together, stabilized index 2, for integrators that solve both",
    options: &[],
    dae: Some(|_| Ok(Dae { mu: Some(DaeRow::POSITION), ..Dae::with(DaeRow::VELOCITY) })),
    field: None,
};
