//! Integrators: one step of a vector field.
//!
//! To add one: a file with its tableau (or a step of its own) and an [`IntegratorEntry`], and a line in [`registry`]; from
//! outside the crate, an [`IntegratorEntry`] and its [`spec`](crate::method_spec::Listed::spec), as in `tests/examples/own_integrator.rs` and
//! `own_tableau.rs`.

mod adams;
mod ali3p;
mod bdf;
mod control;
mod diffsol;
mod dop853;
mod dop853_tableau;
mod dopri5;
mod entry;
mod explicit;
mod generalized_alpha;
mod half_explicit;
mod hem;
mod hermite;
mod heun;
mod memory;
mod newton_matrix;
mod phem56;
mod problem;
mod radau_iia;
mod rattle;
mod refuses;
mod rk4;
mod stability;
mod sums;
mod takes;

use control::round_off;
pub use control::{Control, Tightening, Tolerance, first_step};
use entry::no_memory;
pub use entry::{IntegratorEntry, MakeIntegrator, Setup, Steps};
pub use explicit::{ErrorEstimate, Explicit, Tableau};
pub use problem::Problem;
pub use stability::Stability;

use crate::error::Result;
use crate::formulation::StepError;
use crate::method_spec::MethodSpec;
use hermite::cubic;
use serde_json::Value;

/// A method. States are flat: q, v, and the work of forces without a potential.
pub trait Integrator {
    /// Tries a step and writes the new state. Returns the error estimate in units of the tolerance (accept at or below
    /// one), or `None` for a method that has none.
    fn attempt(&mut self, problem: &mut Problem, from: StepStart, to: &mut [f64]) -> Result<Option<f64>, StepError>;

    /// The step control of the method, which may change its constants with its order.
    fn control(&mut self) -> &mut Control;

    /// The last attempt is accepted. Returns the size of the next step.
    fn accepted(&mut self, step: &Accepted) -> f64 {
        self.control().after(step)
    }

    /// Discards the history of the steps: the equations change their form here.
    fn restart(&mut self) {}

    /// Makes the next step of a method that [`leads`](IntegratorEntry::leads), not beyond `from.end`, and returns its size, s;
    /// `from.h` is that of the first one. Attempts are then parts of this step.
    fn lead(&mut self, _: &mut Problem, from: StepStart) -> Result<f64, StepError> {
        Ok(from.h)
    }

    /// y' at the new state, if the last attempt evaluated it there as its last evaluation: the terms of the new state
    /// are then in the problem, and the next step needs no evaluation of its own (first same as last).
    fn last_slope(&self) -> Option<&[f64]> {
        None
    }

    /// Writes the solution of lower order to which the last attempt was compared; false where there is none.
    fn lower_order(&self, _from: StepStart, _out: &mut [f64]) -> bool {
        false
    }

    /// The method's own interpolation over its steps. Default: none, so that it is the cubic through both ends.
    fn dense(&mut self) -> Option<&mut dyn Dense> {
        None
    }

    /// The values that the method carries from step to step besides y and y', such as the stages of the last one. None
    /// for a method that starts anew when a run is continued, which is reported.
    fn memory(&self) -> Option<Value> {
        None
    }

    /// Restores the values of [`Self::memory`], at a state at which the problem is evaluated before the next step.
    fn recall(&mut self, _memory: &Value) {}
}

impl dyn Integrator + '_ {
    /// Prepares interpolation over a step.
    pub(crate) fn prepare(&mut self, problem: &mut Problem, step: Step) -> Result<(), StepError> {
        self.dense().map_or(Ok(()), |dense| dense.prepare(problem, step))
    }

    /// The state at the fraction `theta` of the prepared step.
    pub(crate) fn interpolate(
        &mut self,
        problem: &mut Problem,
        step: Step,
        theta: f64,
        out: &mut [f64],
    ) -> Result<(), StepError> {
        match self.dense() {
            Some(dense) => dense.interpolate(problem, step, theta, out),
            None => {
                cubic(step, theta, out);
                Ok(())
            }
        }
    }
}

