//! What the inputs add to the equations at a state.

use super::{Matrix, Variation};
use crate::error::{Error, Result, clock};
use crate::formulation::Dynamics;
use crate::system::Excitation;
use crate::tolerances;

/// Derivatives of the equations with respect to the inputs.
pub struct Excited {
    /// Order r of the derivative of each input that is an input of the model.
    pub orders: Vec<usize>,
    /// df/du and df/du', n_v x n_u.
    pub forces: [Matrix; 2],
    /// -dphi/du, which is -dphi'/du' and -dphi''/du'', too, n_c x n_u.
    pub rows: Matrix,
}

impl Variation<'_> {
    /// Returns what the inputs add to the equations.
    pub(super) fn excited(&mut self) -> Excited {
        let rows = self.driven_rows();
        let orders = self.orders();
        let mut forces = [0; 2].map(|_| Matrix::zeros(self.velocities(), orders.len()));
        let system = self.dynamics.system;
        let scratch = &mut self.dynamics.scratch;
        let t = self.point.t;
        let q = &self.point.q;
        let v = &self.point.v;
        if !orders.is_empty() {
            system.input_forces(t, q, v, &mut forces[0], scratch);
        }
        if self.excitations.contains(&Excitation::Displacement) {
            system.input_rate_forces(t, q, v, &mut forces[1], scratch);
        }
        Excited { orders, forces, rows }
    }

    /// Returns the order of the derivative of each input that is an input of the model.
    pub(super) fn orders(&self) -> Vec<usize> {
        self.excitations.iter().map(|excitation| excitation.order()).collect()
    }

    /// Returns the values of the inputs at the operating point.
    pub(super) fn input_values(&mut self) -> Vec<f64> {
        let mut u = vec![0.0; self.excitations.len()];
        if !u.is_empty() {
            let Dynamics { system, scratch, .. } = &mut self.dynamics;
            system.input_values(self.point.at(), &mut u, scratch);
        }
        u
    }

    /// Returns n_u.
    pub(super) fn input_count(&self) -> usize {
        self.excitations.len()
    }

    /// True if an input moves a driver.
    pub(super) fn has_drivers(&self) -> bool {
        self.excitations.iter().any(|excitation| excitation.order() == 2)
    }

    fn driven_rows(&self) -> Matrix {
        let mut rows = Matrix::zeros(self.point.lambda.len(), self.excitations.len());
        for (j, excitation) in self.excitations.iter().enumerate() {
            if let Excitation::Constraint(row) = excitation {
                rows[(*row, j)] = 1.0;
            }
        }
        rows
    }

    /// Returns the least change of q in the mass metric that a unit of each input prescribes, n_v x n_u.
    ///
    /// # Errors
    /// A driver that other constraints hold: what an input would prescribe is not possible.
    pub(super) fn prescribed(&mut self) -> Result<Matrix> {
        let rows = self.driven_rows();
        let p = self.correct(&rows)?;
        let left = self.g_times(&p) - rows;
        let held = (0..left.ncols()).find(|&j| left.column(j).amax() > tolerances::SIX_DIGITS);
        match held.and_then(|j| self.system().facts().inputs.clone().into_iter().nth(j)) {
            None => Ok(p),
            Some(input) => Err(Error::input(format!(
                "at t = {} s the input `{}` moves a driver that other constraints hold",
                clock(self.point.t),
                input.name
            ))
            .hint("remove the constraints that `holonom check` calls redundant, or the input")),
        }
    }
}
