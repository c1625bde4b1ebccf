//! What is seen of a state or of one run: rank and redundancy, drift, energy balance,
//! singular states, range of the model.

mod drift;
mod energy;
mod range;
mod rank;
mod recorder;
mod scale;
mod singularity;

pub use drift::{Drift, DriftLevel};
pub use energy::{EnergyBalance, EnergyMeter, Ledger};
pub use range::{LargestDeformation, Range};
pub use rank::{Rank, Redundant, dependent_nearby};
pub use recorder::{Record, Recorder};
pub use scale::{Sizes, scales};
pub use singularity::{Branch, Nearest, Passing, Singularity};
