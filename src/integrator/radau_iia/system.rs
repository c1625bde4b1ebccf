//! The equations of a step and their solution.

use super::collocation::Collocation;
use super::matrices::Matrices;
use super::stages::Stages;
use crate::formulation::{Dae, Linearized, StepError};
use crate::integrator::{Problem, StepStart};
use crate::math::newton::{Limits, Monitor};
use crate::tolerances;

/// The equations of all stages of one step.
pub struct System<'a> {
    pub dae: &'a Dae,
    pub method: &'a Collocation,
    pub at: &'a mut Linearized,
    pub matrices: &'a mut Matrices,
    pub stages: &'a mut Stages,
    pub is_fixed: bool,
}

/// Most corrections of a step with `s` stages. Source: the code RADAU.
pub fn most(s: usize, is_fixed: bool) -> usize {
    if is_fixed { tolerances::FIXED_STEP_ITERATIONS } else { 7 + 5 * (s - 3) / 2 }
}

impl System<'_> {
    /// Solves the equations by Newton's method from the first guess in `stages`.
    pub fn solve(&mut self, newton: &mut Monitor, problem: &mut Problem, from: StepStart) -> Result<bool, StepError> {
        let StepStart { h, tolerance, .. } = from;
        let System { dae, method, at, matrices, stages, is_fixed } = self;
        stages.reset(from);
        stages.advance(problem, method, from);
        let divisor = dae.rounding_time(h);
        // A fixed step goes on to where changes no longer fall, which stiff forces may raise.
        let fixed = if *is_fixed { Some(h) } else { divisor };
        let round_off = stages.round_off(problem, from, divisor);
        let stagnation = stages.round_off(problem, from, fixed);
        let limits = Limits {
            most: most(method.stages(), *is_fixed),
            tolerance: (10.0 * f64::EPSILON / tolerance.rtol).max(tolerance.rtol.sqrt().min(0.03)),
            round_off,
            stagnation: tolerances::RADAU_STAGNATION * stagnation,
            // A fixed step cannot be tried smaller.
            patience: if *is_fixed { 10 } else { 0 },
            // Two changes tell little of the rate.
            least_rate: 0.1,
            // An iteration more costs an evaluation a stage, about as much as a new matrix.
            kept_rate: 3e-5,
            ..Limits::NONE
        };
        let converged = newton.solve(limits, |_| {
            stages.evaluate(dae, method, from, at.stiffness(), &mut problem.dynamics)?;
            let Stages { residuals, unknowns, .. } = &mut **stages;
            matrices.correct(method, residuals, at, unknowns, &mut problem.dynamics)?;
            stages.advance(problem, method, from);
            Ok::<_, StepError>(stages.change(from, method.stages()))
        })?;
        problem.dynamics.statistics.stagnated += u64::from(converged && newton.has_stagnated);
        stages.work(method, from);
        Ok(converged && (*is_fixed || stages.turned() <= tolerances::RADAU_TURN))
    }
}
