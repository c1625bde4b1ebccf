//! Formulations: forms of the constrained equations that an integrator can step.
//!
//! To add one: a file with a [`FormulationEntry`], and a line in [`registry`]; from outside the crate, a
//! [`FormulationEntry`] and its [`spec`](Listed::spec), as in `tests/examples/own_formulation.rs`.

mod augmented_lagrangian;
mod baumgarte;
mod dae;
mod dense;
mod directions;
mod dynamics;
mod exponential_map;
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
mod udwadia_kalaba;

use crate::method_spec::{MethodSpec, OptionDoc};
pub use dae::{Dae, DaeRow};
#[doc(hidden)]
pub use directions::{degrees_of_freedom, free_directions, reduce};
pub use dynamics::{Dynamics, Law, StepError};
#[doc(hidden)]
pub use exponential_map::ExponentialMap;
pub(crate) use exponential_map::rotate;
#[doc(hidden)]
pub use iteration::{Change, Iteration, Number, Slopes};
pub(crate) use linearized::write_diagonal;
#[doc(hidden)]
pub use linearized::{Linearized, NO_TANGENT, Point};
#[doc(hidden)]
pub(crate) use penalty::softer;
pub use penalty::{OMEGA, PENALTY, XI, mean_compliance};
pub use residual::Residual;
#[doc(hidden)]
pub use residual::Unknowns;
#[doc(hidden)]
pub use stabilizer::{Stabilizer, StabilizingField};
pub use statistics::{Statistics, Work};

use crate::error::Result;
use crate::method_spec::Listed;
use crate::system::MechanicalSystem;

/// A vector field (q', v') = F(t, q, v) whose solutions are the motions of the mechanism, such as this one of
/// `tests/examples/own_formulation.rs`:
///
/// ```ignore
#[doc = include_str!("../../tests/examples/own_formulation.rs")]
/// ```
pub trait Formulation: Send {
    /// Writes q' and v', and v' and lambda of the equations of motion to `dynamics`.
    fn derivative(
        &mut self,
        t: f64,
        q: &[f64],
        v: &[f64],
        dynamics: &mut Dynamics,
        qdot: &mut [f64],
        vdot: &mut [f64],
    ) -> Result<(), StepError>;

    /// Sets, from the first state of a run, the constants that the formulation uses in all of it.
    fn settle(&mut self, _t: f64, _q: &[f64], _v: &[f64], _dynamics: &mut Dynamics) {}

    /// These constants as numbers, for [`Self::recall`].
    fn settled(&self) -> Vec<f64> {
        Vec::new()
    }

    /// Restores the constants from [`Self::settled`].
    fn recall(&mut self, _settled: &[f64]) {}

    /// Announces a step that begins at a state of the motion: all states that follow are within the step, until it
    /// ends.
    fn begin_step(&mut self, _t: f64, _q: &[f64], _v: &[f64], _dynamics: &mut Dynamics) -> Result<(), StepError> {
        Ok(())
    }

    /// True if an evaluation factors dense matrices, so that its work grows with the cube of the velocities.
    fn is_dense(&self) -> bool {
        false
    }

    /// True if the end of a step satisfies the constraints without a projection.
    fn keeps_constraints(&self) -> bool {
        false
    }

    /// Replaces (q, v), as computed by the integrator at the end of a step or for an output row, by the state of the
    /// motion that it represents.
    fn end_step(&mut self, _t: f64, _q: &mut [f64], _v: &mut [f64], _dynamics: &mut Dynamics) -> Result<(), StepError> {
        Ok(())
    }
}

/// Hint for systems that are too large for a dense formulation.
pub(crate) const SPARSE: &str = "choose a sparse formulation, such as index1 with the projection manifold";

/// One formulation as the command line, the scene format and the table of methods know it.
pub struct FormulationEntry {
    /// Name in the scene format and on the command line.
    pub name: &'static str,
    /// One line for the table of methods.
    pub about: &'static str,
    /// The options of its specification.
    pub options: &'static [OptionDoc],
    /// The equations with multipliers, for methods that solve them; none where lambda is no unknown.
    pub dae: Option<fn(&MethodSpec) -> Result<Dae>>,
    /// The vector field, for methods that follow one; none where the constraints themselves are solved.
    pub field: Option<MakeFormulation>,
}

/// Makes a vector field for a system.
pub type MakeFormulation = fn(&MethodSpec, &dyn MechanicalSystem) -> Result<Box<dyn Formulation>>;

impl FormulationEntry {
    /// The equations with the default options.
    pub fn default_dae(&self) -> Option<Dae> {
        self.dae.and_then(|dae| dae(&MethodSpec::named(self.name)).ok())
    }
}

impl Listed for FormulationEntry {
    const KIND: &'static str = "formulation";

    fn registry() -> &'static [Self] {
        registry()
    }

    fn name(&self) -> &'static str {
        self.name
    }

    fn options(&self) -> &'static [OptionDoc] {
        self.options
    }
}

/// Every formulation, in the order of the documentation.
pub fn registry() -> &'static [FormulationEntry] {
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
pub fn named(name: &str) -> Option<&'static FormulationEntry> {
    registry().iter().find(|entry| entry.name == name)
}

/// The entry that `spec` names, whatever its options.
#[doc(hidden)]
pub fn lookup(spec: &MethodSpec) -> Option<&'static FormulationEntry> {
    spec.lookup()
}

/// The equations with multipliers of the formulation that `spec` names, where it has them.
///
/// # Errors
/// Bad options.
#[doc(hidden)]
pub fn dae(spec: &MethodSpec) -> Result<Option<Dae>> {
    lookup(spec).and_then(|entry| entry.dae).map(|dae| dae(spec)).transpose()
}

/// The vector field of the formulation that `spec` names, for `system`. For a formulation that solves the constraints
/// themselves it serves observation only: v' and lambda are those of the equations of motion at (q, v), and so of the
/// order of q and v.
pub fn make(spec: &MethodSpec, system: &dyn MechanicalSystem) -> Result<Box<dyn Formulation>> {
    spec.entry::<FormulationEntry>()?.field.unwrap_or(|_, _| Ok(Box::new(index1::Index1::default())))(spec, system)
}
