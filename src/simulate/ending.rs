//! Failures that end a run early.

use super::{Sink, TimeLoop};
use crate::error::{Failure, short};
use crate::formulation::StepError;
use crate::math::{index_of_largest, largest_in};
use crate::system::Need;
use crate::tolerances;

/// Steps that together come no farther than 1e-8 of the span end the run. Unit: `[steps]`.
const CRAWLING_STEPS: usize = 50_000;

const SINGULAR: &str = "this tolerance is too near to round-off there: try a looser one, or a fixed --step with `rk4`, which \
     goes over it";

const OPEN_START: &str = "begin at a state that closes the constraints; `research::initial::assemble` finds one nearby";

const PASSES: &str = "`index1` with `dop853` and `manifold` goes over it";

impl TimeLoop<'_> {
    /// Ends a run that makes no progress.
    pub fn check_progress(&mut self) -> Result<(), Failure> {
        let (since, tries) = self.progress;
        let advanced = self.t - since;
        // At this rate a run takes 5e12 steps.
        if advanced > tolerances::ROOT_OF_ROUND_OFF * (self.span.end - self.span.start) {
            self.progress = (self.t, 0);
            return Ok(());
        }
        self.progress.1 += 1;
        if tries > CRAWLING_STEPS {
            Err(self.failure(format!("{} steps have come no farther than {advanced:.1e} s", CRAWLING_STEPS), None))
        } else {
            Ok(())
        }
    }

    /// Ends a run whose joints have come apart.
    pub fn check_joints(&self) -> Result<(), Failure> {
        let open = largest_in(&self.scales, &self.problem.dynamics.terms.phi);
        if open > tolerances::LOST_MOTION {
            Err(self.failure(format!("the joints have come apart by {open:.1e} of the scene's size"), None))
        } else {
            Ok(())
        }
    }

    /// The step to try after a failed one, or the failure of the run where no smaller step makes sense.
    pub fn retry(&mut self, h: f64, error: Option<f64>, reason: &str, hint: Option<&str>) -> Result<f64, Failure> {
        self.problem.dynamics.statistics.rejected += 1;
        if self.fixed.is_some() {
            return Err(self.failure(format!("{reason} (with the fixed step {h:e} s)"), hint));
        }
        let smaller = match error {
            Some(error) if error.is_finite() => self.integrator.control().reject(h, error),
            _ => self.integrator.control().retry * h,
        };
        let is_stuck = self.keeps_constraints() && self.approach.is_stuck(h);
        if smaller > self.smallest() && !is_stuck {
            Ok(smaller)
        } else {
            let reason = format!("{reason}, down to a step of {h:.1e} s");
            match self.open_at_start() {
                Some(open) => Err(self.failure(format!("{open}, and {reason}"), Some(OPEN_START))),
                None => Err(self.too_small(reason, hint)),
            }
        }
    }

    /// Names the constraint that is farthest from zero where a run has to begin at an inconsistent state.
    fn open_at_start(&mut self) -> Option<String> {
        if self.problem.dynamics.statistics.steps > 0 {
            return None;
        }
        let (q, v) = self.problem.split(&self.y);
        self.problem.dynamics.evaluate(self.t, q, v, Need::CONSTRAINTS);
        let phi = &self.problem.dynamics.terms.phi;
        let relative: Vec<f64> = phi.iter().zip(&self.scales).map(|(phi, scale)| phi / scale).collect();
        let row = index_of_largest(&relative);
        let is_open = relative.get(row).is_some_and(|gap| gap.abs() > tolerances::UNSEEN);
        let name = &self.problem.dynamics.system.facts().names.lambda;
        is_open.then(|| format!("the constraint of `{}` is open by {} at the start", name[row], short(phi[row])))
    }

    /// Failure of steps that have become too small, whose reason may be a singular state nearby.
    pub fn too_small(&self, reason: String, hint: Option<&str>) -> Failure {
        if self.approach.is_near() {
            let help = if self.keeps_constraints() { SINGULAR } else { PASSES };
            self.failure(format!("the motion comes to a singular state, and {reason}"), Some(help))
        } else {
            self.failure(reason, hint)
        }
    }

    /// The smallest step that makes sense, s.
    pub fn smallest(&self) -> f64 {
        1e-15 * self.t.abs().max(1e-3 * (self.span.end - self.span.start))
    }

    /// Shows the last good state of a run that ends early.
    pub fn last_good_row(&mut self, sink: &mut dyn Sink) {
        let is_new = self.t - self.rows.shown > tolerances::SAME * (self.span.end - self.span.start);
        if is_new && self.rows.next > 0 && self.span.row(self.rows.next - 1) < self.t {
            // A state that cannot be evaluated is not shown.
            self.rows.y.copy_from_slice(&self.y);
            let _ = self.rows.emit(self.t, sink);
        }
    }

    pub fn halted(&self, halt: &StepError) -> Failure {
        self.failure(halt.to_string(), halt.hint())
    }

    /// A failure at the present time; without a `hint`, with the usual one.
    pub fn failure(&self, reason: String, hint: Option<&str>) -> Failure {
        let usual = match self.fixed {
            Some(_) => "try a smaller --step, a projection such as `manifold`, or an adaptive integrator",
            None => "try another tolerance or a projection such as `manifold`; look at the motion just before the end",
        };
        Failure { t: self.t, reason, hint: hint.unwrap_or(usual).to_string() }
    }
}
