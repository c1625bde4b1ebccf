//! Index 1 with the dense solver of the saddle-point system.

use super::{Dynamics, Formulation, StepError};
use crate::math::kkt::Reduced;

/// The vector field of index 1, with accelerations and multipliers from a pivoted QR of G^T.
pub(super) struct Dense(pub Reduced);

impl Formulation for Dense {
    fn is_dense(&self) -> bool {
        true
    }

    fn derivative(
        &mut self,
        t: f64,
        q: &[f64],
        v: &[f64],
        dynamics: &mut Dynamics,
        qdot: &mut [f64],
        vdot: &mut [f64],
    ) -> Result<(), StepError> {
        dynamics.right_sides(t, q, v, |_, _| 0.0);
        dynamics.statistics.factorizations += 1;
        self.0.drop_rows(&dynamics.dropped);
        let factored = self.0.factor(&dynamics.terms.mass, &dynamics.terms.g, dynamics.dense_reference);
        factored.map_err(|singular| dynamics.halt(singular))?;
        dynamics.dense_indicator = self.0.rank_indicator();
        dynamics.is_rank_deficient = self.0.is_rank_deficient();
        dynamics.rank_indicator = Some(dynamics.dense_indicator);
        self.0.solve(&mut dynamics.vdot, &mut dynamics.lambda).map_err(|singular| dynamics.halt(singular))?;
        dynamics.finite()?;
        dynamics.system.rate(q, v, qdot);
        vdot.copy_from_slice(&dynamics.vdot);
        Ok(())
    }
}
