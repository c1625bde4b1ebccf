//! Own methods: the traits of integrators, formulations and projections, and what their functions take and return.
//!
//! An entry of one's own is a `static`, whose [`spec`](Listed::spec) a [`Method`](crate::methods::Method) takes like a
//! built-in one. [`Elements::with_method`](crate::parts::Elements::with_method) makes it known to scenes.
//! [The guide](crate::guide::rust) has a complete integrator, the pages of [`Projection`] and [`Formulation`] one each.

pub use crate::formulation::{Dae, DaeRow, Dynamics, Formulation, FormulationEntry, MakeFormulation, StepError};
pub use crate::integrator::{
    Accepted, Control, Dense, ErrorEstimate, Explicit, Integrator, IntegratorEntry, MakeIntegrator, Problem, Setup,
    Stability, Step, StepStart, Steps, Tableau, Tightening, Tolerance,
};
pub use crate::method_spec::{Listed, OptionDoc};
pub use crate::projection::{Projection, ProjectionEntry};
