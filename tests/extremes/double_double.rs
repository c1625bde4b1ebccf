//! Numbers of 32 digits as sums of two, for reference solutions whose round-off does not count.
//!
//! Source: Dekker, Numer. Math. 18 (1971) 224-242; Hida, Li, Bailey, ARITH-15 (2001) 155-162.

use std::ops::{Add, AddAssign, Div, Mul, Neg, Sub};

/// high + low, |low| <= ulp(high)/2.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Double(f64, f64);

impl Double {
    pub const ZERO: Double = Double(0.0, 0.0);

    pub fn value(self) -> f64 {
        self.0 + self.1
    }

    /// By one Newton step from the root of the leading part.
    pub fn sqrt(self) -> Double {
        let root = Double::from(self.0.sqrt());
        if self.0 == 0.0 { root } else { (root + self / root) * 0.5.into() }
    }
}

impl From<f64> for Double {
    fn from(x: f64) -> Double {
        Double(x, 0.0)
    }
}

fn two_sum(a: f64, b: f64) -> (f64, f64) {
    let sum = a + b;
    let part = sum - a;
    (sum, (a - (sum - part)) + (b - part))
}

fn quick(a: f64, b: f64) -> Double {
    let sum = a + b;
    Double(sum, b - (sum - a))
}

impl Add for Double {
    type Output = Double;
    fn add(self, other: Double) -> Double {
        let (sum, error) = two_sum(self.0, other.0);
        let (low, lost) = two_sum(self.1, other.1);
        let Double(sum, error) = quick(sum, error + low);
        quick(sum, error + lost)
    }
}

impl Neg for Double {
    type Output = Double;
    fn neg(self) -> Double {
        Double(-self.0, -self.1)
    }
}

impl Sub for Double {
    type Output = Double;
    fn sub(self, other: Double) -> Double {
        self + -other
    }
}

impl Mul for Double {
    type Output = Double;
    fn mul(self, other: Double) -> Double {
        let product = self.0 * other.0;
        let error = self.0.mul_add(other.0, -product);
        quick(product, error + (self.0 * other.1 + self.1 * other.0))
    }
}

impl Div for Double {
    type Output = Double;
    fn div(self, other: Double) -> Double {
        let first = self.0 / other.0;
        let rest = self - other * first.into();
        let second = rest.0 / other.0;
        let rest = rest - other * second.into();
        quick(first, second) + (rest.0 / other.0).into()
    }
}

impl AddAssign for Double {
    fn add_assign(&mut self, other: Double) {
        *self = *self + other;
    }
}

#[test]
fn sums_products_quotients_and_roots_have_31_digits() {
    let third = Double::from(1.0) / 3.0.into();
    let two = Double::from(2.0);
    assert!((third * 3.0.into() - 1.0.into()).value().abs() < 1e-31);
    assert!((two.sqrt() * two.sqrt() - two).value().abs() < 1e-31);
    assert!(((third + 1e10.into()) - 1e10.into() - third).value().abs() < 1e-21);
}
