//! Linear models against simulations of small perturbations.
//!
//! ```text
//! q(eps) = q + eps dq, v(eps) = v + eps dv, back on the constraints     both motions by the full equations
//! difference - eps X(t) x0          X the state-transition matrix: falls as eps^2 if K, C and Gdd are right (LTV)
//! difference / eps h                A, B, C and D for h, eps -> 0: each entry with its uncertainty
//! ```

mod deviation;
mod direction;
mod frozen;
mod horizon;
mod input;
mod limit;
mod measured;
mod order;
mod passage;
mod perturb;
mod probe;
mod regular;
mod run;
mod sequence;
mod span;
mod subject;

pub use deviation::{Deviation, MatrixEntry, Reason, Unjudged};
pub use direction::Direction;
#[doc(hidden)]
pub use frozen::Frozen;
#[doc(hidden)]
pub use horizon::horizon;
pub(crate) use input::InputCheck;
pub use measured::Measured;
#[doc(hidden)]
pub use order::{Decay, decay};
pub use passage::EventPassage;
#[doc(hidden)]
pub use run::validate_changed;
pub use run::{Event, Validation, Verdict, validate, validate_until};
pub use sequence::{ChangeCurve, PerturbationSequence};
pub use span::{SpanCheck, validate_along};

use crate::linearize::Chart;

/// Settings of a validation.
#[derive(Clone, Debug)]
pub struct Settings {
    /// Chart; none: the default of a linear model.
    pub chart: Option<Chart>,
    /// Directions of the perturbation.
    pub directions: Vec<Direction>,
    /// Time over which the perturbed motion is followed, s; none: about a period of the model.
    pub horizon: Option<f64>,
    /// True if inputs are checked too.
    pub inputs: bool,
}

impl Default for Settings {
    fn default() -> Self {
        Settings { chart: None, directions: vec![Direction::Random(1)], horizon: None, inputs: true }
    }
}
