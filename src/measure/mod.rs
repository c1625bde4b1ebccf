//! What a motion is judged by: drift, energy, statistics.

mod drift;
mod energy;
mod recorder;

pub use drift::{Drift, DriftLevel};
pub use energy::{EnergyBalance, EnergyMeter};
pub use recorder::{Record, Recorder};
