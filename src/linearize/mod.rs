//! Linear models at any state of a trajectory.

mod along;
mod chart;
pub mod flow;
mod independent;
mod loci;
mod method;
mod minimal;
mod model;
mod names;
mod point;
mod redundant;
mod response;
mod singular;
mod spectrum;
mod transition;
mod unconstrained;
mod variation;

pub use along::{State, at_rest, states};
pub use chart::{Chart, Coordinates};
pub use loci::Branch;
pub use method::{Built, Entry, Request, linearize, registry};
pub use minimal::{Minimal, minimal};
pub use model::{Complex, Cost, Kind, LinearModel, Matrix, Mode};
pub use point::OperatingPoint;
pub use response::{Changes, Response};
pub use transition::{Transition, transition};
pub use variation::Variation;
