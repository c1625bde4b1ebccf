//! Baumgarte stabilization.

use super::index1::{Index1, RANK, rank_tolerance};
use super::{Dae, DaeRow, FormulationEntry};
use crate::error::Result;
use crate::method_spec::{MethodSpec, OptionDoc};

/// ```text
/// phi'' + 2 alpha phi' + beta^2 phi = 0
/// ```
///
/// Source: Baumgarte, Comput. Methods Appl. Mech. Eng. 1 (1972) 1-16. Critically damped for alpha = beta. Small gains
/// do not bound the drift, large ones make the equations stiff (explicit methods need 2 alpha h and beta h of order
/// one), and the best gains depend on the step and the method. Order in q, v, lambda: that of the integrator; cost as
/// index 1.
pub const ENTRY: FormulationEntry = FormulationEntry {
    name: "baumgarte",
    about: "phi'' + 2 alpha phi' + beta^2 phi = 0; the best gains depend on the step",
    options: &[
        OptionDoc { name: "alpha", about: "damping of phi, 1/s (default 5)" },
        OptionDoc { name: "beta", about: "frequency of phi, 1/s (default alpha)" },
        RANK,
    ],
    dae: Some(|spec| Ok(Dae::with(row(spec)?))),
    field: Some(|spec, _| Ok(Box::new(Index1 { row: row(spec)?, rank_tolerance: rank_tolerance(spec)? }))),
};

fn row(spec: &MethodSpec) -> Result<DaeRow> {
    let alpha = spec.not_negative("alpha", 5.0)?;
    let beta = spec.not_negative("beta", alpha)?;
    Ok(DaeRow { position: beta * beta, velocity: 2.0 * alpha, acceleration: 1.0 })
}
