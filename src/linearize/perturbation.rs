//! Small changes of the state together with those of the inputs.

use super::excited::Excited;
use super::{Changes, Matrix, Variation};

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
pub struct Parts {
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
        let own = state.q.ncols();
        let states: Vec<(usize, usize)> =
            orders.iter().enumerate().flat_map(|(j, &order)| (0..order).map(move |i| (i, j))).collect();
        let added = states.len() + n_u;
        let mut u = [0; 3].map(|_| Matrix::zeros(n_u, own + added));
        let mut changes = state.clone();
        changes.q = changes.q.resize_horizontally(own + added, 0.0);
        changes.v = changes.v.resize_horizontally(own + added, 0.0);
        for (column, &(i, j)) in states.iter().enumerate() {
            u[i][(j, own + column)] = 1.0;
            if let Some([dq, dv]) = along(i, j) {
                changes.q.column_mut(own + column).copy_from(&dq);
                changes.v.column_mut(own + column).copy_from(&dv);
            }
        }
        orders.iter().enumerate().for_each(|(j, &order)| u[order][(j, own + states.len() + j)] = 1.0);
        let force = &forces[0] * &u[0] + &forces[1] * &u[1];
        let rows = [0, 1, 2].map(|i: usize| &rows * &u[i]);
        Perturbation { changes, u, force, rows, counts: [own, states.len()] }
    }

    /// -K dq - C dv and the forces of the inputs, a column each.
    pub fn force(&self, variation: &Variation) -> Matrix {
        variation.force(&self.changes) + &self.force
    }

    /// G dv' for phi'' + c1 phi' + c0 phi = 0, where the inputs are part of phi, a column each.
    pub fn rows(&self, variation: &Variation, [c1, c0]: [f64; 2]) -> Matrix {
        let [u, rate, acceleration] = &self.rows;
        variation.rows(&self.changes, [c1, c0]) + acceleration + rate * c1 + u * c0
    }

    /// dphi and dphi' of the changes, a column each.
    pub fn residuals(&self, variation: &Variation) -> [Matrix; 2] {
        let Changes { q, v } = &self.changes;
        let [u, rate, _] = &self.rows;
        [variation.g_times(q) - u, variation.g_times(v) + variation.gd_times(q) - rate]
    }

    /// The forces of the inputs alone, of each of their states and of each input.
    pub fn input_forces(&self) -> [Matrix; 2] {
        let Parts { input_states, inputs, .. } = self.split(&self.force);
        [input_states, inputs]
    }

    /// `position` u + `velocity` u' + `acceleration` u'' of the prescribed rows, of each state of the inputs and of each
    /// input.
    pub fn input_rows(&self, [position, velocity, acceleration]: [f64; 3]) -> [Matrix; 2] {
        let [u, rate, second] = &self.rows;
        let Parts { input_states, inputs, .. } = self.split(&(u * position + rate * velocity + second * acceleration));
        [input_states, inputs]
    }

    /// The columns of a matrix by what they belong to.
    pub fn split(&self, all: &Matrix) -> Parts {
        let [own, states] = self.counts;
        let part = |first: usize, count: usize| all.columns(first, count).clone_owned();
        Parts {
            state: part(0, own),
            input_states: part(own, states),
            inputs: part(own + states, all.ncols() - own - states),
        }
    }
}
