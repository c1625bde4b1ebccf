//! Many simulations of one scene: with smaller steps, under every stabilization, by every method, over stress
//! parameters.

mod check_error;
mod drift;
pub mod stress;
pub mod work_precision;

pub use check_error::{CheckError, Difference, check_error};
#[doc(hidden)]
pub use drift::stabilizations;
pub use drift::{StabilizedRun, drift_under_stabilizations};
