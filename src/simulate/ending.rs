//! How a run ends before its end.

use super::{Run, Sink};
use crate::error::Failure;
use crate::formulation::StepError;
use crate::math::largest_in;
use crate::tolerances::simulate as tolerances;

const SINGULAR: &str = "this tolerance is too near to round-off there: try a looser one, or a fixed --step with `rk4`, which \
     goes over it";

const PASSES: &str = "`index1` with `dop853` and `manifold` goes over it";

impl Run<'_> {
    /// Ends a run that would never come to its end.
    pub fn check_progress(&mut self) -> Result<(), Failure> {
        let (since, tries) = self.progress;
        let advanced = self.t - since;
        if advanced > tolerances::CRAWL * (self.span.end - self.span.start) {
            self.progress = (self.t, 0);
            return Ok(());
        }
        self.progress.1 += 1;
        match tries > tolerances::CRAWLING_STEPS {
            true => Err(self.failure(
                format!("{} steps have come no farther than {advanced:.1e} s", tolerances::CRAWLING_STEPS),
                None,
            )),
            false => Ok(()),
        }
    }

    /// Ends a motion that is no longer one of this mechanism.
    pub fn check_joints(&self) -> Result<(), Failure> {
        let open = largest_in(&self.scales, &self.problem.dynamics.terms.phi);
        match open > tolerances::JOINTS_APART {
            true => Err(self.failure(format!("the joints have come apart by {open:.1e} times the scene's size"), None)),
            false => Ok(()),
        }
    }

    /// The step to try after a failed one, or the end of the run where no smaller step makes sense.
    pub fn retry(&mut self, h: f64, error: Option<f64>, reason: &str, hint: Option<&str>) -> Result<f64, Failure> {
        self.problem.dynamics.statistics.rejected += 1;
        if self.fixed.is_some() {
            return Err(self.failure(format!("{reason} (with the fixed step {h:e} s)"), hint));
        }
        let smaller = match error {
            Some(error) if error.is_finite() => self.integrator.control().reject(h, error),
            _ => 0.25 * h,
        };
        let is_stuck = self.keeps_constraints() && self.approach.is_stuck(h);
        match smaller > self.smallest() && !is_stuck {
            true => Ok(smaller),
            false => Err(self.too_small(format!("{reason}, down to a step of {h:.1e} s"), hint)),
        }
    }

    /// Steps have become too small; a singular state nearby is reason enough.
    pub fn too_small(&self, reason: String, hint: Option<&str>) -> Failure {
        match self.approach.is_near() {
            true => {
                let help = if self.keeps_constraints() { SINGULAR } else { PASSES };
                self.failure(format!("the motion comes to a singular state, and {reason}"), Some(help))
            }
            false => self.failure(reason, hint),
        }
    }

    /// Steps below make no sense.
    pub fn smallest(&self) -> f64 {
        1e-15 * self.t.abs().max(1e-3 * (self.span.end - self.span.start))
    }

    /// Where a run ends early, its last good state shows how it came to that.
    pub fn last_good_row(&mut self, sink: &mut dyn Sink) {
        if self.rows.next > 0 && self.span.row(self.rows.next - 1) < self.t {
            // A state that cannot be evaluated is none to show.
            self.rows.y.copy_from_slice(&self.y);
            let _ = self.rows.emit(self.t, sink);
        }
    }

    pub fn halted(&self, halt: &StepError) -> Failure {
        self.failure(halt.to_string(), halt.hint())
    }

    /// With what usually helps where there is no `hint`.
    pub fn failure(&self, reason: String, hint: Option<&str>) -> Failure {
        let usual = match self.fixed {
            Some(_) => "try a smaller --step, a projection such as `manifold`, or an adaptive integrator",
            None => "try another tolerance or a projection such as `manifold`; look at the motion just before the end",
        };
        Failure { t: self.t, reason, hint: hint.unwrap_or(usual).to_string() }
    }
}
