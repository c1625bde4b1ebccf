//! Maps over stress parameters: results of simulations with unusual steps, gains, masses, stiffness, tolerances,
//! speeds, sizes or times.
//!
//! A [`Map`] is two axes and the methods that are compared on them. Each of its cells is one simulation of a [`Case`],
//! the scene with the [`CellChange`]s of its entries, run under a deadline. A failure is a result, a skipped cell is none:
//! see [`Status`]. What completes is compared with an accurate run of the same motion.
//!
//! To add a stress parameter: an entry in [`registry`].

mod cell;
mod change;
mod gains;
mod ladder;
mod map;
mod maps;
mod parameters;
mod period;
mod reference;
mod run;
mod simulation;
mod subject;
mod verdict;

pub use cell::Cell;
#[doc(hidden)]
pub use cell::{CellQuantity, Status};
#[doc(hidden)]
pub use change::CellChange;
#[doc(hidden)]
pub use gains::{Best, Farther, GainRun, GainVerdict, Steady, StepVerdict};
pub use map::Map;
#[doc(hidden)]
pub use map::{AxisPlace, MapAxis};
#[doc(hidden)]
pub use maps::{MapEntry, known, maps, pair};
#[doc(hidden)]
pub use parameters::find;
pub use parameters::{StressParameter, registry};
pub use run::{Limits, Stressed, stress};
pub use subject::Subject;
#[doc(hidden)]
pub use subject::{Case, Typical};
#[doc(hidden)]
pub use verdict::{AxisSide, Bound, MethodVerdict, Reason};
