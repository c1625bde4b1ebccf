//! Stabilized index 1: constraints of all three levels together.

use super::{Dae, DaeRow, FormulationEntry};

/// ```text
/// q' = N (v + u),   M u + G^T mu = 0,    v' = a + w,   M w + G^T eta = 0,    M a + G^T lambda = f
/// phi = 0,   G v + phi_t = 0,   G a - gamma = 0
/// ```
///
/// The equations of Gear, Gupta and Leimkuhler extended to the accelerations: Fuehrer, Leimkuhler, Numer. Math. 59
/// (1991) 55-69. mu = eta = 0 for the exact motion. lambda belongs to a, and so is free of the discretization error
/// along the constraints; the largest of the systems. All three levels are satisfied at every step to the tolerance of
/// the iteration.
pub const ENTRY: FormulationEntry = FormulationEntry {
    name: "stabilized_index1",
    about: "phi = 0, G v + phi_t = 0 and phi'' = 0 together, for integrators that solve all three",
    options: &[],
    dae: Some(|_| Ok(Dae { lambda: DaeRow::ACCELERATION, eta: Some(DaeRow::VELOCITY), mu: Some(DaeRow::POSITION) })),
    field: None,
};
