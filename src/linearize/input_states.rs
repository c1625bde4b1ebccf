//! The states that displacements of drivers and roads add to a linear model.

use super::Matrix;

/// Columns of the states of the inputs: u ... u^(r-1) of each input whose derivative u^(r) is in the equations.
#[derive(Clone, Debug)]
pub struct InputStates {
    /// r of each input.
    pub orders: Vec<usize>,
    /// Columns of A, n_x rows.
    pub a: Matrix,
    /// Columns of C, n_y rows.
    pub c: Matrix,
}

impl InputStates {
    /// Names of the states of the inputs, `road`, `road'`.
    pub(super) fn states(&self, inputs: &[String]) -> Vec<String> {
        inputs.iter().zip(&self.orders).flat_map(|(name, &order)| (0..order).map(|i| primed(name, i))).collect()
    }
}

/// Returns the name of a derivative: `road''` for the second.
pub(super) fn primed(name: &str, order: usize) -> String {
    format!("{name}{}", "'".repeat(order))
}
