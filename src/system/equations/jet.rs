//! phi with phi', gamma, G and phi_t in one evaluation.

use crate::math::{Scalar, Taylor, Unary};
use std::array::from_fn;
use std::ops::{Add, AddAssign, Div, Mul, Neg, Sub, SubAssign};

/// Directions in which a [`Jet`] is differentiated.
pub(super) const WIDTH: usize = 8;

/// A value with its first two time derivatives along a motion and its derivatives along [`WIDTH`] directions, so that
/// an elementary function is evaluated once for all of them.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Jet {
    pub path: Taylor<f64>,
    pub slope: [f64; WIDTH],
}

impl Jet {
    #[inline]
    pub fn fixed(path: Taylor<f64>) -> Self {
        Jet { path, slope: [0.0; WIDTH] }
    }
    /// The function with this value and slope at `self`.
    #[inline]
    fn chain(self, path: Taylor<f64>, slope: f64) -> Self {
        Jet { path, slope: self.slope.map(|e| slope * e) }
    }
}

impl Scalar for Jet {
    #[inline]
    fn constant(x: f64) -> Self {
        Jet::fixed(Taylor::fixed(x))
    }
    #[inline]
    fn value(&self) -> f64 {
        self.path.x
    }
    #[inline]
    fn unary(self, function: Unary) -> Self {
        let ([x, slope, curvature], Taylor { d, dd, .. }) = (function.jet(self.path.x), self.path);
        self.chain(Taylor::new(x, slope * d, curvature * (d * d) + slope * dd), slope)
    }
    #[inline]
    fn compose(self, order: usize, derivative: &impl Fn(usize, [f64; 2]) -> [f64; 2]) -> Self {
        self.chain(self.path.compose(order, derivative), self.path.x.compose(order + 1, derivative))
    }
    #[inline]
    fn sin_cos(self) -> (Self, Self) {
        let (sin, cos) = self.path.sin_cos();
        (self.chain(sin, cos.x), self.chain(cos, -sin.x))
    }
}

impl Neg for Jet {
    type Output = Self;
    #[inline]
    fn neg(self) -> Self {
        Jet { path: -self.path, slope: self.slope.map(|e| -e) }
    }
}
impl Add for Jet {
    type Output = Self;
    #[inline]
    fn add(self, o: Self) -> Self {
        Jet { path: self.path + o.path, slope: from_fn(|i| self.slope[i] + o.slope[i]) }
    }
}
impl Sub for Jet {
    type Output = Self;
    #[inline]
    fn sub(self, o: Self) -> Self {
        Jet { path: self.path - o.path, slope: from_fn(|i| self.slope[i] - o.slope[i]) }
    }
}
impl Mul for Jet {
    type Output = Self;
    #[inline]
    fn mul(self, o: Self) -> Self {
        let (x, y) = (self.path.x, o.path.x);
        Jet { path: self.path * o.path, slope: from_fn(|i| self.slope[i] * y + x * o.slope[i]) }
    }
}
impl Div for Jet {
    type Output = Self;
    #[inline]
    fn div(self, o: Self) -> Self {
        let (path, inverse) = (self.path / o.path, o.path.x.recip());
        Jet { path, slope: from_fn(|i| (self.slope[i] - path.x * o.slope[i]) * inverse) }
    }
}
impl Add<f64> for Jet {
    type Output = Self;
    #[inline]
    fn add(self, x: f64) -> Self {
        Jet { path: self.path + x, ..self }
    }
}
impl Sub<f64> for Jet {
    type Output = Self;
    #[inline]
    fn sub(self, x: f64) -> Self {
        Jet { path: self.path - x, ..self }
    }
}
impl Mul<f64> for Jet {
    type Output = Self;
    #[inline]
    fn mul(self, x: f64) -> Self {
        self.chain(self.path * x, x)
    }
}
impl Div<f64> for Jet {
    type Output = Self;
    #[inline]
    fn div(self, x: f64) -> Self {
        Jet { path: self.path / x, slope: self.slope.map(|e| e / x) }
    }
}
impl AddAssign for Jet {
    #[inline]
    fn add_assign(&mut self, o: Self) {
        *self = *self + o;
    }
}
impl SubAssign for Jet {
    #[inline]
    fn sub_assign(&mut self, o: Self) {
        *self = *self - o;
    }
}
