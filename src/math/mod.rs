//! Numbers and linear algebra below the mechanics.

mod dual;
pub mod eigen;
pub mod expression;
mod interval;
pub mod kkt;
pub mod memory;
pub mod newton;
mod regime;
pub mod rotation;
mod scalar;
pub mod screw;
mod taylor;

pub use dual::{Dual, Rate};
pub use interval::Interval;
pub use regime::{Piece, Regime, Time, piece_of};
pub use scalar::{Scalar, Unary};
pub use taylor::Taylor;

/// max |x_i|, zero for none; what is not a number does not count.
pub fn largest(x: &[f64]) -> f64 {
    x.iter().fold(0.0, |largest, x| f64::max(largest, x.abs()))
}

/// max |x_i / units_i|, as [`largest`].
pub fn largest_in(units: &[f64], x: &[f64]) -> f64 {
    x.iter().zip(units).fold(0.0, |largest, (x, unit)| f64::max(largest, (x / unit).abs()))
}
