//! Integrators: one step of a vector field.
//!
//! To add one: a file with its tableau (or a step of its own) and an [`Entry`], and a line in [`registry`]; from
//! outside the crate, an [`Entry`] and its [`spec`](Listed::spec), as in `tests/examples/own_integrator.rs` and
//! `own_tableau.rs`.

mod adams;
mod ali3p;
mod bdf;
mod control;
mod diffsol;
mod dop853;
mod dop853_tableau;
mod dopri5;
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
pub use explicit::{ErrorEstimate, Explicit, Tableau};
pub use problem::Problem;
pub use stability::Stability;

use crate::error::{Error, Result};
use crate::formulation::{self, Dae, StepError};
use crate::method_spec::{Listed, MethodSpec, OptionDoc};
use crate::system::MechanicalSystem;
use hermite::cubic;
use serde_json::Value;

/// A method. States are flat: q, v, and the work of forces without a potential.
pub trait Integrator {
    /// Tries a step and writes the new state. Returns the error estimate in units of the tolerance (accept at or below
    /// one), or `None` for a method that has none.
    fn attempt(&mut self, problem: &mut Problem, from: From, to: &mut [f64]) -> Result<Option<f64>, StepError>;

    /// The step control of the method, which may change its constants with its order.
    fn control(&mut self) -> &mut Control;

    /// The last attempt is accepted. Returns the size of the next step.
    fn accepted(&mut self, step: &Accepted) -> f64 {
        self.control().after(step)
    }

    /// Discards the history of the steps: the equations change their form here.
    fn restart(&mut self) {}

    /// Makes the next step of a method that [`leads`](Entry::leads), not beyond `from.end`, and returns its size, s;
    /// `from.h` is that of the first one. Attempts are then parts of this step.
    fn lead(&mut self, _: &mut Problem, from: From) -> Result<f64, StepError> {
        Ok(from.h)
    }

    /// y' at the new state, if the last attempt evaluated it there as its last evaluation: the terms of the new state
    /// are then in the problem, and the next step needs no evaluation of its own (first same as last).
    fn last_slope(&self) -> Option<&[f64]> {
        None
    }

    /// Writes the solution of lower order to which the last attempt was compared; false where there is none.
    fn lower_order(&self, _from: From, _out: &mut [f64]) -> bool {
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
pub struct From<'a> {
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
    pub from: From<'a>,
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

/// The system and the specifications for which an integrator is made.
pub struct Setup<'s> {
    /// Its own name and options.
    pub integrator: &'s MethodSpec,
    /// Formulation with its options.
    pub formulation: &'s MethodSpec,
    /// The mechanism.
    pub system: &'s dyn MechanicalSystem,
    /// True for fixed steps.
    pub is_fixed: bool,
}

impl Setup<'_> {
    /// Length of the flat state.
    pub fn len(&self) -> usize {
        let n = self.system.dimensions();
        n.q + n.v + 1 + self.system.works().len()
    }

    /// True for a system without velocities.
    pub fn is_empty(&self) -> bool {
        self.system.dimensions().v == 0
    }

    /// The equations with multipliers of its formulation.
    fn dae(&self) -> Result<Dae> {
        let refused = || Error::input(format!("{} cannot integrate {}", self.integrator.name, self.formulation.name));
        formulation::dae(self.formulation)?.ok_or_else(refused)
    }
}

/// Refuses a system that is too large for its matrix.
fn no_memory() -> Error {
    Error::input("there is not enough memory for a matrix of this size")
}

/// The origin of the step size.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Steps {
    /// A step must be given: there is no error estimate.
    Fixed,
    /// An error estimate, unless a fixed step is given.
    Either,
    /// Always the method itself.
    Own,
}

/// One integrator as the command line, the scene format and the table of methods know it.
pub struct Entry {
    /// Name in the scene format and on the command line.
    pub name: &'static str,
    /// One line for the table of methods.
    pub about: &'static str,
    /// Proven order in q, v and lambda.
    pub order: usize,
    /// The origin of the step size.
    pub steps: Steps,
    /// Tolerance of the steps relative to that of the motion.
    pub tightening: Tightening,
    /// True if it integrates a formulation: for a method that integrates vector fields `|formulation|
    /// formulation.field.is_some()`.
    pub solves: fn(&formulation::Entry) -> bool,
    /// True if a projection would cost it an order with a formulation.
    pub refuses: fn(&formulation::Entry, projection: &str) -> bool,
    /// The options of its specification.
    pub options: &'static [OptionDoc],
    /// Stability limit of the steps; `None` for a method without a limit.
    pub stability: Option<fn() -> Stability>,
    /// True if it chooses its steps itself, by [`Integrator::lead`].
    pub leads: bool,
    /// True if the last evaluation of an attempt is at its end, off by O(h^(p+1)).
    pub ends_near: bool,
    /// True for a multistep method that evaluates the ends of steps only: after [`Integrator::restart`] it takes short
    /// ones.
    pub begins_anew: bool,
    /// True if an output row within a step is a step of its own.
    pub rows_are_steps: bool,
    /// Makes it for a system.
    pub make: Make,
}

/// Makes an integrator for a system, with memory for states of [`Setup::len`].
pub type Make = for<'s> fn(&Setup<'s>) -> Result<Box<dyn Integrator + 's>>;

impl Entry {
    /// A method of this order with fixed steps for vector fields, which goes with all projections; for struct update.
    pub const fn new(name: &'static str, about: &'static str, order: usize, make: Make) -> Self {
        Entry {
            name,
            about,
            order,
            steps: Steps::Fixed,
            tightening: Tightening::NONE,
            solves: takes::vector_fields,
            refuses: refuses::none,
            options: &[],
            stability: None,
            leads: false,
            ends_near: false,
            begins_anew: false,
            rows_are_steps: false,
            make,
        }
    }

    /// The formulations that it integrates, in the order of their registry.
    pub fn accepts(&self) -> impl Iterator<Item = &'static str> + use<> {
        let solves = self.solves;
        formulation::registry().iter().filter(move |entry| solves(entry)).map(|entry| entry.name)
    }

    /// True if it integrates the formulation of this name.
    pub fn takes(&self, formulation: &str) -> bool {
        formulation::named(formulation).is_some_and(self.solves)
    }

    /// True if the projection would cost it an order with the formulation.
    pub fn refuses(&self, formulation: &str, projection: &str) -> bool {
        formulation::named(formulation).is_some_and(|entry| (self.refuses)(entry, projection))
    }

    /// True if it integrates vector fields, as explicit methods do.
    pub fn follows_fields(&self) -> bool {
        let fields = || formulation::registry().iter().filter(|entry| entry.field.is_some());
        fields().all(self.solves)
    }
}

impl Listed for Entry {
    const KIND: &'static str = "integrator";

    fn name(&self) -> &'static str {
        self.name
    }

    fn options(&self) -> &'static [OptionDoc] {
        self.options
    }
}

/// Every integrator, in the order of the documentation.
pub fn registry() -> &'static [Entry] {
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
pub fn find(spec: &MethodSpec) -> Result<&'static Entry> {
    spec.entry(registry()).map_err(|error| match ELSEWHERE.iter().find(|(theirs, _)| *theirs == spec.name) {
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
