//! Numbers of the matrix: real ones, and complex ones for pairs of Runge-Kutta stages.

use faer::c64;
use faer::traits::ComplexField;
use std::ops::{AddAssign, Div, Mul, Sub, SubAssign};

/// `f64` or `c64`.
pub trait Field:
    ComplexField
    + Copy
    + Send
    + Sync
    + AddAssign
    + SubAssign
    + Sub<Output = Self>
    + Mul<Output = Self>
    + Div<Output = Self>
    + Mul<f64, Output = Self>
{
    /// Zero of the field.
    const ZERO: Self;

    /// `x` as a number of the field.
    fn real(x: f64) -> Self;

    /// The magnitude, up to a factor of two.
    fn size(self) -> f64;
}

impl Field for f64 {
    const ZERO: f64 = 0.0;

    fn real(x: f64) -> f64 {
        x
    }

    fn size(self) -> f64 {
        self.abs()
    }
}

impl Field for c64 {
    const ZERO: c64 = c64::new(0.0, 0.0);

    fn real(x: f64) -> c64 {
        c64::new(x, 0.0)
    }

    fn size(self) -> f64 {
        self.re.abs() + self.im.abs()
    }
}
