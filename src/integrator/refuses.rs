//! Projections that cost a method an order.

use crate::formulation::Entry;

/// None.
pub(super) fn none(_: &Entry, _: &str) -> bool {
    false
}

/// Where phi = 0 alone determines v, `full` would share the error that is left of v out between v and q at every step.
pub(super) fn shared_error(formulation: &Entry, projection: &str) -> bool {
    projection == "full" && formulation.default_dae().is_some_and(|dae| dae.velocity_index() == 2)
}

/// All: a moved state has no past, so that a multistep method would start anew, at order 1.
pub(super) fn all(_: &Entry, projection: &str) -> bool {
    projection != "none"
}
