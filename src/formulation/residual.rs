//! Residual of the equations at a state.

use super::{Dae, DaeRow, Dynamics, StepError};
use crate::math::threads::each;
use crate::system::{Dimensions, Need};
use crate::tolerances::NUMBERS_OF_A_PORTION;

/// The unknowns of [`Dae`] other than q and v: n_v and n_c numbers in turn. Empty for shifts that the equations do not
/// have, or whose own equations are met exactly.
#[derive(Clone, Copy, Debug, Default)]
pub struct Unknowns<'u> {
    /// Accelerations without the shift, n_v.
    pub a: &'u [f64],
    /// Multipliers of the reactions, n_c.
    pub lambda: &'u [f64],
    /// Velocity shift, v' = a + w, n_v.
    pub w: &'u [f64],
    /// Multipliers of the velocity shift, n_c.
    pub eta: &'u [f64],
    /// Position shift, q' = N (v + u), n_v.
    pub u: &'u [f64],
    /// Multipliers of the position shift, n_c.
    pub mu: &'u [f64],
    /// S of the metric M + S of shifts, a diagonal; empty for none.
    pub stiffness: &'u [f64],
}

/// The negative residual of [`Dae`].
#[derive(Clone, Debug)]
pub struct Residual {
    /// f - M a - G^T lambda, n_v
    pub motion: Vec<f64>,
    /// -M w - G^T eta, n_v, where there is a velocity shift.
    pub w: Vec<f64>,
    /// -(M + S) u - G^T mu, n_v, where there is a position shift.
    pub u: Vec<f64>,
    /// DaeRow of lambda, n_c.
    pub lambda: Vec<f64>,
    /// DaeRow of eta, n_c.
    pub eta: Vec<f64>,
    /// DaeRow of mu, n_c.
    pub mu: Vec<f64>,
    phi_ddot: Vec<f64>,
    /// Those of [`Dynamics::powers`].
    pub powers: Vec<f64>,
}

/// M x + G^T multipliers.
struct Product<'a> {
    x: &'a [f64],
    multipliers: &'a [f64],
    out: &'a mut [f64],
}

impl Residual {
    /// All zero, for these dimensions.
    pub fn new(n: Dimensions) -> Self {
        let rows = || vec![0.0; n.lambda];
        let lambda = rows();
        let eta = rows();
        let mu = rows();
        let phi_ddot = rows();
        let zeros = || vec![0.0; n.v];
        Residual { motion: zeros(), w: zeros(), u: zeros(), lambda, eta, mu, phi_ddot, powers: Vec::new() }
    }

    /// Evaluates the terms at (t, q, v) and the residual for the unknowns. One evaluation.
    ///
    /// # Errors
    /// A state that is not finite.
    pub fn evaluate(
        &mut self,
        dae: &Dae,
        t: f64,
        q: &[f64],
        v: &[f64],
        unknowns: Unknowns,
        dynamics: &mut Dynamics,
    ) -> Result<(), StepError> {
        if q.iter().chain(v).any(|x| !x.is_finite()) {
            return Err(StepError::NotFinite);
        }
        dynamics.statistics.rhs_evaluations += 1;
        dynamics.evaluate(t, q, v, Need::DYNAMICS);
        self.of_terms(dae, unknowns, dynamics);
        Ok(())
    }

    /// The residual from terms that are already evaluated at (t, q, v).
    pub fn of_terms(&mut self, dae: &Dae, unknowns: Unknowns, dynamics: &Dynamics) {
        let terms = &dynamics.terms;
        let structure = &dynamics.structure;
        let Unknowns { a, lambda, w, eta, u, mu, stiffness } = unknowns;
        let product = |product: &mut Product| {
            product.out.fill(0.0);
            structure.mass.multiply_symmetric(&terms.mass, product.x, product.out);
            structure.g.multiply_transposed(&terms.g, product.multipliers, product.out);
        };
        let of = |is_there: bool, x, multipliers, out| is_there.then_some(Product { x, multipliers, out });
        let mut products = [
            of(true, a, lambda, &mut self.motion[..]),
            of(dae.eta.is_some() && !w.is_empty(), w, eta, &mut self.w[..]),
            of(dae.mu.is_some() && !u.is_empty(), u, mu, &mut self.u[..]),
        ];
        if a.len() < NUMBERS_OF_A_PORTION {
            products.iter_mut().flatten().for_each(product)
        } else {
            each(&mut products[..], &|some: &mut [Option<Product>]| some.iter_mut().flatten().for_each(product))
        }
        for Product { x, out, .. } in products[1..].iter_mut().flatten() {
            out.iter_mut().zip(x.iter().zip(stiffness)).for_each(|(out, (x, stiffness))| *out += stiffness * x);
            out.iter_mut().for_each(|left| *left = -*left);
        }
        self.motion.iter_mut().zip(&terms.f).for_each(|(left, f)| *left = f - *left);
        if dae.holds(2) {
            self.phi_ddot.iter_mut().zip(&terms.gamma).for_each(|(row, gamma)| *row = -gamma);
            structure.g.multiply(&terms.g, a, &mut self.phi_ddot);
        }
        let holonomic = dynamics.system.dimensions().holonomic();
        for (dae, rows) in [(*dae, 0..holonomic), (dae.nonholonomic(), holonomic..lambda.len())] {
            let value = |row: Option<DaeRow>, i: usize, phi_ddot: &[f64]| {
                row.map_or(0.0, |row| -row.value(terms.phi[i], terms.phi_dot[i], phi_ddot[i]))
            };
            for i in rows {
                self.lambda[i] = value(Some(dae.lambda), i, &self.phi_ddot);
                self.eta[i] = value(dae.eta, i, &self.phi_ddot);
                self.mu[i] = value(dae.mu, i, &self.phi_ddot);
            }
        }
        self.powers.clear();
        self.powers.extend(dynamics.powers(lambda));
    }
}
