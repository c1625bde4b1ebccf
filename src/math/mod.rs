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
pub(crate) mod newton;
pub(crate) mod polyline;
pub(crate) mod random;
mod regime;
#[doc(hidden)]
pub mod rotation;
mod scalar;
pub(crate) mod screw;
mod side;
pub(crate) mod signal;
mod taylor;
pub(crate) mod threads;
mod vector;

pub use dual::Dual;
#[doc(hidden)]
pub use dual::Rate;
pub(crate) use interval::Interval;
pub(crate) use lagrange::{lagrange, lagrange_rate};
pub(crate) use regime::{Piece, Thresholds, piece_of, piece_of_whole, whole_below};
pub use regime::{Regime, Time};
pub use scalar::Scalar;
pub(crate) use scalar::{Unary, operators};
pub(crate) use side::Side;
pub use taylor::Taylor;
#[doc(hidden)]
pub use vector::largest;
pub(crate) use vector::{add, add_scaled, all_finite, bounds, dot, index_of_largest, largest_in, norm};
