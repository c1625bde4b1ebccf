//! Small changes of the state together with those of the inputs.

use super::excited::Excited;
use super::{Changes, Matrix, Variation};
use crate::formulation::DaeRow;

/// Changes of the state, of u and of its derivatives, one column each: first those of the state alone, then a unit of
/// each state of the inputs, then a unit of each input of the model. The states of an input whose derivative u^(r) is
/// in the equations are u ... u^(r-1), and u^(r) is the input of the model.
pub struct Perturbation {
    /// dq and dv.
    pub changes: Changes,
    /// du, du' and du'', n_u rows.
    pub u: [Matrix; 3],
    /// Forces of u and u', n_v rows.
    force: Matrix,
    /// u, u' and u'' of the prescribed rows, n_c rows.
    rows: [Matrix; 3],
    /// Numbers of states and of states of inputs.
    counts: [usize; 2],
}

/// A matrix cut into the columns of the state, of the states of inputs, and of inputs.
pub struct ColumnBlocks {
    pub state: Matrix,
    pub input_states: Matrix,
    pub inputs: Matrix,
}

impl Perturbation {
    /// Changes of the state, followed by those of the inputs. A unit of state i of input j goes with the change
    /// `along(i, j)` of the state, where there is one.
    pub fn new(
        variation: &mut Variation,
        state: &Changes,
        along: impl Fn(usize, usize) -> Option<[Matrix; 2]>,
    ) -> Self {
        let Excited { orders, forces, rows } = variation.excited();
        let n_u = orders.len();
        let state_count = state.q.ncols();
        let states: Vec<(usize, usize)> =
            orders.iter().enumerate().flat_map(|(j, &order)| (0..order).map(move |i| (i, j))).collect();
        let added = states.len() + n_u;
        let columns = state_count + added;
        let zeros = Matrix::zeros(n_u, columns);
        let mut u = [zeros.clone(), zeros.clone(), zeros];
        let mut changes = state.clone();
        changes.q = changes.q.resize_horizontally(columns, 0.0);
        changes.v = changes.v.resize_horizontally(columns, 0.0);
        for (k, &(i, j)) in states.iter().enumerate() {
            let column = state_count + k;
            u[i][(j, column)] = 1.0;
            if let Some([dq, dv]) = along(i, j) {
                changes.q.column_mut(column).copy_from(&dq);
                changes.v.column_mut(column).copy_from(&dv);
            }
        }
        for (j, &order) in orders.iter().enumerate() {
            u[order][(j, state_count + states.len() + j)] = 1.0;
        }
        let force = &forces[0] * &u[0] + &forces[1] * &u[1];
        let rows = [&rows * &u[0], &rows * &u[1], &rows * &u[2]];
        Perturbation { changes, u, force, rows, counts: [state_count, states.len()] }
    }

    /// -K dq - C dv and the forces of the inputs, a column each.
    pub fn force(&self, variation: &Variation) -> Matrix {
        variation.force(&self.changes) + &self.force
    }

    /// G dv' for phi'' + c1 phi' + c0 phi = 0, where the inputs are part of phi, a column each.
    pub fn rows(&self, variation: &Variation, c: [f64; 2]) -> Matrix {
        let [c1, c0] = c;
        let [u, rate, acceleration] = &self.rows;
        variation.rows(&self.changes, c) + acceleration + rate * c1 + u * c0
    }

    /// dphi and dphi' of the changes, a column each.
    pub fn residuals(&self, variation: &Variation) -> [Matrix; 2] {
        let Changes { q, v } = &self.changes;
        let [u, rate, _] = &self.rows;
        [variation.g_times(q) - u, variation.g_times(v) + variation.gd_times(q) - rate]
    }

    /// The forces of the inputs alone, of each of their states and of each input.
    pub fn input_forces(&self) -> [Matrix; 2] {
        let ColumnBlocks { input_states, inputs, .. } = self.split(&self.force);
        [input_states, inputs]
    }

    /// c_0 u + c_1 u' + c_2 u'' of the prescribed rows, of each state of the inputs and of each input.
    pub fn input_rows(&self, row: DaeRow) -> [Matrix; 2] {
        let [u, rate, second] = &self.rows;
        let rows = u * row.position + rate * row.velocity + second * row.acceleration;
        let ColumnBlocks { input_states, inputs, .. } = self.split(&rows);
        [input_states, inputs]
    }

    /// The columns of a matrix by what they belong to.
    pub fn split(&self, matrix: &Matrix) -> ColumnBlocks {
        let [states, input_states] = self.counts;
        let first_input = states + input_states;
        ColumnBlocks {
            state: matrix.columns(0, states).clone_owned(),
            input_states: matrix.columns(states, input_states).clone_owned(),
            inputs: matrix.columns(first_input, matrix.ncols() - first_input).clone_owned(),
        }
    }
}
