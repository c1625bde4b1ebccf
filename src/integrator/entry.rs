//! What is known of an integrator before it is made.

use super::{Integrator, Stability, Tightening, refuses, takes};
use crate::error::{Error, Result};
use crate::formulation::{self, Dae};
use crate::method_spec::{Listed, MethodSpec, OptionDoc};
use crate::system::MechanicalSystem;

/// The system and the specifications for which an integrator is made.
pub struct Setup<'m, 's> {
    /// Its own name and options.
    pub integrator: &'m MethodSpec,
    /// Formulation with its options.
    pub formulation: &'m MethodSpec,
    /// The mechanism.
    pub system: &'s dyn MechanicalSystem,
    /// True for fixed steps.
    pub is_fixed: bool,
}

impl Setup<'_, '_> {
    /// Length of the flat state.
    pub fn len(&self) -> usize {
        let n = self.system.dimensions();
        n.q + n.v + 1 + self.system.facts().works.len()
    }

    /// True for a system without velocities.
    pub fn is_empty(&self) -> bool {
        self.system.dimensions().v == 0
    }

    /// The equations with multipliers of its formulation.
    pub(super) fn dae(&self) -> Result<Dae> {
        let refused = || Error::input(format!("{} cannot integrate {}", self.integrator.name, self.formulation.name));
        formulation::dae(self.formulation)?.ok_or_else(refused)
    }
}

/// Refuses a system that is too large for its matrix.
pub(super) fn no_memory() -> Error {
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
pub struct IntegratorEntry {
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
    pub solves: fn(&formulation::FormulationEntry) -> bool,
    /// True if a projection would cost it an order with a formulation.
    pub refuses: fn(&formulation::FormulationEntry, projection: &str) -> bool,
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
    /// Makes it for a system.
    pub make: MakeIntegrator,
}

/// Makes an integrator for a system, with memory for states of [`Setup::len`].
pub type MakeIntegrator = for<'s> fn(&Setup<'_, 's>) -> Result<Box<dyn Integrator + 's>>;

impl IntegratorEntry {
    /// A method of this order with fixed steps for vector fields, which goes with all projections; for struct update.
    pub const fn new(name: &'static str, about: &'static str, order: usize, make: MakeIntegrator) -> Self {
        IntegratorEntry {
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

impl Listed for IntegratorEntry {
    const KIND: &'static str = "integrator";

    fn registry() -> &'static [Self] {
        super::registry()
    }

    fn name(&self) -> &'static str {
        self.name
    }

    fn options(&self) -> &'static [OptionDoc] {
        self.options
    }
}
