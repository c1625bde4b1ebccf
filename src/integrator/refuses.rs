//! Projections that cost a method an order.

use crate::formulation::FormulationEntry;

/// Refuses no projection.
pub(super) fn none(_: &FormulationEntry, _: &str) -> bool {
    false
}

/// Refuses `full` where phi = 0 alone determines v: it would distribute the error of v between v and q at every step.
pub(super) fn shared_error(formulation: &FormulationEntry, projection: &str) -> bool {
    projection == "full" && formulation.default_dae().is_some_and(|dae| dae.velocity_index() == 2)
}

/// Refuses all: a moved state has no past, so that a multistep method would restart at order 1.
pub(super) fn all(_: &FormulationEntry, projection: &str) -> bool {
    projection != "none"
}
