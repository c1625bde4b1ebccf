//! Numbers and linear algebra below the mechanics.

pub(crate) mod array;
mod dual;
#[doc(hidden)]
pub mod eigen;
pub mod expression;
mod interval;
#[doc(hidden)]
pub mod kkt;
mod lagrange;
#[doc(hidden)]
pub mod memory;
#[doc(hidden)]
pub mod newton;
mod regime;
#[doc(hidden)]
pub mod rotation;
mod scalar;
#[doc(hidden)]
pub mod screw;
mod side;
#[doc(hidden)]
pub mod signal;
mod taylor;
#[doc(hidden)]
pub mod threads;
mod vector;

pub use dual::Dual;
#[doc(hidden)]
pub use dual::Rate;
#[doc(hidden)]
pub use interval::Interval;
#[doc(hidden)]
pub use lagrange::{lagrange, lagrange_rate};
#[doc(hidden)]
pub use regime::{Piece, Thresholds, piece_of, piece_of_whole, whole_below};
pub use regime::{Regime, Time};
pub use scalar::Scalar;
#[doc(hidden)]
pub use scalar::Unary;
pub(crate) use scalar::operators;
#[doc(hidden)]
pub use side::Side;
pub use taylor::Taylor;
pub(crate) use vector::{add, add_scaled, bounds, dot, index_of_largest, norm};
#[doc(hidden)]
pub use vector::{all_finite, largest, largest_in};
