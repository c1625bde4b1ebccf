//! Time derivatives along a motion: a value with its first and second derivative.

use super::scalar::{Scalar, Unary, operators};

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
        let x = self.x.compose(order, derivative);
        let slope = self.x.compose(order + 1, derivative);
        let curvature = self.x.compose(order + 2, derivative);
        Taylor { x, d: slope * self.d, dd: curvature * self.d.square() + slope * self.dd }
    }
    #[inline]
    fn sin_cos(self) -> (Self, Self) {
        let ((sin, cos), square) = (self.x.sin_cos(), self.d.square());
        let dd = (cos * self.dd - sin * square, -(sin * self.dd) - cos * square);
        (Taylor { x: sin, d: cos * self.d, dd: dd.0 }, Taylor { x: cos, d: -(sin * self.d), dd: dd.1 })
    }
}

operators! {
    impl[S: Scalar] Taylor<S>:
    Neg neg(a) = Taylor { x: -a.x, d: -a.d, dd: -a.dd };
    Add add(a, b: Self) = Taylor { x: a.x + b.x, d: a.d + b.d, dd: a.dd + b.dd };
    Sub sub(a, b: Self) = Taylor { x: a.x - b.x, d: a.d - b.d, dd: a.dd - b.dd };
    Mul mul(a, b: Self) = Taylor {
        x: a.x * b.x,
        d: a.d * b.x + a.x * b.d,
        dd: a.dd * b.x + a.d * b.d * 2.0 + a.x * b.dd,
    };
    Div div(a, b: Self) = {
        let inverse = b.x.recip();
        let x = a.x * inverse;
        let d = (a.d - x * b.d) * inverse;
        Taylor { x, d, dd: (a.dd - d * b.d * 2.0 - x * b.dd) * inverse }
    };
    Add add(a, x: f64) = Taylor { x: a.x + x, ..a };
    Mul mul(a, x: f64) = Taylor { x: a.x * x, d: a.d * x, dd: a.dd * x };
    Div div(a, x: f64) = Taylor { x: a.x / x, d: a.d / x, dd: a.dd / x };
}
