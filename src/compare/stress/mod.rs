//! Maps over stress parameters: what becomes of a simulation where steps, gains, masses, stiffness, tolerances, speeds, sizes or
//! times are far from what is usual.
//!
//! A [`Map`] is two axes and the methods that are compared on them. Each of its cells is one simulation of a [`Case`],
//! the scene with the [`Change`]s of its place, run under a deadline. What fails is a result, what is left out is none: see
//! [`Status`]. What completes is compared with an accurate run of the same motion.
//!
//! To add a stress parameter: an entry in [`registry`].

mod cell;
mod change;
mod deadline;
mod gains;
mod json;
mod map;
mod maps;
mod parameters;
mod queue;
mod reference;
mod run;
mod simulation;
mod subject;
mod verdict;

pub use cell::{Cell, Quantity, Status};
pub use change::Change;
pub use deadline::Limits;
pub use gains::{Best, Farther, GainVerdict, Level, Steady, StepVerdict};
pub use map::{Axis, AxisPlace, Map};
pub use maps::{MapEntry, known, maps, pair};
pub use parameters::{StressParameter, find, registry, sequence};
pub use run::{Stressed, stress};
pub use subject::{Case, Subject, Typical};
pub use verdict::{Bound, Reason, Side, Verdict};
