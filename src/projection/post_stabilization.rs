//! Post-stabilization: z -= F(z) h(z) after each step.

use super::{Projection, ProjectionEntry, move_back};
use crate::error::Result;
use crate::formulation::{Dynamics, Stabilizer, StabilizingField, StepError};
use crate::method_spec::{MethodSpec, OptionDoc};
use crate::system::{MechanicalSystem, Need};

const SWEEPS: OptionDoc = OptionDoc { name: "sweeps", about: "how often F h is evaluated and taken off (default 1)" };

/// S-pos: corrects phi only; G v + phi_t drifts, faster than without.
pub const POSITION: ProjectionEntry = ProjectionEntry {
    name: "position",
    about: "S-pos: only phi is held, drift of the velocities remains",
    options: &[SWEEPS],
    make: |spec, system| sweeps(StabilizingField::Position, spec, system),
};

/// S-vel: corrects G v + phi_t only; phi drifts slowly.
pub const VELOCITY: ProjectionEntry = ProjectionEntry {
    name: "velocity",
    about: "S-vel: only G v + phi_t is held, drift of the positions remains",
    options: &[SWEEPS],
    make: |spec, system| sweeps(StabilizingField::Velocity, spec, system),
};

/// S-both, the method of choice: one factorization and two back-substitutions. Drift of phi O(h^{2(p+1)}), of
/// G v + phi_t O(h^{p+1}); with two sweeps O(h^{2(p+1)}) and round-off. Order p of the integrator is kept in q, v and
/// lambda.
pub const MANIFOLD: ProjectionEntry = ProjectionEntry {
    name: "manifold",
    about: "S-both: one factorization, two back-substitutions; drift O(h^2(p+1)), O(h^(p+1))",
    options: &[OptionDoc { name: "sweeps", about: "1 (default) or 2: with 2 both levels reach O(h^2(p+1))" }],
    make: |spec, system| sweeps(StabilizingField::Both, spec, system),
};

/// S-full: least change of (q, v) onto both levels, with L = d(G v)/dq; drift O(h^{2(p+1)}) on both.
pub const FULL: ProjectionEntry = ProjectionEntry {
    name: "full",
    about: "S-full: F = H^T (H H^T)^-1 with second derivatives; drift O(h^2(p+1)) on both levels",
    options: &[SWEEPS, OptionDoc { name: "metric", about: "identity (default) or mass" }],
    make: |spec, system| {
        let field = match spec.text("metric") {
            None | Some("identity") => StabilizingField::Full,
            Some("mass") => StabilizingField::MassWeighted,
            Some(other) => {
                return Err(crate::error::Error::input(format!("full: there is no metric `{other}`"))
                    .hint("choose identity or mass"));
            }
        };
        sweeps(field, spec, system)
    },
};

fn sweeps(
    field: StabilizingField,
    spec: &MethodSpec,
    system: &dyn MechanicalSystem,
) -> Result<Option<Box<dyn Projection>>> {
    let sweeps = spec.whole("sweeps", 1, 1..=10)?;
    let rate = vec![0.0; system.dimensions().q];
    Ok(Some(Box::new(PostStabilization { sweeps, stabilizer: Stabilizer::new(field, system), rate })))
}

struct PostStabilization {
    sweeps: usize,
    stabilizer: Stabilizer,
    rate: Vec<f64>,
}

impl Projection for PostStabilization {
    fn project(&mut self, t: f64, q: &mut [f64], v: &mut [f64], dynamics: &mut Dynamics) -> Result<(), StepError> {
        for _ in 0..self.sweeps {
            dynamics.statistics.projections += 1;
            let needs = self.stabilizer.field.needs();
            // With factors that are off by O(h^(p+1)) the drift is O(h^2(p+1)) still.
            if dynamics.ends_near && dynamics.is_factored && !needs.includes(Need::L) {
                dynamics.evaluate(t, q, v, Need::CONSTRAINTS);
            } else {
                dynamics.evaluate(t, q, v, needs);
                dynamics.factor_truncated()?;
            }
            self.stabilizer.correction(dynamics)?;
            move_back(q, &self.stabilizer.dq, &mut self.rate, dynamics.system);
            v.iter_mut().zip(&self.stabilizer.dv).for_each(|(v, dv)| *v -= dv);
        }
        Ok(())
    }
}
