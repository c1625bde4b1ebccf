//! Linear models at any state of a trajectory.

mod along;
mod chart;
pub mod flow;
mod frequency;
mod independent;
mod loci;
mod matching;
mod method;
mod minimal;
mod model;
mod names;
mod point;
mod redundant;
mod response;
mod spectrum;
mod survey;
mod tracking;
mod transition;
mod unconstrained;
mod variation;

pub use along::{State, at_rest, states, tighten};
pub use chart::{Chart, Coordinates};
pub use frequency::{Resonances, frequency_response};
pub use loci::Branch;
pub use method::{Built, Entry, Request, linearize, registry};
pub use minimal::{Minimal, minimal};
pub use model::{Complex, Cost, Kind, LinearModel, Matrix, Mode, damping, frequency};
pub use point::OperatingPoint;
pub use response::{Changes, Response};
pub use survey::{Along, At, Gap, Loci, Reached, Variants, loci_along, loci_over};
pub use tracking::{Sample, track};
pub use transition::{Transition, transition};
pub use variation::Variation;
