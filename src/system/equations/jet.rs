//! phi with phi', gamma, G and phi_t in one evaluation.

use crate::math::{Scalar, Taylor, Unary, operators};

/// A value with its first two time derivatives along a motion and its derivatives along `W` directions, so that an
/// elementary function is evaluated once for all of them.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Jet<const W: usize> {
    pub path: Taylor<f64>,
    pub slope: [f64; W],
}

impl<const W: usize> Jet<W> {
    #[inline]
    pub fn fixed(path: Taylor<f64>) -> Self {
        Jet { path, slope: [0.0; W] }
    }
    /// The function with this value and slope at `self`.
    #[inline]
    fn chain(self, path: Taylor<f64>, slope: f64) -> Self {
        Jet { path, slope: each(|i| slope * self.slope[i]) }
    }
}

/// A slope by its entries; a plain loop, since longer formulas are inlined with it.
#[inline(always)]
fn each<const W: usize>(entry: impl Fn(usize) -> f64) -> [f64; W] {
    let mut slope = [0.0; W];
    for (i, place) in slope.iter_mut().enumerate() {
        *place = entry(i);
    }
    slope
}

impl<const W: usize> Scalar for Jet<W> {
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

operators! {
    impl[const W: usize] Jet<W>:
    Neg neg(a) = Jet { path: -a.path, slope: each(|i| -a.slope[i]) };
    Add add(a, b: Self) = Jet { path: a.path + b.path, slope: each(|i| a.slope[i] + b.slope[i]) };
    Sub sub(a, b: Self) = Jet { path: a.path - b.path, slope: each(|i| a.slope[i] - b.slope[i]) };
    Mul mul(a, b: Self) = {
        let x = a.path.x;
        let y = b.path.x;
        Jet { path: a.path * b.path, slope: each(|i| a.slope[i] * y + x * b.slope[i]) }
    };
    Div div(a, b: Self) = {
        let path = a.path / b.path;
        let inverse = b.path.x.recip();
        Jet { path, slope: each(|i| (a.slope[i] - path.x * b.slope[i]) * inverse) }
    };
    Add add(a, x: f64) = Jet { path: a.path + x, ..a };
    Mul mul(a, x: f64) = a.chain(a.path * x, x);
    Div div(a, x: f64) = Jet { path: a.path / x, slope: each(|i| a.slope[i] / x) };
}
