//! Work-precision measurements: the cost of every method for the digits it gives, on one motion.
//!
//! 1. A reference ([`Reference`]): the motion at least as accurate as the requested digits need, its error estimated by
//!    a second method of another family.
//! 2. A grid ([`grid`]): formulation x integrator x projection, each at a sequence of tolerances or steps. Methods that
//!    are far behind are not run at tighter ones, and the result says so.
//! 3. Costs ([`WorkPrecision::price`]): counted work times the CPU time of a unit of its kind, so that other load of
//!    the machine favours none.
//! 4. Recommendation ([`WorkPrecision::recommend`]): the cheapest run for a number of digits, and the next best.
//!
//! The cost and accuracy of richer models of the same mechanism are measured by [`models::compare`].
//!
//! Source of the diagrams: E. Hairer, G. Wanner, Solving Ordinary Differential Equations II, IV.10.

mod advice;
mod cell;
mod climb;
mod given;
mod grid;
pub mod models;
mod reference;
mod runner;
mod sequence;

pub use advice::Recommendation;
#[doc(hidden)]
pub use advice::{Lack, cheapest_by_method, front};
#[doc(hidden)]
pub use cell::Held;
pub use cell::{Cell, Outcome};
#[doc(hidden)]
pub use given::GivenValues;
pub use grid::{Filter, Triple, grid};
#[doc(hidden)]
pub use models::tighter;
#[doc(hidden)]
pub use reference::{Pace, Reference};
pub use runner::{Runner, TradeoffPlan};

use serde::{Deserialize, Serialize};

/// Results so far; they can be written, read again and continued.
#[derive(Clone, Debug, Default, Serialize, Deserialize)]
pub struct WorkPrecision {
    /// Name of the scene.
    pub scene: String,
    /// Identifies the motion when a measurement is continued.
    pub fingerprint: String,
    /// Start time, s.
    pub t_start: f64,
    /// End time, s.
    pub t_end: f64,
    /// Number of times at which motions are compared, after the start up to the end.
    pub rows: usize,
    /// Reference values; none before they are computed.
    #[doc(hidden)]
    pub reference: Option<Reference>,
    /// Runs by method, from loose to tight.
    pub cells: Vec<Cell>,
    /// Wall-clock time so far, s.
    pub seconds: f64,
    /// Runs skipped for lack of budget, if any.
    pub left_out: Option<String>,
}

impl WorkPrecision {
    /// A measurement without results.
    pub fn fresh(scene: &str, t_start: f64, t_end: f64, rows: usize) -> WorkPrecision {
        WorkPrecision { scene: scene.to_string(), t_start, t_end, rows, ..WorkPrecision::default() }
    }
}
