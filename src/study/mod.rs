//! Many simulations of one scene: with smaller steps, under every stabilization, by every method, over stress
//! parameters.
//!
//! A [`Motion`] is run by a method within a [`Limit`]; a [`RunSample`] is the result, an [`ErrorMetric`] its difference
//! from a reference. Runs share all cores, and the time of a budget by one clock.

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
pub mod stress;
pub mod variants;
mod watched;
pub mod work_precision;

pub(crate) use budget::Budget;
pub use budget::Limit;
pub use companion::Completed;
#[doc(hidden)]
pub use drift::stabilizations;
pub use drift::{StabilizedRun, drift_under_stabilizations};
pub use error_bar::{ErrorBar, ErrorBars, error_bars};
#[doc(hidden)]
pub use metric::ErrorMetric;
pub use metric::Norm;
pub use run::{Motion, RunSample};
pub use second_opinion::SecondOpinion;
pub(crate) use second_opinion::second_opinion;
pub use watched::Watched;
