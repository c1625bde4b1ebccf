//! Time derivatives along a motion: a value with its first and second derivative.

use super::scalar::{Scalar, Unary};
use std::ops::{Add, AddAssign, Div, Mul, Neg, Sub, SubAssign};

/// x, x' and x'' at one instant. With q, q' and q'' (at v' = 0) in, phi gives phi, phi' and -gamma.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Taylor<S> {
    /// Value x.
    pub x: S,
    /// First time derivative x'.
    pub d: S,
    /// Second time derivative x''.
    pub dd: S,
}

impl<S: Scalar> Taylor<S> {
    /// The value `x` with x' = `d` and x'' = `dd`.
    #[inline]
    pub fn new(x: S, d: S, dd: S) -> Self {
        Taylor { x, d, dd }
    }
    /// A constant: x' = x'' = 0.
    #[inline]
    pub fn fixed(x: S) -> Self {
        Taylor { x, d: S::zero(), dd: S::zero() }
    }
    /// Time itself: t' = 1, t'' = 0.
    #[inline]
    pub fn time(t: f64) -> Self {
        Self::running(S::constant(t))
    }
    /// Time with value `t`, which may itself have derivatives: t' = 1, t'' = 0.
    #[inline]
    pub fn running(t: S) -> Self {
        Taylor { x: t, d: S::one(), dd: S::zero() }
    }
}

impl<S: Scalar> Scalar for Taylor<S> {
    #[inline]
    fn constant(x: f64) -> Self {
        Self::fixed(S::constant(x))
    }
    #[inline]
    fn value(&self) -> f64 {
        self.x.value()
    }
    fn bounds(&self) -> [f64; 2] {
        self.x.bounds()
    }
    #[inline]
    fn unary(self, function: Unary) -> Self {
        let [x, slope, curvature] = function.jet(self.x);
        Taylor { x, d: slope * self.d, dd: curvature * self.d.square() + slope * self.dd }
    }
    #[inline]
    fn compose(self, order: usize, derivative: &impl Fn(usize, [f64; 2]) -> [f64; 2]) -> Self {
        let [x, slope, curvature] = [0, 1, 2].map(|k| self.x.compose(order + k, derivative));
        Taylor { x, d: slope * self.d, dd: curvature * self.d.square() + slope * self.dd }
    }
    #[inline]
    fn sin_cos(self) -> (Self, Self) {
        let ((sin, cos), square) = (self.x.sin_cos(), self.d.square());
        let dd = (cos * self.dd - sin * square, -(sin * self.dd) - cos * square);
        (Taylor { x: sin, d: cos * self.d, dd: dd.0 }, Taylor { x: cos, d: -(sin * self.d), dd: dd.1 })
    }
}

impl<S: Scalar> Neg for Taylor<S> {
    type Output = Self;
    #[inline]
    fn neg(self) -> Self {
        Taylor { x: -self.x, d: -self.d, dd: -self.dd }
    }
}
impl<S: Scalar> Add for Taylor<S> {
    type Output = Self;
    #[inline]
    fn add(self, o: Self) -> Self {
        Taylor { x: self.x + o.x, d: self.d + o.d, dd: self.dd + o.dd }
    }
}
impl<S: Scalar> Sub for Taylor<S> {
    type Output = Self;
    #[inline]
    fn sub(self, o: Self) -> Self {
        Taylor { x: self.x - o.x, d: self.d - o.d, dd: self.dd - o.dd }
    }
}
impl<S: Scalar> Mul for Taylor<S> {
    type Output = Self;
    #[inline]
    fn mul(self, o: Self) -> Self {
        Taylor {
            x: self.x * o.x,
            d: self.d * o.x + self.x * o.d,
            dd: self.dd * o.x + self.d * o.d * 2.0 + self.x * o.dd,
        }
    }
}
impl<S: Scalar> Div for Taylor<S> {
    type Output = Self;
    #[inline]
    fn div(self, o: Self) -> Self {
        let inverse = o.x.recip();
        let x = self.x * inverse;
        let d = (self.d - x * o.d) * inverse;
        Taylor { x, d, dd: (self.dd - d * o.d * 2.0 - x * o.dd) * inverse }
    }
}
impl<S: Scalar> Add<f64> for Taylor<S> {
    type Output = Self;
    #[inline]
    fn add(self, x: f64) -> Self {
        Taylor { x: self.x + x, ..self }
    }
}
impl<S: Scalar> Sub<f64> for Taylor<S> {
    type Output = Self;
    #[inline]
    fn sub(self, x: f64) -> Self {
        Taylor { x: self.x - x, ..self }
    }
}
impl<S: Scalar> Mul<f64> for Taylor<S> {
    type Output = Self;
    #[inline]
    fn mul(self, x: f64) -> Self {
        Taylor { x: self.x * x, d: self.d * x, dd: self.dd * x }
    }
}
impl<S: Scalar> Div<f64> for Taylor<S> {
    type Output = Self;
    #[inline]
    fn div(self, x: f64) -> Self {
        Taylor { x: self.x / x, d: self.d / x, dd: self.dd / x }
    }
}
impl<S: Scalar> AddAssign for Taylor<S> {
    #[inline]
    fn add_assign(&mut self, o: Self) {
        *self = *self + o;
    }
}
impl<S: Scalar> SubAssign for Taylor<S> {
    #[inline]
    fn sub_assign(&mut self, o: Self) {
        *self = *self - o;
    }
}
