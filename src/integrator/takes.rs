//! The formulations that a family of methods integrates.

use crate::formulation::{Dae, DaeRow, FormulationEntry};

/// Vector fields, for explicit methods.
pub(super) fn vector_fields(formulation: &FormulationEntry) -> bool {
    formulation.field.is_some()
}

/// phi = 0 alone.
pub(super) fn position_rows(formulation: &FormulationEntry) -> bool {
    formulation.default_dae() == Some(Dae::with(DaeRow::POSITION))
}

/// phi' = 0 alone, for half-explicit methods.
pub(super) fn velocity_rows(formulation: &FormulationEntry) -> bool {
    formulation.default_dae() == Some(Dae::with(DaeRow::VELOCITY))
}

/// All formulations that enforce phi = 0.
pub(super) fn positions(formulation: &FormulationEntry) -> bool {
    formulation.default_dae().is_some_and(|dae| dae.holds(0))
}

/// Rows in which lambda follows from accelerations, or q is moved to phi = 0 by multipliers of its own: with phi' = 0 or
/// phi = 0 alone, multistep and diagonally implicit methods lose orders.
pub(super) fn accelerations_or_positions(formulation: &FormulationEntry) -> bool {
    formulation.default_dae().is_some_and(|dae| dae.holds(2) || dae.mu.is_some())
}
