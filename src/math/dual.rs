//! Forward-mode derivatives: a value with its derivatives along `N` directions.

use super::scalar::{Scalar, Unary};
use std::array::from_fn;
use std::ops::{Add, AddAssign, Div, Mul, Neg, Sub, SubAssign};

/// re + sum_i eps_i e_i with e_i e_j = 0: `eps[i]` is the derivative of `re` along direction i.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Dual<S, const N: usize> {
    /// Value.
    pub re: S,
    /// Derivatives along the N directions.
    pub eps: [S; N],
}

/// A value with its rate along a motion.
pub type Rate = Dual<f64, 1>;

impl<S: Scalar, const N: usize> Dual<S, N> {
    /// The constant `re`.
    #[inline]
    pub fn fixed(re: S) -> Self {
        Dual { re, eps: [S::zero(); N] }
    }

    /// The value `re` with derivative one along direction `direction`.
    #[inline]
    pub fn seeded(re: S, direction: usize) -> Self {
        let mut number = Self::fixed(re);
        number.eps[direction] = S::one();
        number
    }
}

impl<S: Scalar, const N: usize> Scalar for Dual<S, N> {
    #[inline]
    fn constant(x: f64) -> Self {
        Self::fixed(S::constant(x))
    }
    #[inline]
    fn value(&self) -> f64 {
        self.re.value()
    }
    fn bounds(&self) -> [f64; 2] {
        self.re.bounds()
    }
    #[inline]
    fn unary(self, function: Unary) -> Self {
        let [re, slope] = function.slope(self.re);
        Dual { re, eps: self.eps.map(|e| e * slope) }
    }
    #[inline]
    fn compose(self, order: usize, derivative: &impl Fn(usize, [f64; 2]) -> [f64; 2]) -> Self {
        let slope = self.re.compose(order + 1, derivative);
        Dual { re: self.re.compose(order, derivative), eps: self.eps.map(|e| e * slope) }
    }
    #[inline]
    fn sin_cos(self) -> (Self, Self) {
        let (sin, cos) = self.re.sin_cos();
        (Dual { re: sin, eps: self.eps.map(|e| e * cos) }, Dual { re: cos, eps: self.eps.map(|e| -(e * sin)) })
    }
}

impl<S: Scalar, const N: usize> Neg for Dual<S, N> {
    type Output = Self;
    #[inline]
    fn neg(self) -> Self {
        Dual { re: -self.re, eps: self.eps.map(|e| -e) }
    }
}
impl<S: Scalar, const N: usize> Add for Dual<S, N> {
    type Output = Self;
    #[inline]
    fn add(self, o: Self) -> Self {
        Dual { re: self.re + o.re, eps: from_fn(|i| self.eps[i] + o.eps[i]) }
    }
}
impl<S: Scalar, const N: usize> Sub for Dual<S, N> {
    type Output = Self;
    #[inline]
    fn sub(self, o: Self) -> Self {
        Dual { re: self.re - o.re, eps: from_fn(|i| self.eps[i] - o.eps[i]) }
    }
}
impl<S: Scalar, const N: usize> Mul for Dual<S, N> {
    type Output = Self;
    #[inline]
    fn mul(self, o: Self) -> Self {
        Dual { re: self.re * o.re, eps: from_fn(|i| self.eps[i] * o.re + self.re * o.eps[i]) }
    }
}
impl<S: Scalar, const N: usize> Div for Dual<S, N> {
    type Output = Self;
    #[inline]
    fn div(self, o: Self) -> Self {
        let inverse = o.re.recip();
        let re = self.re * inverse;
        Dual { re, eps: from_fn(|i| (self.eps[i] - re * o.eps[i]) * inverse) }
    }
}
impl<S: Scalar, const N: usize> Add<f64> for Dual<S, N> {
    type Output = Self;
    #[inline]
    fn add(self, x: f64) -> Self {
        Dual { re: self.re + x, ..self }
    }
}
impl<S: Scalar, const N: usize> Sub<f64> for Dual<S, N> {
    type Output = Self;
    #[inline]
    fn sub(self, x: f64) -> Self {
        Dual { re: self.re - x, ..self }
    }
}
impl<S: Scalar, const N: usize> Mul<f64> for Dual<S, N> {
    type Output = Self;
    #[inline]
    fn mul(self, x: f64) -> Self {
        Dual { re: self.re * x, eps: self.eps.map(|e| e * x) }
    }
}
impl<S: Scalar, const N: usize> Div<f64> for Dual<S, N> {
    type Output = Self;
    #[inline]
    fn div(self, x: f64) -> Self {
        Dual { re: self.re / x, eps: self.eps.map(|e| e / x) }
    }
}
impl<S: Scalar, const N: usize> AddAssign for Dual<S, N> {
    #[inline]
    fn add_assign(&mut self, o: Self) {
        *self = *self + o;
    }
}
impl<S: Scalar, const N: usize> SubAssign for Dual<S, N> {
    #[inline]
    fn sub_assign(&mut self, o: Self) {
        *self = *self - o;
    }
}
