//! Linear models at any state of a trajectory.

mod chart;
mod independent;
mod minimal;
mod model;
mod point;
mod response;
mod variation;

pub use chart::{Chart, Coordinates};
pub use minimal::{Minimal, minimal};
pub use model::{Complex, Cost, Kind, LinearModel, Matrix, Mode};
pub use point::OperatingPoint;
pub use response::{Changes, Response};
pub use variation::Variation;
