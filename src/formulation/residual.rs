//! What the equations leave at a state.

use super::{Dae, Dynamics, Halt, Row};
use crate::system::{Dimensions, Need};

/// The residual of [`Dae`], with its sign turned. The shifts w and u meet their own equations exactly, since
/// methods find them as -M^-1 G^T eta and -M^-1 G^T mu.
#[derive(Clone, Debug)]
pub struct Residual {
    /// f - M a - G^T lambda, n_v
    pub motion: Vec<f64>,
    /// n_c each
    pub lambda: Vec<f64>,
    pub eta: Vec<f64>,
    pub mu: Vec<f64>,
    phi_ddot: Vec<f64>,
    /// Power of the forces without a potential and of moving constraints, W.
    pub power: f64,
}

impl Residual {
    pub fn new(n: Dimensions) -> Self {
        let rows = || vec![0.0; n.lambda];
        let (lambda, eta, mu, phi_ddot) = (rows(), rows(), rows(), rows());
        Residual { motion: vec![0.0; n.v], lambda, eta, mu, phi_ddot, power: 0.0 }
    }

    /// Evaluates the terms at (t, q, v) and the residual for the unknowns (a, lambda). One evaluation.
    ///
    /// # Errors
    /// A state that is not finite.
    pub fn evaluate(
        &mut self,
        dae: &Dae,
        (t, q, v): (f64, &[f64], &[f64]),
        unknowns: (&[f64], &[f64]),
        dynamics: &mut Dynamics,
    ) -> Result<(), Halt> {
        if q.iter().chain(v).any(|x| !x.is_finite()) {
            return Err(Halt::NotFinite);
        }
        dynamics.statistics.rhs_evaluations += 1;
        dynamics.evaluate(t, q, v, Need::DYNAMICS);
        self.of_terms(dae, unknowns, dynamics);
        Ok(())
    }

    /// The same by terms that are there.
    pub fn of_terms(&mut self, dae: &Dae, (a, lambda): (&[f64], &[f64]), dynamics: &Dynamics) {
        let (terms, structure) = (&dynamics.terms, &dynamics.structure);
        self.motion.fill(0.0);
        structure.mass.multiply_symmetric(&terms.mass, a, &mut self.motion);
        structure.g.multiply_transposed(&terms.g, lambda, &mut self.motion);
        self.motion.iter_mut().zip(&terms.f).for_each(|(left, f)| *left = f - *left);
        if dae.holds(2) {
            self.phi_ddot.iter_mut().zip(&terms.gamma).for_each(|(row, gamma)| *row = -gamma);
            structure.g.multiply(&terms.g, a, &mut self.phi_ddot);
        }
        let holonomic = dynamics.system.dimensions().holonomic();
        for (dae, rows) in [(*dae, 0..holonomic), (dae.nonholonomic(), holonomic..lambda.len())] {
            let value = |row: Option<Row>, i: usize, phi_ddot: &[f64]| {
                row.map_or(0.0, |row| -row.value(terms.phi[i], terms.phi_dot[i], phi_ddot[i]))
            };
            for i in rows {
                self.lambda[i] = value(Some(dae.lambda), i, &self.phi_ddot);
                self.eta[i] = value(dae.eta, i, &self.phi_ddot);
                self.mu[i] = value(dae.mu, i, &self.phi_ddot);
            }
        }
        self.power = terms.power + lambda.iter().zip(&terms.phi_t).map(|(l, p)| l * p).sum::<f64>();
    }
}
