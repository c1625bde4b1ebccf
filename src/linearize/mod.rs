//! Linear models at any state of a trajectory.

mod loci;
mod model;

pub use loci::Branch;
pub use model::{Complex, Cost, Kind, LinearModel, Matrix, Mode, OperatingPoint};
