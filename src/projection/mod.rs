//! Projections: corrections after a step that move the state back to the constraints.
//!
//! To add one: a line in [`registry`], with a file where it is more than a choice of F; from outside the crate, a
//! [`ProjectionEntry`] and its [`spec`](Listed::spec), as in `tests/examples/own_projection.rs`.

mod exact;
mod post_stabilization;

use crate::error::Result;
use crate::formulation::{Dynamics, StepError};
use crate::method_spec::Listed;
use crate::method_spec::{MethodSpec, OptionDoc};
use crate::system::MechanicalSystem;

/// A correction of the state after a step, such as this one of `tests/examples/own_projection.rs`:
///
/// ```ignore
#[doc = include_str!("../../tests/examples/own_projection.rs")]
/// ```
pub trait Projection: Send {
    /// Corrects q and v in place.
    ///
    /// It may evaluate and factor `dynamics` at any state: what follows evaluates anew. Changes of q are N(q) times a
    /// direction in v, as [`MechanicalSystem::rate`] makes them, and [`MechanicalSystem::normalize`] follows.
    ///
    /// # Errors
    /// A state that cannot be corrected: the step is tried smaller, and a fixed one ends the run.
    fn project(&mut self, t: f64, q: &mut [f64], v: &mut [f64], dynamics: &mut Dynamics) -> Result<(), StepError>;
}

/// One projection as the command line, the scene format and the table of methods know it.
pub struct ProjectionEntry {
    /// Name in the scene format and on the command line.
    pub name: &'static str,
    /// One line for the table of methods.
    pub about: &'static str,
    /// The options of its specification.
    pub options: &'static [OptionDoc],
    /// Makes it for a system; `None` where states are not projected.
    pub make: Make,
}

type Make = fn(&MethodSpec, &dyn MechanicalSystem) -> Result<Option<Box<dyn Projection>>>;

impl Listed for ProjectionEntry {
    const KIND: &'static str = "projection";

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

/// Every projection, in the order of the documentation.
pub fn registry() -> &'static [ProjectionEntry] {
    &[
        NONE,
        post_stabilization::POSITION,
        post_stabilization::VELOCITY,
        post_stabilization::MANIFOLD,
        post_stabilization::FULL,
        exact::ENTRY,
    ]
}

const NONE: ProjectionEntry =
    ProjectionEntry { name: "none", about: "the state as the integrator left it", options: &[], make: |_, _| Ok(None) };

/// The projection that `spec` names, for `system`; `None` where there are no constraints.
pub fn make(spec: &MethodSpec, system: &dyn MechanicalSystem) -> Result<Option<Box<dyn Projection>>> {
    let made = (spec.entry::<ProjectionEntry>()?.make)(spec, system)?;
    Ok(made.filter(|_| system.dimensions().lambda > 0))
}

/// q -= N dq, with dq along the directions of v, then normalizes q.
fn move_back(q: &mut [f64], dq: &[f64], rate: &mut [f64], system: &dyn MechanicalSystem) {
    system.rate(q, dq, rate);
    q.iter_mut().zip(rate.iter()).for_each(|(q, rate)| *q -= rate);
    system.normalize(q);
}
