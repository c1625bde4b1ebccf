//! Linear models at any state of a trajectory.

mod model;

pub use model::{Complex, Cost, Kind, LinearModel, Matrix, Mode, OperatingPoint};
