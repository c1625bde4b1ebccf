//! Right sides of a solution.

use crate::math::array::Each;
use std::ops::{Add, Mul, Sub};

/// An entry of one right side, or of several side by side, for which a solution costs little more than for one.
pub trait Lanes: Copy + Default + Add<Output = Self> + Sub<Output = Self> + Mul<f64, Output = Self> {}

impl Lanes for f64 {}

/// Entries of two right sides.
#[derive(Clone, Copy, Default)]
pub struct Pair(pub [f64; 2]);

impl Lanes for Pair {}

impl Add for Pair {
    type Output = Self;
    #[inline(always)]
    fn add(self, Pair([a, b]): Self) -> Self {
        Pair([self.0[0] + a, self.0[1] + b])
    }
}

impl Sub for Pair {
    type Output = Self;
    #[inline(always)]
    fn sub(self, Pair([a, b]): Self) -> Self {
        Pair([self.0[0] - a, self.0[1] - b])
    }
}

impl Mul<f64> for Pair {
    type Output = Self;
    #[inline(always)]
    fn mul(self, factor: f64) -> Self {
        Pair(self.0.each(|x| x * factor))
    }
}
