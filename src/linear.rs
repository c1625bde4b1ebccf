//! Linear models at a state or along a motion: their modes, loci, transition matrices, and their check by simulation.
//!
//! [`Model::linearize_at`](crate::run::Model::linearize_at) and [`linearize`] make a [`LinearModel`]. [`validate`] compares
//! one with perturbed simulations. These functions take a [`Model`](crate::run::Model) of a scene or own equations alike.
//!
//! ```
//! use holonom::linear::{State, at_rest};
//! use holonom::prelude::*;
//!
//! let pendulum = Model::load("models/pendulum.json")?;
//! let rest = at_rest(&pendulum, &State::start(&pendulum))?;
//! let model = rest.linearize(&Linear::default())?;
//! assert!(model.eigenvalues()[0].im.abs() > 1.0);
//! # Ok::<(), Error>(())
//! ```

pub use crate::linearize::{
    Linear, LinearModel, Matrix, State, along, at_rest, floquet, linearize, loci_along, loci_over, states, transition,
};
pub use crate::validate::{Validation, validate};
