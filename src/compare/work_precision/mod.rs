//! Speed for accuracy: what every method costs for the digits it gives, on one motion.
//!
//! 1. A reference ([`Reference`]): the motion as good as the digits that are asked for need it, or better where that is
//!    cheap, its error told by a second method of another family.
//! 2. A grid ([`grid`]): formulation x integrator x projection, each at a sequence of tolerances or steps. Methods that have
//!    fallen far behind are not tried at tighter ones, and the result says so.
//! 3. Costs ([`WorkPrecision::price`]): counted work times the CPU time of a unit of its kind, so that what else the machine
//!    does favours none.
//! 4. What to choose ([`WorkPrecision::recommend`]): the cheapest run for so many digits, and the next best.
//!
//! What a richer model of the same mechanism costs and gives is measured by [`models::compare`].
//!
//! Source of the diagrams: E. Hairer, G. Wanner, Solving Ordinary Differential Equations II, IV.10.

mod advice;
mod cell;
mod climb;
mod error_metric;
mod given;
mod grid;
pub mod models;
mod reference;
mod runner;
mod sample;
mod sequence;
mod work;

pub use advice::Recommendation;
#[doc(hidden)]
pub use advice::{Lack, cheapest_by_method};
#[doc(hidden)]
#[doc(hidden)]
pub use cell::Held;
pub use cell::{Cell, Outcome};
#[doc(hidden)]
#[doc(hidden)]
pub use error_metric::ErrorMetric;
pub use error_metric::Watched;
#[doc(hidden)]
pub use given::Given;
pub use grid::{Filter, Triple, grid};
#[doc(hidden)]
pub use reference::{Pace, Reference};
pub use runner::{Plan, Runner};
pub use sample::Motion;
#[doc(hidden)]
pub use sample::{Allowed, RunSample, cpu_seconds, sample};

use serde::{Deserialize, Serialize};

/// What was measured so far; it can be written, read again and continued.
#[derive(Clone, Debug, Serialize, Deserialize)]
pub struct WorkPrecision {
    pub scene: String,
    /// Tells the same motion from another one when a measurement is continued.
    pub fingerprint: String,
    /// s
    pub t_start: f64,
    pub t_end: f64,
    /// Times at which motions are compared, between start and end and there.
    pub rows: usize,
    pub reference: Option<Reference>,
    /// By method, from loose to tight.
    pub cells: Vec<Cell>,
    /// Time spent so far, s.
    pub seconds: f64,
    /// What the budget left out, if anything.
    pub left_out: Option<String>,
}

impl WorkPrecision {
    /// Nothing measured yet.
    pub fn fresh(scene: &str, (t_start, t_end): (f64, f64), rows: usize) -> WorkPrecision {
        WorkPrecision {
            scene: scene.to_string(),
            fingerprint: String::new(),
            t_start,
            t_end,
            rows,
            reference: None,
            cells: Vec::new(),
            seconds: 0.0,
            left_out: None,
        }
    }
}
