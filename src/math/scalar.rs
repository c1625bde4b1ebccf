//! The scalar types that elements are evaluated over.
//!
//! An element states its equations once, generic over [`Scalar`]; the number put in decides what comes out: values
//! (`f64`), derivatives with respect to coordinates ([`Dual`](super::Dual)), or time derivatives along a motion
//! ([`Taylor`](super::Taylor)). The kinds nest: `Dual<Taylor<f64>, 6>` gives d(phi, phi', phi'')/dq.

use std::fmt::Debug;
use std::ops::{Add, AddAssign, Div, Mul, Neg, Sub, SubAssign};

/// The operators of a number of this type from their formulas; a - x with a plain x, += and -= follow from them.
macro_rules! operators {
    (impl $generics:tt $number:ty: $($operator:ident $name:ident($a:ident $(, $b:ident: $other:ty)?) = $value:expr;)*) => {
        $($crate::math::operators!(@$generics $number, $operator $(<$other>)?, $name($a $(, $b: $other)?) { $value });)*
        $crate::math::operators!(@$generics $number, Sub<f64>, sub(a, x: f64) { a + -x });
        $crate::math::operators!(@@$generics $number, AddAssign, add_assign, +);
        $crate::math::operators!(@@$generics $number, SubAssign, sub_assign, -);
    };
    (@[$($generics:tt)*] $number:ty, $operator:ident $(<$other:ty>)?, $name:ident($a:ident $(, $b:ident: $of:ty)?) $body:block) => {
        impl<$($generics)*> std::ops::$operator $(<$other>)? for $number {
            type Output = Self;
            #[inline]
            fn $name(self $(, $b: $of)?) -> Self {
                let $a = self;
                $body
            }
        }
    };
    (@@[$($generics:tt)*] $number:ty, $operator:ident, $name:ident, $sign:tt) => {
        impl<$($generics)*> std::ops::$operator for $number {
            #[inline]
            fn $name(&mut self, other: Self) {
                *self = *self $sign other;
            }
        }
    };
}
pub(crate) use operators;

/// A number that the equations of an element can be evaluated over.
pub trait Scalar:
    Copy
    + Debug
    + PartialEq
    + Send
    + Sync
    + 'static
    + Neg<Output = Self>
    + Add<Output = Self>
    + Sub<Output = Self>
    + Mul<Output = Self>
    + Div<Output = Self>
    + Add<f64, Output = Self>
    + Sub<f64, Output = Self>
    + Mul<f64, Output = Self>
    + Div<f64, Output = Self>
    + AddAssign
    + SubAssign
{
    /// The constant `x`: all its derivatives are zero.
    fn constant(x: f64) -> Self;

    /// The plain value; branches of an expression are decided on it.
    fn value(&self) -> f64;

    /// The least and the largest plain value; they differ for an `Interval` only.
    fn bounds(&self) -> [f64; 2] {
        [self.value(); 2]
    }

    /// f(self) by the chain rule over the nested scalar.
    #[doc(hidden)]
    fn unary(self, function: Unary) -> Self;

    /// The derivative of order `order` of a function at `self`: `derivative` gives bounds on those of any order between
    /// two plain values, which are the same twice but for an `Interval`.
    fn compose(self, order: usize, derivative: &impl Fn(usize, [f64; 2]) -> [f64; 2]) -> Self;

    /// The constant 0.
    fn zero() -> Self {
        Self::constant(0.0)
    }
    /// The constant 1.
    fn one() -> Self {
        Self::constant(1.0)
    }
    /// x^2.
    fn square(self) -> Self {
        self * self
    }
    /// 1/x.
    fn recip(self) -> Self {
        Self::one() / self
    }
    /// Square root.
    fn sqrt(self) -> Self {
        self.unary(Unary::Sqrt)
    }
    /// Sine; x in rad.
    fn sin(self) -> Self {
        self.unary(Unary::Sin)
    }
    /// Cosine; x in rad.
    fn cos(self) -> Self {
        self.unary(Unary::Cos)
    }
    /// Sine and cosine; x in rad.
    #[inline]
    fn sin_cos(self) -> (Self, Self) {
        (self.sin(), self.cos())
    }
    /// e^x.
    fn exp(self) -> Self {
        self.unary(Unary::Exp)
    }
    /// Natural logarithm.
    fn ln(self) -> Self {
        self.unary(Unary::Ln)
    }
    /// Arc tangent, rad, in (-pi/2, pi/2).
    fn atan(self) -> Self {
        self.unary(Unary::Atan)
    }
    /// Tangent, as sin/cos.
    fn tan(self) -> Self {
        let (s, c) = self.sin_cos();
        s / c
    }
    /// Hyperbolic sine.
    fn sinh(self) -> Self {
        self.unary(Unary::Sinh)
    }
    /// Hyperbolic cosine.
    fn cosh(self) -> Self {
        self.unary(Unary::Cosh)
    }
    /// 1 - 2/(e^{2x} + 1), with the exponent's sign chosen so that it cannot overflow.
    fn tanh(self) -> Self {
        if self.value() < 0.0 {
            return -(-self).tanh();
        }
        let decay = (self * -2.0).exp();
        (Self::one() - decay) / (decay + 1.0)
    }
    /// Arc sine, rad, as atan2(x, sqrt(1 - x^2)).
    fn asin(self) -> Self {
        Self::atan2(self, ((Self::one() - self) * (self + 1.0)).sqrt())
    }
    /// Arc cosine, rad, as atan2(sqrt(1 - x^2), x).
    fn acos(self) -> Self {
        Self::atan2(((Self::one() - self) * (self + 1.0)).sqrt(), self)
    }
    /// |x|; its derivative at 0 is that of x.
    fn abs(self) -> Self {
        if self.value() < 0.0 { -self } else { self }
    }
    /// Larger by value; the first where both are equal.
    fn max(self, other: Self) -> Self {
        if other.value() > self.value() { other } else { self }
    }
    /// Smaller by value; the first where both are equal.
    fn min(self, other: Self) -> Self {
        if other.value() < self.value() { other } else { self }
    }
    /// Angle of the vector (x, y) in (-pi, pi]. The branch is a constant; the derivative is that of atan.
    fn atan2(y: Self, x: Self) -> Self {
        let angle = y.value().atan2(x.value());
        // Rotate the vector by the known angle: the remaining angle is near zero, where atan is smooth and exact.
        let (s, c) = angle.sin_cos();
        ((y * c - x * s) / (x * c + y * s)).atan() + angle
    }
    /// x^n by repeated squaring; exact at x = 0, where a logarithm would not be.
    fn powi(self, n: i32) -> Self {
        let mut base = self;
        let mut left = n.unsigned_abs();
        let mut power = Self::one();
        while left > 0 {
            if left & 1 == 1 {
                power = power * base;
            }
            base = base.square();
            left >>= 1;
        }
        if n < 0 { power.recip() } else { power }
    }
    /// x^y for x > 0; for whole constants y, [`powi`](Self::powi) takes any base.
    fn pow(self, exponent: Self) -> Self {
        (exponent * self.ln()).exp()
    }
}

