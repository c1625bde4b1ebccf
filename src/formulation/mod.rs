//! What is integrated: ways to turn the constrained equations into something an integrator can step.
//!
//! To add one: a file with an [`Entry`], and a line in [`registry`]; from outside the crate, an [`Entry`] and its
//! [`spec`](Listed::spec), as in `tests/examples/own_formulation.rs`.

mod augmented_lagrangian;
mod baumgarte;
mod dae;
mod dense;
mod directions;
mod dynamics;
mod force_projection;
mod ggl;
mod index1;
mod index2;
mod index3;
mod invariant_manifold;
mod iteration;
mod linearized;
mod null_space;
mod penalty;
mod residual;
mod stabilized_index1;
mod stabilizer;
mod statistics;
mod turn;
mod udwadia_kalaba;

#[doc(hidden)]
use crate::method_spec::{MethodSpec, OptionDoc};
pub use dae::{Dae, Row};
#[doc(hidden)]
pub use directions::{degrees_of_freedom, free_directions, reduce};
pub use dynamics::{Dynamics, StepError};
#[doc(hidden)]
pub use iteration::{Change, Iteration, Number, Slopes};
#[doc(hidden)]
pub use linearized::{Linearized, NO_TANGENT};
#[doc(hidden)]
pub use penalty::{OMEGA, PENALTY, XI, mean_compliance};
pub use residual::Residual;
#[doc(hidden)]
#[doc(hidden)]
pub use residual::Unknowns;
#[doc(hidden)]
pub use stabilizer::{Stabilizer, StabilizingField};
pub use statistics::{Statistics, Work};
#[doc(hidden)]
pub use turn::turn;

use crate::error::Result;
use crate::method_spec::Listed;
use crate::system::MechanicalSystem;

/// A vector field (q', v') = F(t, q, v) whose solutions are the motions of the mechanism.
pub trait Formulation: Send {
    /// Writes q' and v'; leaves v' of the equations of motion and lambda in `dynamics`.
    fn derivative(
        &mut self,
        t: f64,
        q: &[f64],
        v: &[f64],
        dynamics: &mut Dynamics,
        qdot: &mut [f64],
        vdot: &mut [f64],
    ) -> Result<(), StepError>;

    /// Settles by the first state of a run what holds in all of it.
    fn settle(&mut self, _t: f64, _q: &[f64], _v: &[f64], _dynamics: &mut Dynamics) {}

    /// What is settled, as numbers that [`Self::recall`] takes.
    fn settled(&self) -> Vec<f64> {
        Vec::new()
    }

    /// Settles what was settled before.
    fn recall(&mut self, _settled: &[f64]) {}

    /// A step begins at a state of the motion: what follows are states within that step, until it ends.
    fn begin_step(&mut self, _t: f64, _q: &[f64], _v: &[f64], _dynamics: &mut Dynamics) -> Result<(), StepError> {
        Ok(())
    }

    /// Whether the end of a step is on the constraints without a projection.
    fn keeps_constraints(&self) -> bool {
        false
    }

    /// The step ends, or is left for a row of output, at what the integrator made of (q, v): writes the state of the
    /// motion that this stands for.
    fn end_step(&mut self, _t: f64, _q: &mut [f64], _v: &mut [f64], _dynamics: &mut Dynamics) -> Result<(), StepError> {
        Ok(())
    }
}

/// What to take where a dense formulation is too large.
const SPARSE: &str = "choose a sparse formulation, such as index1 with the projection manifold";

/// One formulation as the command line, the scene format and the table of methods know it.
pub struct Entry {
    /// Name in the scene format and on the command line.
    pub name: &'static str,
    /// One line for the table of methods.
    pub about: &'static str,
    /// The options of its specification.
    pub options: &'static [OptionDoc],
    /// The equations with multipliers, for methods that solve them; none where lambda is no unknown.
    pub dae: Option<fn(&MethodSpec) -> Result<Dae>>,
    /// The vector field, for methods that follow one; none where the constraints themselves are solved.
    pub field: Option<MakeField>,
}

/// Makes a vector field for a system.
pub type MakeField = fn(&MethodSpec, &dyn MechanicalSystem) -> Result<Box<dyn Formulation>>;

impl Entry {
    /// The equations with the default options.
    pub fn default_dae(&self) -> Option<Dae> {
        self.dae.and_then(|dae| dae(&MethodSpec::named(self.name)).ok())
    }
}

impl Listed for Entry {
    const KIND: &'static str = "formulation";

    fn name(&self) -> &'static str {
        self.name
    }

    fn options(&self) -> &'static [OptionDoc] {
        self.options
    }
}

/// Every formulation, in the order of the documentation.
pub fn registry() -> &'static [Entry] {
    &[
        index1::ENTRY,
        index2::ENTRY,
        index3::ENTRY,
        ggl::ENTRY,
        stabilized_index1::ENTRY,
        baumgarte::ENTRY,
        invariant_manifold::ENTRY,
        force_projection::ENTRY,
        penalty::ENTRY,
        augmented_lagrangian::ENTRY,
        udwadia_kalaba::ENTRY,
        null_space::ENTRY,
    ]
}

/// The entry of this name.
#[doc(hidden)]
pub fn named(name: &str) -> Option<&'static Entry> {
    registry().iter().find(|entry| entry.name == name)
}

/// The entry that `spec` stands for, with whatever options.
#[doc(hidden)]
pub fn lookup(spec: &MethodSpec) -> Option<&'static Entry> {
    spec.lookup(registry())
}

/// The equations with multipliers of the formulation that `spec` names, where it has them.
///
/// # Errors
/// Bad options.
#[doc(hidden)]
pub fn dae(spec: &MethodSpec) -> Result<Option<Dae>> {
    lookup(spec).and_then(|entry| entry.dae).map(|dae| dae(spec)).transpose()
}

/// The vector field of the formulation that `spec` names, for `system`. Where the constraints themselves are solved, it
/// is the one that observes: v' and lambda are those of the equations of motion at (q, v), and so of the order of q and
/// v.
pub fn make(spec: &MethodSpec, system: &dyn MechanicalSystem) -> Result<Box<dyn Formulation>> {
    spec.entry(registry())?.field.unwrap_or(|_, _| Ok(Box::new(index1::Index1::default())))(spec, system)
}
