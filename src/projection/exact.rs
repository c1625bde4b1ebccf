//! Coordinate projection, iterated to round-off.

use super::{Projection, ProjectionEntry, move_back};
use crate::error::Result;
use crate::formulation::{Dynamics, StepError};
use crate::math::newton::{Limits, Monitor};
use crate::math::{largest, largest_in};
use crate::method_spec::OptionDoc;
use crate::system::Need;
use crate::tolerances;

/// ```text
/// min |q - q~|_M  s.t.  phi = 0,   then   min |v - v~|_M  s.t.  G v + phi_t = 0
/// ```
///
/// Source: Eich, SIAM J. Numer. Anal. 30 (1993) 1467-1482. Newton's method with the mass matrix as metric, until the
/// residual no longer falls. Order of the integrator kept; a residual that stagnates above its tolerance is an error.
/// One evaluation and factorization per iteration, and one more, which the velocities share with the test of the
/// residual.
pub const ENTRY: ProjectionEntry = ProjectionEntry {
    name: "exact",
    about: "positions by Newton's method to round-off, then velocities",
    options: &[OptionDoc { name: "iterations", about: "most Newton iterations (default 10)" }],
    make: |spec, system| {
        let n = system.dimensions();
        Ok(Some(Box::new(Exact {
            scales: system.facts().scales.clone(),
            most: spec.whole("iterations", tolerances::PROJECTIONS, 1..=1000)?,
            rate: vec![0.0; n.q],
            step: vec![0.0; n.v],
        })))
    },
};

/// Limits on the residual over its stagnation tolerance: round-off at the scene's size, and the contradiction allowed
/// between redundant rows. A residual below that at least halves in each iteration, until only its round-off changes.
const LIMITS: Limits = Limits { stagnation: 1.0, contraction: tolerances::NEWTON_HALVES, ..Limits::NONE };

struct Exact {
    most: usize,
    scales: Vec<f64>,
    rate: Vec<f64>,
    step: Vec<f64>,
}

impl Projection for Exact {
    fn project(&mut self, t: f64, q: &mut [f64], v: &mut [f64], dynamics: &mut Dynamics) -> Result<(), StepError> {
        let need = Need::MASS | Need::CONSTRAINTS | Need::G;
        let mut newton = Monitor::default();
        let mut is_evaluated = false;
        // `most` corrections, and the residual after the last one.
        let limits = Limits { most: self.most + 1, ..LIMITS };
        let closed = newton.solve(limits, |_| {
            if std::mem::replace(&mut is_evaluated, true) {
                dynamics.kkt.solve_projection(&dynamics.terms.phi, &mut self.step)?;
                // Beside the origin the residual would go on to fall. Near a singular state its round-off still moves
                // q.
                if largest(&self.step) <= f64::EPSILON * largest(q) {
                    return Ok(0.0);
                }
                move_back(q, &self.step, &mut self.rate, dynamics.system);
            }
            dynamics.statistics.projections += 1;
            dynamics.evaluate(t, q, v, need);
            dynamics.factor_truncated()?;
            Ok::<_, StepError>(largest_in(&self.scales, &dynamics.terms.phi) / tolerances::SAME)
        })?;
        let is_limited = newton.iterations > self.most && self.most < tolerances::PROJECTIONS;
        if !closed && !is_limited {
            return Err(StepError::Open);
        }
        dynamics.kkt.solve_projection(&dynamics.terms.phi_dot, &mut self.step)?;
        v.iter_mut().zip(&self.step).for_each(|(v, dv)| *v -= dv);
        Ok(())
    }
}
