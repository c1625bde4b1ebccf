//! Check of a singular start: whether a motion can begin there.

use super::checkpoint::flat;
use super::contest::{Quiet, unseen};
use super::{Method, Span, TimeLoop};
use crate::error::Failure;
use crate::math::largest;
use crate::system::MechanicalSystem;
use crate::tolerances;

const NO_BRANCH: &str = "the start is a singular state, with velocities that no motion through it has: constraints \
     that depend on each other there ask for different accelerations";
const UNDETERMINED: &str = "the start is a singular state at rest, and the motion is not determined: several motions \
     meet there, and the forces push it along none of them";
const BRANCHES: &str = "give velocities along one of the motions that meet there, or start beside it";

/// The reason why no run from (q, v) begins; `None` where one does, or the method is not possible.
pub fn refused(system: &dyn MechanicalSystem, method: &Method, span: Span, start: (&[f64], &[f64])) -> Option<Failure> {
    let y = flat(system, span.start, start).ok()?;
    TimeLoop::new(system, method, unseen(span), y).ok()?.begin(&mut Quiet(None)).err()
}

impl TimeLoop<'_> {
    /// Finds the rows that depend on others at the start, and drops them until they are violated. Refuses
    /// velocities that no motion has, and a state at rest with accelerations that no motion has: bounded
    /// multipliers act along none of the dependent rows, so that a motion from rest begins along v', as along a
    /// velocity.
    pub fn check_start(&mut self) -> Result<(), Failure> {
        let (q, v) = self.problem.split(&self.y);
        let dynamics = &mut self.rows.problem.dynamics;
        let moving = ..dynamics.system.dimensions().moving();
        let (dependent, (difference, usual)) = dynamics.dependent_rows(self.t, q, v);
        let duration = self.span.end - self.span.start;
        let mut is_undetermined = false;
        let is_at_rest =
            largest(&v[moving]) <= tolerances::ROUND_OFF_OF_SOLUTIONS * largest(&dynamics.vdot[moving]) * duration;
        if !dependent.is_empty() && is_at_rest {
            let vdot = dynamics.vdot.clone();
            let (_, (difference, usual)) = dynamics.dependent_rows(self.t, q, &vdot);
            is_undetermined = self.is_contradiction(difference, usual);
        }
        if self.is_contradiction(difference, usual) {
            return Err(self.failure(NO_BRANCH.to_string(), Some(BRANCHES)));
        }
        if is_undetermined {
            return Err(self.failure(UNDETERMINED.to_string(), Some(BRANCHES)));
        }
        self.drop_rows(&dependent);
        Ok(())
    }

    /// True if dependent rows prescribe accelerations that differ by more than round-off of the `usual` terms there,
    /// and that would open joints during the run.
    fn is_contradiction(&self, difference: f64, usual: f64) -> bool {
        let opened = difference * (self.span.end - self.span.start).powi(2);
        difference > tolerances::SIX_DIGITS * usual && opened > tolerances::SIX_DIGITS * largest(&self.scales)
    }
}
