//! Analysis of a state or of one run: rank and redundancy, drift, energy balance, singular states, range of validity of
//! the models.

mod divergence;
mod drift;
mod energy;
mod extremes;
mod held;
mod ledger;
mod range;
mod rank;
mod recorder;
mod scale;
mod series;
mod singularity;
mod thinned;

pub use drift::{Drift, DriftLevel};
pub use energy::EnergyBalance;
#[doc(hidden)]
pub use energy::{WorstRow, WorstStep};
pub use extremes::Extremes;
#[doc(hidden)]
pub use ledger::Ledger;
#[doc(hidden)]
pub use range::ValidityRange;
pub use rank::Rank;
#[doc(hidden)]
pub use rank::{Redundant, dependent_nearby};
pub(crate) use recorder::MOST_JUMPS;
pub use recorder::{OutputRow, Record, Recorder};
#[doc(hidden)]
pub use scale::{Sizes, scales};
pub use series::Series;
#[doc(hidden)]
pub use singularity::{Nearest, SingularityBranch, SingularityWatch};
pub use singularity::{Passing, Singularity};
pub(crate) use thinned::thin;
