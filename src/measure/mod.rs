//! What a motion is judged by: drift, energy, statistics.

mod check_error;
mod drift;
mod energy;
mod range;
mod recorder;
mod scale;
mod singularity;
pub mod stress;
pub mod work_precision;

pub use check_error::{CheckError, Difference, closer};
pub use drift::{Drift, DriftLevel};
pub use energy::{EnergyBalance, EnergyMeter, Ledger};
pub use range::{Extreme, Range};
pub use recorder::{Record, Recorder};
pub use scale::{Sizes, scales};
pub use singularity::{Branch, Nearest, Passing, Singularity, dependent_beside};
