//! Forward-mode derivatives: a value with its derivatives along `N` directions.

use super::scalar::{Scalar, Unary, operators};
use crate::math::array::{Each, from_fn};

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
        Dual { re, eps: self.eps.each(|e| e * slope) }
    }
    #[inline]
    fn compose(self, order: usize, derivative: &impl Fn(usize, [f64; 2]) -> [f64; 2]) -> Self {
        let slope = self.re.compose(order + 1, derivative);
        Dual { re: self.re.compose(order, derivative), eps: self.eps.each(|e| e * slope) }
    }
    #[inline]
    fn sin_cos(self) -> (Self, Self) {
        let (sin, cos) = self.re.sin_cos();
        (Dual { re: sin, eps: self.eps.each(|e| e * cos) }, Dual { re: cos, eps: self.eps.each(|e| -(e * sin)) })
    }
}

operators! {
    impl[S: Scalar, const N: usize] Dual<S, N>:
    Neg neg(a) = Dual { re: -a.re, eps: a.eps.each(|e| -e) };
    Add add(a, b: Self) = Dual { re: a.re + b.re, eps: from_fn(|i| a.eps[i] + b.eps[i]) };
    Sub sub(a, b: Self) = Dual { re: a.re - b.re, eps: from_fn(|i| a.eps[i] - b.eps[i]) };
    Mul mul(a, b: Self) = Dual { re: a.re * b.re, eps: from_fn(|i| a.eps[i] * b.re + a.re * b.eps[i]) };
    Div div(a, b: Self) = {
        let inverse = b.re.recip();
        let re = a.re * inverse;
        Dual { re, eps: from_fn(|i| (a.eps[i] - re * b.eps[i]) * inverse) }
    };
    Add add(a, x: f64) = Dual { re: a.re + x, ..a };
    Mul mul(a, x: f64) = Dual { re: a.re * x, eps: a.eps.each(|e| e * x) };
    Div div(a, x: f64) = Dual { re: a.re / x, eps: a.eps.each(|e| e / x) };
}
