//! Many simulations of one scene: with smaller steps, under every stabilization, by every method, over stress
//! parameters.
//!
//! | study | entry point | command |
//! |---|---|---|
//! | drift under every stabilization | [`drift_under_stabilizations`] | `drift` |
//! | speed for accuracy | [`Tradeoff`] | `tradeoff` |
//! | limits of a method over stress parameters | [`stress`](fn@stress) | `stress` |
//! | many variants, one table | [`Study`] | `study` |
//!
//! A [`Motion`] is run by a method within a [`Limit`]. Runs share all cores, and the time of a budget by one clock.

mod budget;
mod companion;
mod drift;
mod error_bar;
mod metric;
mod numbers;
pub(crate) mod pool;
pub(crate) mod price;
mod queue;
mod run;
mod second_opinion;
#[doc(hidden)]
pub mod stress;
#[doc(hidden)]
pub mod variants;
mod watched;
#[doc(hidden)]
pub mod work_precision;

pub use crate::sweep::Range;
pub(crate) use budget::Budget;
pub use budget::Limit;
#[doc(hidden)]
pub use companion::Completed;
#[doc(hidden)]
pub use drift::StabilizedRun;
pub use drift::drift_under_stabilizations;
#[doc(hidden)]
pub use drift::stabilizations;
#[doc(hidden)]
pub use error_bar::{ErrorBar, ErrorBars, error_bars};
#[doc(hidden)]
pub use metric::ErrorMetric;
#[doc(hidden)]
pub use metric::Norm;
#[doc(hidden)]
pub use run::Motion;
#[doc(hidden)]
pub use run::RunSample;
#[doc(hidden)]
pub use second_opinion::SecondOpinion;
pub(crate) use second_opinion::second_opinion;
#[doc(hidden)]
pub use stress::{
    Cell as StressCell, Limits as StressLimits, Status as StressStatus, Stressed, Subject, maps as stress_maps,
};
pub use stress::{Map as StressMap, stress};
#[doc(hidden)]
pub use variants::{Axis, Filling, Measure, Recorded, Sample, StudyRow};
pub use variants::{Plan, Study, StudyTable};
#[doc(hidden)]
pub use watched::Watched;
pub use work_precision::Runner as Tradeoff;
#[doc(hidden)]
pub use work_precision::{
    Cell as TradeoffCell, Filter, Held as TradeoffDrift, Outcome as TradeoffOutcome, Recommendation, TradeoffPlan,
    Triple, WorkPrecision, grid,
};
