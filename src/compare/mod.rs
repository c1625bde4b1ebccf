//! Many simulations of one scene: with smaller steps, under every stabilization, by every method, over stress
//! parameters.

mod companion;
mod drift;
mod error_bar;
pub mod stress;
pub mod work_precision;

pub use companion::Completed;
#[doc(hidden)]
pub use drift::stabilizations;
pub use drift::{StabilizedRun, drift_under_stabilizations};
pub use error_bar::{ErrorBar, ErrorBars, error_bars};
