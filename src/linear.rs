//! Linear models at a state or along a motion: their modes, loci, transition matrices, and their check by simulation.
//!
//! [`Model::linearize_at`](crate::run::Model::linearize_at) and [`linearize`] make a [`LinearModel`]. [`validate`] compares
//! one with perturbed simulations.
//!
//! ```
//! use holonom::linear::{State, at_rest, linearize};
//! use holonom::prelude::*;
//!
//! let pendulum = Model::load("models/pendulum.json")?;
//! let rest = at_rest(&pendulum, &State::start(&pendulum))?;
//! let model = linearize(&mut rest.variation()?, &Linear::default())?;
//! assert!(model.eigenvalues()[0].im.abs() > 1.0);
//! # Ok::<(), Error>(())
//! ```

#[doc(no_inline)]
pub use crate::linearize::Complex;
pub use crate::linearize::{
    Along, At, Branch, Chart, Floquet, Kind, Linear, LinearModel, LinearizationPoint, Loci, LociPoint, LociVariable,
    Lyapunov, Matrix, Mode, Operating, Reference, Sensitivity, State, Threshold, ThresholdKind, Transition, Variants,
    Variation, along, at_rest, floquet, frequency_response, linearize, loci_along, loci_over, lyapunov, states,
    transition,
};
pub use crate::math::eigen::ComplexMatrix;
#[doc(no_inline)]
pub use crate::study::Range;
pub use crate::validate::{
    Direction, PerturbationSequence, Settings, SpanCheck, Validation, Verdict, validate, validate_along,
};