/// The elementary functions, each with its first two derivatives over any scalar.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Unary {
    Sqrt,
    Sin,
    Cos,
    Exp,
    Ln,
    Atan,
    Sinh,
    Cosh,
}

impl Unary {
    /// f, f' and f'' at `x`, over any scalar.
    #[inline]
    pub fn jet<S: Scalar>(self, x: S) -> [S; 3] {
        match self {
            Unary::Sqrt => {
                let root = x.sqrt();
                let slope = S::constant(0.5) / root;
                [root, slope, slope / x * -0.5]
            }
            Unary::Sin => {
                let (sin, cos) = x.sin_cos();
                [sin, cos, -sin]
            }
            Unary::Cos => {
                let (sin, cos) = x.sin_cos();
                [cos, -sin, -cos]
            }
            Unary::Exp => [x.exp(); 3],
            Unary::Ln => [x.ln(), x.recip(), -x.square().recip()],
            Unary::Atan => {
                let slope = (x.square() + 1.0).recip();
                [x.atan(), slope, x * slope.square() * -2.0]
            }
            Unary::Sinh => [x.sinh(), x.cosh(), x.sinh()],
            Unary::Cosh => [x.cosh(), x.sinh(), x.cosh()],
        }
    }

    /// f and f' at `x`.
    #[inline]
    pub fn slope<S: Scalar>(self, x: S) -> [S; 2] {
        let [f, df, _] = self.jet(x);
        [f, df]
    }
}

impl Scalar for f64 {
    #[inline]
    fn constant(x: f64) -> Self {
        x
    }
    #[inline]
    fn value(&self) -> f64 {
        *self
    }
    #[inline]
    fn unary(self, function: Unary) -> Self {
        match function {
            Unary::Sqrt => f64::sqrt(self),
            Unary::Sin => f64::sin(self),
            Unary::Cos => f64::cos(self),
            Unary::Exp => f64::exp(self),
            Unary::Ln => f64::ln(self),
            Unary::Atan => f64::atan(self),
            Unary::Sinh => f64::sinh(self),
            Unary::Cosh => f64::cosh(self),
        }
    }
    #[inline]
    fn compose(self, order: usize, derivative: &impl Fn(usize, [f64; 2]) -> [f64; 2]) -> Self {
        derivative(order, [self; 2])[0]
    }
    #[inline]
    fn sin_cos(self) -> (Self, Self) {
        f64::sin_cos(self)
    }
    fn atan2(y: Self, x: Self) -> Self {
        f64::atan2(y, x)
    }
    fn powi(self, n: i32) -> Self {
        f64::powi(self, n)
    }
    fn pow(self, exponent: Self) -> Self {
        f64::powf(self, exponent)
    }
}
