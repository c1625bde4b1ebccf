//! Integrators: one step of a vector field.
//!
//! To add one: a file with its tableau (or a step of its own) and an [`Entry`], and a line in [`registry`]; from
//! outside the crate, an [`Entry`] and its [`spec`](Listed::spec), as in `tests/examples/own_integrator.rs` and
//! `own_tableau.rs`.

mod ali3p;
mod bdf;
mod control;
mod diffsol_backend;
mod dop853;
mod dop853_tableau;
mod dopri5;
mod esdirk34;
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
mod takes;
mod tr_bdf2;

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

/// Why the matrix of a step is singular: with all rows in it, of which some depend on others at its start and ahead,
/// and yet ask for another position there, these contradict each other.
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

/// A one-step method. States are flat: q, v, and the work done by forces without a potential.
pub trait Integrator {
    /// Order of the solution, p: the error of a step is O(h^{p+1}).
    fn order(&self) -> usize;

    /// How long its steps may be for a fast mode; none where they may be as long as they like.
    fn stability(&self) -> Option<Stability> {
        None
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

    /// y' at the new state, where the last attempt evaluated it there, and last of all: the problem then holds the
    /// terms of the new state, and the next step needs no evaluation of its own (first same as last).
    fn last_slope(&self) -> Option<&[f64]> {
        None
    }

    /// The step control that goes with the method, which may change its constants with its order; without an error
    /// estimate it is not asked.
    fn control(&mut self) -> &mut Control;

    /// The size of the step just tried, where the method chose one of its own and not the `h` it was given.
    fn own_step(&self) -> Option<f64> {
        None
    }

    /// How far from the start of the step just tried a method that chose its own has evaluated the equations.
    fn seen(&self) -> Option<f64> {
        None
    }

    /// The last attempt was accepted and the next step proposed; `tolerance` is that of the run's steps.
    fn accepted(&mut self, _tolerance: &Tolerance) {}

    /// Forgets the steps so far: the equations change their form here.
    fn restart(&mut self) {}

    /// The state that the last attempt left was moved, as by a projection.
    fn moved(&mut self) {}

    /// What the method carries from step to step beside y and y', as numbers that [`Self::recall`] takes: the control's
    /// last error, say. None for a method that begins anew after a restart, which a user is told.
    fn memory(&self) -> Vec<f64> {
        Vec::new()
    }

    /// Goes on with what it carried then, from a state at which the problem is evaluated before the next step.
    fn recall(&mut self, _memory: &[f64]) {}

    /// Writes the solution of lower order that the last attempt was compared with; false where there is none.
    fn lower_order(&self, _from: From, _h: f64, _out: &mut [f64]) -> bool {
        false
    }

    /// The fraction of a step that is farthest from the places at which the equations are evaluated off the
    /// constraints; `None` for a method without such places, or that wants steps of one size.
    fn widest_gap(&self) -> Option<f64> {
        None
    }

    /// The longest part of a step between evaluations of the equations.
    fn spacing(&self) -> f64 {
        1.0
    }

    /// Prepares interpolation over the step just accepted; `slope` is y' at its end `to`.
    fn prepare(
        &mut self,
        problem: &mut Problem,
        from: From,
        h: f64,
        to: &[f64],
        slope: &[f64],
    ) -> Result<(), StepError>;

    /// The state at the fraction `theta` of the prepared step of size `h`.
    fn interpolate(
        &mut self,
        problem: &mut Problem,
        from: From,
        h: f64,
        theta: f64,
        out: &mut [f64],
    ) -> Result<(), StepError>;
}

/// Where a step starts.
#[derive(Clone, Copy, Debug)]
pub struct From<'a> {
    /// Time, s.
    pub t: f64,
    /// State y = (q, v, w).
    pub y: &'a [f64],
    /// y' at (t, y).
    pub slope: &'a [f64],
    /// When a step of the size that is asked for ends: t + h, but for the rounding of a grid or a stop that it meets.
    pub end: f64,
}

/// What an integrator is made for.
pub struct Setup<'s> {
    /// Its own name and options.
    pub integrator: &'s MethodSpec,
    /// Formulation with its options.
    pub formulation: &'s MethodSpec,
    /// The mechanism.
    pub system: &'s dyn MechanicalSystem,
    /// Whether the steps are fixed.
    pub is_fixed: bool,
}

impl Setup<'_> {
    /// Length of the flat state.
    pub fn len(&self) -> usize {
        let n = self.system.dimensions();
        n.q + n.v + 1
    }

    /// True for a system without velocities.
    pub fn is_empty(&self) -> bool {
        self.system.dimensions().v == 0
    }
}

/// Who chooses the steps.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Steps {
    /// There is no error estimate: a step must be given.
    Fixed,
    /// An error estimate, where no fixed step is given.
    Either,
    /// The method itself, always.
    Own,
}

/// One integrator as the command line, the scene format and the table of methods know it.
pub struct Entry {
    /// As methods call it.
    pub name: &'static str,
    /// One line for the table of methods.
    pub about: &'static str,
    /// Proven order in q, v and lambda.
    pub order: usize,
    /// Who chooses the steps.
    pub steps: Steps,
    /// How much tighter than asked for the motion steps are controlled.
    pub tightening: Tightening,
    /// Whether it integrates a formulation: one that follows vector fields says `|formulation|
    /// formulation.field.is_some()`.
    pub solves: fn(&formulation::Entry) -> bool,
    /// Whether a projection would cost it an order with a formulation.
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

    /// Whether it integrates the formulation of this name.
    pub fn takes(&self, formulation: &str) -> bool {
        formulation::named(formulation).is_some_and(self.solves)
    }

    /// Whether the projection would cost it an order with the formulation.
    pub fn refuses(&self, formulation: &str, projection: &str) -> bool {
        formulation::named(formulation).is_some_and(|entry| (self.refuses)(entry, projection))
    }

    /// Whether it follows a vector field, as explicit methods do.
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
        hem::HEM3,
        hem::HEM4,
        hem::HEM5,
        phem56::ENTRY,
        radau_iia::ENTRY,
        rattle::ENTRY,
        generalized_alpha::ENTRY,
        ali3p::ENTRY,
        bdf::ENTRY,
        tr_bdf2::ENTRY,
        esdirk34::ENTRY,
    ]
}

/// The entry that `spec` stands for.
pub fn find(spec: &MethodSpec) -> Result<&'static Entry> {
    spec.entry(registry())
}
