//! Methods of simulation: a formulation, an integrator and a projection by name, and own ones.
//!
//! A [`Method`] parses from text, as in `"index1 + dop853 + manifold"`; [the guide](crate::guide::methods) explains the
//! choice. An entry of one's own is a `static`, whose [`spec`](Listed::spec) a method takes like a built-in one.
//!
//! ```
//! use holonom::methods::Method;
//!
//! let method: Method = "ggl + radau_iia".parse()?;
//! assert_eq!(method.triple(), "ggl + radau_iia");
//! # Ok::<(), holonom::Error>(())
//! ```

pub use crate::formulation::{
    Dae, Dynamics, Entry as FormulationEntry, Formulation, MakeField as MakeFormulation, Row as DaeRow, StepError,
    registry as formulations,
};
pub use crate::integrator::{
    Accepted, Control, Dense, Entry as IntegratorEntry, ErrorEstimate, Explicit, From as StepStart, Integrator,
    Problem, Setup, Stability, Step, Steps, Tableau, Tightening, Tolerance, registry as integrators,
};
pub use crate::method_spec::{Listed, MethodSpec, OptionDoc};
pub use crate::projection::{Entry as ProjectionEntry, Projection, registry as projections};
pub use crate::simulate::Method;