/// Interpolation over the steps of a method.
pub trait Dense {
    /// Prepares it over the step just tried or accepted.
    fn prepare(&mut self, _: &mut Problem, _: Step) -> Result<(), StepError> {
        Ok(())
    }

    /// The state at the fraction `theta` of the prepared step.
    fn interpolate(&mut self, problem: &mut Problem, step: Step, theta: f64, out: &mut [f64]) -> Result<(), StepError>;
}

/// The start of a step to be tried.
#[derive(Clone, Copy, Debug)]
pub struct StepStart<'a> {
    /// Time, s.
    pub t: f64,
    /// State y = (q, v, w).
    pub y: &'a [f64],
    /// y' at (t, y).
    pub slope: &'a [f64],
    /// Size of the step, s.
    pub h: f64,
    /// Its end: t + h, but for the rounding of a grid or a stop that it meets.
    pub end: f64,
    /// Tolerance of the steps.
    pub tolerance: &'a Tolerance,
}

/// A step with both ends.
#[derive(Clone, Copy, Debug)]
pub struct Step<'a> {
    /// Its start and size.
    pub from: StepStart<'a>,
    /// State at its end, where it may have been projected, or cut, since the attempt.
    pub to: &'a [f64],
    /// y' there.
    pub slope: &'a [f64],
}

/// An accepted step.
#[derive(Clone, Copy, Debug)]
pub struct Accepted<'a> {
    /// Its size, s.
    pub h: f64,
    /// Its error in units of the tolerance, where steps are controlled.
    pub error: Option<f64>,
    /// False right after a rejection: the next step is no longer then.
    pub growing: bool,
    /// True if its end was moved since the attempt, as by a projection.
    pub is_moved: bool,
    /// Tolerance of the steps.
    pub tolerance: &'a Tolerance,
}

/// Every integrator, in the order of the documentation.
pub fn registry() -> &'static [IntegratorEntry] {
    &[
        heun::ENTRY,
        rk4::ENTRY,
        dopri5::ENTRY,
        dop853::ENTRY,
        adams::ENTRY,
        hem::HEM3,
        hem::HEM4,
        hem::HEM5,
        phem56::ENTRY,
        radau_iia::ENTRY,
        rattle::ENTRY,
        generalized_alpha::ENTRY,
        ali3p::ENTRY,
        bdf::ENTRY,
        diffsol::TR_BDF2,
        diffsol::ESDIRK34,
        diffsol::TSIT45,
        diffsol::DIFFSOL,
    ]
}

/// The entry that `spec` names.
pub fn find(spec: &MethodSpec) -> Result<&'static IntegratorEntry> {
    spec.entry::<IntegratorEntry>().map_err(|error| match ELSEWHERE.iter().find(|(theirs, _)| *theirs == spec.name) {
        Some((theirs, ours)) => error.changed(|input| {
            input.hint = Some(format!("did you mean `{ours}`? It is nearest to the {theirs} of other codes"))
        }),
        None => error,
    })
}

/// Names of methods in MATLAB, SciPy, SUNDIALS and other codes, and what comes nearest to them.
const ELSEWHERE: [(&str, &str); 14] = [
    ("ode45", "dopri5"),
    ("rk45", "dopri5"),
    ("ode23", "tsit45"),
    ("ode89", "dop853"),
    ("ode78", "dop853"),
    ("ode113", "adams"),
    ("ode15s", "bdf"),
    ("ode23t", "tr_bdf2"),
    ("ode23tb", "tr_bdf2"),
    ("radau", "radau_iia"),
    ("radau5", "radau_iia"),
    ("ida", "bdf"),
    ("cvode", "bdf"),
    ("hht", "generalized_alpha"),
];
