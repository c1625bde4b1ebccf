//! Methods of simulation: a formulation, an integrator and a projection by name.
//!
//! A [`Method`] parses from text, as in `"index1 + dop853 + manifold"`; [the guide](crate::guide::methods) explains the
//! choice. The traits of own methods are in [`research::methods`](crate::research::methods). An own method is known to
//! scenes by [`Elements::with_method`](crate::parts::Elements::with_method).
//!
//! ```
//! use holonom::methods::Method;
//!
//! let method: Method = "ggl + radau_iia".parse()?;
//! assert_eq!(method.triple(), "ggl + radau_iia");
//! # Ok::<(), holonom::Error>(())
//! ```

pub use crate::formulation::registry as formulations;
pub use crate::integrator::registry as integrators;
pub use crate::method_spec::MethodSpec;
pub use crate::projection::registry as projections;
pub use crate::simulate::Method;
