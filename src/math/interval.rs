//! Interval arithmetic: bounds on all values of a function over an interval of its argument.

use super::scalar::{Scalar, Unary, operators};
use std::f64::consts::{FRAC_PI_2, PI};

/// The numbers from `low` to `high`. Every operation gives an interval that contains all its results, up to rounding;
/// one without bounds gives all numbers. Source: Moore, Kearfott, Cloud, Introduction to Interval Analysis, 2.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Interval {
    pub low: f64,
    pub high: f64,
}

impl Interval {
    pub const WHOLE: Interval = Interval { low: f64::NEG_INFINITY, high: f64::INFINITY };

    /// From the smaller of two numbers to the larger; all numbers if one is NaN.
    pub fn new(a: f64, b: f64) -> Self {
        if a.is_nan() || b.is_nan() { Self::WHOLE } else { Interval { low: a.min(b), high: a.max(b) } }
    }

    pub fn width(&self) -> f64 {
        self.high - self.low
    }

    pub fn contains(&self, x: f64) -> bool {
        self.low <= x && x <= self.high
    }

    fn is_bounded(&self) -> bool {
        self.low.is_finite() && self.high.is_finite()
    }

    fn is_point(&self) -> bool {
        self.low == self.high
    }

    /// The values of an increasing function.
    fn rising(self, f: impl Fn(f64) -> f64) -> Self {
        Interval::new(f(self.low), f(self.high))
    }

    /// The values of sin(x), by the crests and troughs in the interval.
    fn sine(self) -> Self {
        if !self.is_bounded() || self.width() >= 2.0 * PI {
            return Interval { low: -1.0, high: 1.0 };
        }
        // True if a point phase + 2 pi k (a crest or a trough) lies in the interval.
        let passes = |phase: f64| {
            let count = |x: f64| ((x - phase) / (2.0 * PI)).floor();
            count(self.high) > count(self.low) || (self.low - phase).rem_euclid(2.0 * PI) == 0.0
        };
        let Interval { low, high } = self.rising(f64::sin);
        Interval { low: if passes(-FRAC_PI_2) { -1.0 } else { low }, high: if passes(FRAC_PI_2) { 1.0 } else { high } }
    }
}

impl Scalar for Interval {
    fn constant(x: f64) -> Self {
        Interval::new(x, x)
    }

    /// The middle of the interval.
    fn value(&self) -> f64 {
        if self.is_point() { self.low } else { 0.5 * self.low + 0.5 * self.high }
    }

    fn bounds(&self) -> [f64; 2] {
        [self.low, self.high]
    }

    fn unary(self, function: Unary) -> Self {
        match function {
            Unary::Sqrt if self.low < 0.0 => Self::WHOLE,
            Unary::Sqrt => self.rising(f64::sqrt),
            Unary::Sin => self.sine(),
            Unary::Cos => (self + FRAC_PI_2).sine(),
            Unary::Exp => self.rising(f64::exp),
            Unary::Ln if self.low <= 0.0 => Self::WHOLE,
            Unary::Ln => self.rising(f64::ln),
            // An unbounded argument comes from a quotient whose denominator passes zero.
            Unary::Atan if !self.is_bounded() => Self::WHOLE,
            Unary::Atan => self.rising(f64::atan),
            Unary::Sinh => self.rising(f64::sinh),
            Unary::Cosh => self.abs().rising(f64::cosh),
        }
    }

    fn compose(self, order: usize, derivative: &impl Fn(usize, [f64; 2]) -> [f64; 2]) -> Self {
        let [low, high] = derivative(order, self.bounds());
        Interval::new(low, high)
    }

    fn square(self) -> Self {
        self.abs().rising(|x| x * x)
    }

    fn recip(self) -> Self {
        if self.contains(0.0) { Self::WHOLE } else { Interval::new(1.0 / self.low, 1.0 / self.high) }
    }

    fn abs(self) -> Self {
        match self {
            _ if self.low >= 0.0 => self,
            _ if self.high <= 0.0 => -self,
            _ => Interval { low: 0.0, high: self.high.max(-self.low) },
        }
    }

    fn max(self, other: Self) -> Self {
        Interval { low: self.low.max(other.low), high: self.high.max(other.high) }
    }

    fn min(self, other: Self) -> Self {
        Interval { low: self.low.min(other.low), high: self.high.min(other.high) }
    }

    fn powi(self, n: i32) -> Self {
        match n {
            ..0 => self.powi(n.saturating_neg()).recip(),
            _ if n % 2 == 0 => self.abs().rising(|x| x.powi(n)),
            _ => self.rising(|x| x.powi(n)),
        }
    }
}

operators! {
    impl[] Interval:
    Neg neg(a) = Interval { low: -a.high, high: -a.low };
    Add add(a, b: Self) = {
        let low = a.low + b.low;
        let high = a.high + b.high;
        if low <= high { Interval { low, high } } else { Self::WHOLE }
    };
    Sub sub(a, b: Self) = a + -b;
    Mul mul(a, b: Self) = {
        // Zero times something without bounds is zero.
        let product = |x: f64, y: f64| if x == 0.0 || y == 0.0 { 0.0 } else { x * y };
        let low = Interval::new(product(a.low, b.low), product(a.low, b.high));
        let high = Interval::new(product(a.high, b.low), product(a.high, b.high));
        Interval { low: low.low.min(high.low), high: low.high.max(high.high) }
    };
    Div div(a, b: Self) = a * b.recip();
    Add add(a, x: f64) = a + Self::constant(x);
    Mul mul(a, x: f64) = a * Self::constant(x);
    Div div(a, x: f64) = a / Self::constant(x);
}
