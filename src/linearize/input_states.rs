//! The states that displacements of drivers and roads add to a linear model.

use super::Matrix;
use super::entry::Built;

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
    fn states(&self, inputs: &[String]) -> Vec<String> {
        inputs.iter().zip(&self.orders).flat_map(|(name, &order)| (0..order).map(|i| primed(name, i))).collect()
    }
}

/// Returns the name of a derivative: `road''` for the second.
fn primed(name: &str, order: usize) -> String {
    format!("{name}{}", "'".repeat(order))
}

/// Adds the states of the inputs to a model, as its last states, and renames its inputs to the derivatives that they are.
pub fn add(built: &mut Built, inputs: &mut [String]) {
    let InputStates { orders, a, c } = &built.input_states;
    let (own, added, n_u) = (built.a.nrows(), a.ncols(), orders.len());
    built.states.extend(built.input_states.states(inputs));
    inputs.iter_mut().zip(orders).for_each(|(name, &order)| *name = primed(name, order));
    if added == 0 {
        return;
    }
    let grow = |matrix: &Matrix, rows: usize, columns: usize| matrix.clone().resize(rows, columns, 0.0);
    let size = own + added;
    let mut whole = grow(&built.a, size, size);
    whole.view_mut((0, own), a.shape()).copy_from(a);
    let mut b = grow(&built.b, size, n_u);
    let mut place = own;
    for (j, &order) in orders.iter().enumerate().filter(|(_, order)| **order > 0) {
        (1..order).for_each(|i| whole[(place + i - 1, place + i)] = 1.0);
        place += order;
        b[(place - 1, j)] = 1.0;
    }
    let mut outputs = grow(&built.c, built.c.nrows(), size);
    outputs.view_mut((0, own), c.shape()).copy_from(c);
    if let Some(e) = &mut built.e {
        *e = grow(e, size, size);
        (own..size).for_each(|i| e[(i, i)] = 1.0);
    }
    (built.a, built.b, built.c) = (whole, b, outputs);
}
