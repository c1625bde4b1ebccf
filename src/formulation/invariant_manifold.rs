//! Vector fields with a stabilized invariant manifold.

use super::{Dynamics, Formulation, FormulationEntry, Stabilizer, StabilizingField, StepError};
use crate::error::Result;
use crate::method_spec::OptionDoc;
use crate::system::{MechanicalSystem, Need};

/// ```text
/// z' = fhat(z, t) - gamma F(z) h(z),   z = (q, v),  h = (phi, G v + phi_t)
/// ```
///
/// with fhat of index 1. Where H F is positive definite with least eigenvalue l0, |h| decays monotonically for
/// gamma > 1/l0. Source: Ascher, Chin, Reich, Numer. Math. 67 (1994) 131-149. Order in q, v, lambda: that of the
/// integrator; an explicit one needs gamma h of order one. Cost of index 1 and the back-substitutions of F a stage.
pub const ENTRY: FormulationEntry = FormulationEntry {
    name: "invariant_manifold",
    about: "z' = fhat - gamma F h: the constraint manifold attracts",
    options: &[
        OptionDoc { name: "gamma", about: "rate of attraction, 1/s (default 10)" },
        OptionDoc {
            name: "field",
            about: "F: both (default), full, mass_weighted, triangular, position, velocity, gradient",
        },
    ],
    dae: None,
    field: Some(|spec, system| {
        let gamma = spec.not_negative("gamma", 10.0)?;
        let stabilizer = Stabilizer::new(StabilizingField::from_spec(spec)?, system);
        Ok(Box::new(InvariantManifold::new([gamma; 2], stabilizer, system)))
    }),
};

pub(super) struct InvariantManifold {
    /// Rates of attraction of the position and the velocity part of F h, 1/s.
    gains: [f64; 2],
    stabilizer: Stabilizer,
    rate: Vec<f64>,
}

impl InvariantManifold {
    pub fn new(gains: [f64; 2], stabilizer: Stabilizer, system: &dyn MechanicalSystem) -> Self {
        InvariantManifold { gains, stabilizer, rate: vec![0.0; system.dimensions().q] }
    }
}

impl Formulation for InvariantManifold {
    fn derivative(
        &mut self,
        t: f64,
        q: &[f64],
        v: &[f64],
        dynamics: &mut Dynamics,
        qdot: &mut [f64],
        vdot: &mut [f64],
    ) -> Result<(), StepError> {
        let [position, velocity] = self.gains;
        dynamics.solve(t, q, v, |_, _| 0.0)?;
        dynamics.system.rate(q, v, qdot);
        if self.stabilizer.field.needs().includes(Need::L) {
            dynamics.evaluate(t, q, v, Need::L);
        }
        self.stabilizer.correction(dynamics)?;
        dynamics.system.rate(q, &self.stabilizer.dq, &mut self.rate);
        qdot.iter_mut().zip(&self.rate).for_each(|(rate, correction)| *rate -= position * correction);
        for ((rate, vdot), correction) in vdot.iter_mut().zip(&dynamics.vdot).zip(&self.stabilizer.dv) {
            *rate = vdot - velocity * correction;
        }
        Ok(())
    }
}
