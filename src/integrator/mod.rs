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
pub use hermite::Hermite;
pub use problem::Problem;
pub use stability::Stability;

use crate::error::Result;
use crate::formulation::{self, StepError};
use crate::math::kkt::Singular;
use crate::method_spec::Listed;
use crate::method_spec::{MethodSpec, OptionDoc};
use crate::system::MechanicalSystem;
use crate::tolerances::integrator as tolerances;

/// The cause of a singular matrix. If all rows are in it, some depend on others at the start of the step and ahead, and
/// they prescribe different positions there, the rows contradict each other.
fn collapsed(singular: Singular, problem: &mut Problem, from: From, h: f64) -> StepError {
    if singular != Singular::Collapsed || !problem.dynamics.dropped.is_empty() {
        return singular.into();
    }
    let ahead: Vec<f64> = from.y.iter().zip(from.slope).map(|(y, slope)| y + h * slope).collect();
    let mut open = |t: f64, y: &[f64]| {
        let (q, v) = problem.split(y);
        problem.dynamics.dependent_rows_open(t, q, v)
    };
    let is_torn = open(from.t, from.y).is_some()
        && open(from.t + h, &ahead).is_some_and(|open| open > tolerances::ROUND_OFF_OF_PHI);
    if is_torn { CONTRADICTION } else { singular.into() }
}

const CONTRADICTION: StepError = StepError::Unsuitable {
    reason: "redundant constraints contradict each other during the motion",
    hint: "`holonom check` names the redundant joints; take one away, or make them say the same at all times",
};

/// A one-step method. States are flat: q, v, and the work of forces without a potential.
pub trait Integrator {
    /// Order of the solution, p: the error of a step is O(h^{p+1}).
    fn order(&self) -> usize;

    /// Stability limit of the steps; `None` for a method without a limit.
    fn stability(&self) -> Option<Stability> {
        None
    }

    /// True for a method that chooses its steps itself, by [`Self::lead`].
    fn leads(&self) -> bool {
        false
    }

    /// Makes the next step of such a method, not beyond `from.end`, and returns its size, s; `h` is that of the first
    /// one. Attempts are then parts of this step.
    fn lead(&mut self, _: &mut Problem, _: &Tolerance, _from: From, h: f64) -> Result<f64, StepError> {
        Ok(h)
    }

    /// Tries a step from (t, y), where y' is `slope`, and writes the new state. Returns the error estimate in units of
    /// the tolerance (accept at or below one), or `None` for a method that has none.
    fn attempt(
        &mut self,
        problem: &mut Problem,
        tolerance: &Tolerance,
        from: From,
        h: f64,
        to: &mut [f64],
    ) -> Result<Option<f64>, StepError>;

    /// y' at the new state, if the last attempt evaluated it there as its last evaluation: the terms of the new state
    /// are then in the problem, and the next step needs no evaluation of its own (first same as last).
    fn last_slope(&self) -> Option<&[f64]> {
        None
    }

    /// The step control of the method, which may change its constants with its order; not used without an error
    /// estimate.
    fn control(&mut self) -> &mut Control;

    /// True if the last evaluation of an attempt is at its end, off by O(h^(p+1)).
    fn ends_near(&self) -> bool {
        false
    }

    /// The next step after an accepted one of size `h` with error `error`; `growing` is false right after a rejection.
    fn propose(&mut self, h: f64, error: f64, growing: bool) -> f64 {
        self.control().accept(h, error, growing)
    }

    /// The last attempt was accepted and the next step proposed; `tolerance` is that of the run's steps.
    fn accepted(&mut self, _tolerance: &Tolerance) {}

    /// Discards the history of the steps: the equations change their form here.
    fn restart(&mut self) {}

    /// True for a multistep method that evaluates the ends of steps only: after [`Self::restart`] it takes short ones.
    fn begins_anew(&self) -> bool {
        false
    }

    /// Notes that the state of the last attempt was moved, as by a projection.
    fn moved(&mut self) {}

    /// The values that the method carries from step to step besides y and y', as numbers for [`Self::recall`], such as
    /// the stages of the last one. None for a method that starts anew when a run is continued, which is reported.
    fn memory(&self) -> Option<Vec<f64>> {
        None
    }

    /// Restores the values of [`Self::memory`], at a state at which the problem is evaluated before the next step.
    fn recall(&mut self, _memory: &[f64]) {}

    /// Writes the solution of lower order to which the last attempt was compared; false where there is none.
    fn lower_order(&self, _from: From, _h: f64, _out: &mut [f64]) -> bool {
        false
    }

    /// Fraction of a step at the middle of the widest gap between the points at which the equations are evaluated off
    /// the constraints; `None` for a method without such points, or one that needs steps of equal size.
    fn widest_gap(&self) -> Option<f64> {
        None
    }

    /// The longest part of a step between two evaluations of the equations.
    fn spacing(&self) -> f64 {
        1.0
    }

    /// True if an output row within a step is a step of its own.
    fn rows_are_steps(&self) -> bool {
        false
    }

    /// The polynomial of a method that interpolates by one, through both ends of a step with their slopes. Default: none.
    fn polynomial(&mut self) -> Option<&mut Hermite> {
        None
    }

    /// Prepares interpolation over the step just accepted; `slope` is y' at its end `to`. Default: the polynomial.
    fn prepare(&mut self, _: &mut Problem, from: From, h: f64, to: &[f64], slope: &[f64]) -> Result<(), StepError> {
        self.polynomial().ok_or(NO_INTERPOLATION)?.prepare(from, h, to, slope);
        Ok(())
    }

    /// The state at the fraction `theta` of the prepared step of size `h`. Default: by the polynomial.
    fn interpolate(
        &mut self,
        _: &mut Problem,
        from: From,
        _h: f64,
        theta: f64,
        out: &mut [f64],
    ) -> Result<(), StepError> {
        self.polynomial().ok_or(NO_INTERPOLATION)?.interpolate(theta, from.y, out);
        Ok(())
    }
}

const NO_INTERPOLATION: StepError = StepError::Unsuitable {
    reason: "the method does not interpolate within its steps",
    hint: "its code must have a polynomial, or prepare and interpolate of its own",
};

/// The start of a step.
#[derive(Clone, Copy, Debug)]
pub struct From<'a> {
    /// Time, s.
    pub t: f64,
    /// State y = (q, v, w).
    pub y: &'a [f64],
    /// y' at (t, y).
    pub slope: &'a [f64],
    /// End of a step of the requested size: t + h, but for the rounding of a grid or a stop that it meets.
    pub end: f64,
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
    /// Makes it for a system, with memory for states of [`Setup::len`].
    pub make: for<'s> fn(&Setup<'s>) -> Result<Box<dyn Integrator + 's>>,
}

impl Entry {
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
