//! Baumgarte stabilization.

use super::index1::{RANK, rank_tolerance};
use super::{Dae, Dynamics, Entry, Formulation, Row, StepError};
use crate::error::Result;
use crate::method_spec::{MethodSpec, OptionDoc};

/// ```text
/// phi'' + 2 alpha phi' + beta^2 phi = 0
/// ```
///
/// Source: Baumgarte, Comput. Methods Appl. Mech. Eng. 1 (1972) 1-16. Critically damped for alpha = beta. Small gains
/// do not bound the drift, large ones make the equations stiff (explicit methods need 2 alpha h and beta h of order
/// one), and the best gains depend on the step and the method. Order in q, v, lambda: that of the integrator; cost as
/// index 1.
pub const ENTRY: Entry = Entry {
    name: "baumgarte",
    about: "phi'' + 2 alpha phi' + beta^2 phi = 0; the best gains depend on the step",
    options: &[
        OptionDoc { name: "alpha", about: "damping of phi, 1/s (default 5)" },
        OptionDoc { name: "beta", about: "frequency of phi, 1/s (default alpha)" },
        RANK,
    ],
    dae: Some(|spec| {
        let [alpha, beta] = gains(spec)?;
        Ok(Dae::with(Row { position: beta * beta, velocity: 2.0 * alpha, acceleration: 1.0 }))
    }),
    field: Some(|spec, _| {
        let [alpha, beta] = gains(spec)?;
        Ok(Box::new(Baumgarte { alpha, beta, rank_tolerance: rank_tolerance(spec)? }))
    }),
};

/// alpha and beta
fn gains(spec: &MethodSpec) -> Result<[f64; 2]> {
    let alpha = spec.not_negative("alpha", 5.0)?;
    Ok([alpha, spec.not_negative("beta", alpha)?])
}

struct Baumgarte {
    alpha: f64,
    beta: f64,
    rank_tolerance: f64,
}

impl Formulation for Baumgarte {
    fn derivative(
        &mut self,
        t: f64,
        q: &[f64],
        v: &[f64],
        dynamics: &mut Dynamics,
        qdot: &mut [f64],
        vdot: &mut [f64],
    ) -> Result<(), StepError> {
        let (alpha, beta) = (self.alpha, self.beta);
        dynamics.rank_tolerance = self.rank_tolerance;
        dynamics.solve(t, q, v, |phi, phi_dot| -2.0 * alpha * phi_dot - beta * beta * phi)?;
        dynamics.system.rate(q, v, qdot);
        vdot.copy_from_slice(&dynamics.vdot);
        Ok(())
    }
}
