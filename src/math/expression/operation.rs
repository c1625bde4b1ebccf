//! The operations of a program, over any scalar.
//!
//! Derivatives are those of the branch that the value is on, taken from the right at steps and breakpoints. Where a
//! factor of the chain rule would be 0 times infinity although the derivative is plain, the operation says so itself:
//! a function that has underflowed is constant, and a root of a constant zero is constant. Not a number goes through
//! every operation, comparisons included (but `x^0` is 1 for any x), so that it is noticed where the result is used.

use crate::math::Scalar;

/// An operation on one number.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) enum One {
    Neg,
    Not,
    Plus(f64),
    Times(f64),
    Over(f64),
    /// A whole power, exact at zero and at negative bases.
    Power(i32),
    Sin,
    Cos,
    Tan,
    Asin,
    Acos,
    Atan,
    Sinh,
    Cosh,
    Tanh,
    Exp,
    Ln,
    Log10,
    Sqrt,
    Abs,
    Sign,
    Step,
    Smoothstep,
}

/// An operation on two numbers.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) enum Two {
    Add,
    Sub,
    Mul,
    Div,
    Pow,
    Less,
    AtMost,
    Greater,
    AtLeast,
    Equal,
    Unequal,
    And,
    Or,
    Atan2,
    Min,
    Max,
    Hypot,
}

impl One {
    #[inline]
    pub fn apply<S: Scalar>(self, x: S) -> S {
        match self {
            One::Neg => -x,
            One::Not => truth(x.value() == 0.0, x, x),
            One::Plus(c) => x + c,
            One::Times(c) => x * c,
            One::Over(c) => x / c,
            One::Power(n) => whole_power(x, n),
            One::Sin => x.sin(),
            One::Cos => x.cos(),
            One::Tan => x.tan(),
            One::Asin => Two::Atan2.apply(x, root(complement(x))),
            One::Acos => Two::Atan2.apply(root(complement(x)), x),
            One::Atan => x.atan(),
            One::Sinh => x.sinh(),
            One::Cosh => x.cosh(),
            One::Tanh => tanh(x),
            One::Exp => settled(x.exp()),
            One::Ln => x.ln(),
            One::Log10 => log10(x),
            One::Sqrt => root(x),
            One::Abs => x.abs(),
            One::Sign => steps(x, -1.0, 0.0, 1.0),
            One::Step => steps(x, 0.0, 1.0, 1.0),
            One::Smoothstep => smoothstep(x),
        }
    }
}

impl Two {
    #[inline]
    pub fn apply<S: Scalar>(self, a: S, b: S) -> S {
        let (u, v) = (a.value(), b.value());
        match self {
            Two::Add => a + b,
            Two::Sub => a - b,
            Two::Mul => a * b,
            Two::Div => quotient(a, b),
            Two::Pow => power(a, b),
            Two::Less => truth(u < v, a, b),
            Two::AtMost => truth(u <= v, a, b),
            Two::Greater => truth(u > v, a, b),
            Two::AtLeast => truth(u >= v, a, b),
            Two::Equal => truth(u == v, a, b),
            Two::Unequal => truth(u != v, a, b),
            Two::And => truth(u != 0.0 && v != 0.0, a, b),
            Two::Or => truth(u != 0.0 || v != 0.0, a, b),
            Two::Atan2 if u == 0.0 && v == 0.0 => a * f64::MAX,
            // Adding zero makes -0 into 0: the angle of the negative x axis is pi, never -pi.
            Two::Atan2 => S::atan2(a + 0.0, b),
            Two::Min if v.is_nan() => b,
            Two::Min => a.min(b),
            Two::Max if v.is_nan() => b,
            Two::Max => a.max(b),
            Two::Hypot => hypot(a, b),
        }
    }
}

/// One for true and zero for false.
fn truth<S: Scalar>(holds: bool, a: S, b: S) -> S {
    let known = !a.value().is_nan() && !b.value().is_nan();
    S::constant(if known { f64::from(u8::from(holds)) } else { f64::NAN })
}

/// A function whose value has underflowed decays faster than any derivative in its chain can grow.
fn settled<S: Scalar>(y: S) -> S {
    if y.value() == 0.0 { S::zero() } else { y }
}

/// a/b. Where b is about to overflow, as in 1/(1 + exp(-100*t)), its derivatives may have done so already.
fn quotient<S: Scalar>(a: S, b: S) -> S {
    let plain = a.value() / b.value();
    if b.value().abs() > 1e280 && plain.abs() < 1e-200 { S::constant(plain) } else { a / b }
}

fn whole_power<S: Scalar>(x: S, n: i32) -> S {
    if n < 0 { quotient(S::one(), x.powi(n.saturating_neg())) } else { x.powi(n) }
}

/// The square root. Its slope at zero is infinite; the largest number stands for it, so that a constant zero has a
/// constant root and anything else shows.
fn root<S: Scalar>(x: S) -> S {
    if x.value() == 0.0 { x * f64::MAX } else { x.sqrt() }
}

/// x^y for x > 0, and for x = 0; not a number for x < 0, where it has no derivative by y.
fn power<S: Scalar>(x: S, y: S) -> S {
    match x.value() {
        0.0 => power_of_zero(x, y.value()),
        v if v < 0.0 || v.is_nan() || y.value().is_nan() => S::constant(f64::NAN),
        _ => settled(x.pow(y)),
    }
}

/// Derivatives up to the order of the exponent vanish; those above it are infinite, unless the exponent is whole.
fn power_of_zero<S: Scalar>(x: S, exponent: f64) -> S {
    if exponent > 0.0 {
        let slope = if exponent.fract() == 0.0 { 1.0 } else { f64::MAX };
        return x.powi(exponent.ceil().min(64.0) as i32) * slope;
    }
    S::constant(0.0_f64.powf(exponent))
}

/// 1 - x^2, without cancellation near -1 and 1.
fn complement<S: Scalar>(x: S) -> S {
    (S::one() - x) * (x + 1.0)
}

/// The quotient keeps all digits near zero, the scalar's own form cannot overflow; from 400 on it is constant.
fn tanh<S: Scalar>(x: S) -> S {
    match x.value().abs() {
        0.0..1.0 => x.sinh() / x.cosh(),
        400.0..=f64::INFINITY => S::constant(x.value().signum()),
        _ => x.tanh(),
    }
}

/// ln(x)/ln(10), with the value that is exact at powers of ten.
fn log10<S: Scalar>(x: S) -> S {
    let scaled = x.ln() * std::f64::consts::LOG10_E;
    let correction = x.value().log10() - scaled.value();
    if correction.is_finite() { scaled + correction } else { scaled }
}

fn steps<S: Scalar>(x: S, below: f64, at: f64, above: f64) -> S {
    S::constant(match x.value() {
        v if v < 0.0 => below,
        v if v > 0.0 => above,
        0.0 => at,
        _ => f64::NAN,
    })
}

/// 6 x^5 - 15 x^4 + 10 x^3 on (0, 1): slope and curvature vanish at both ends, so a prescribed motion built on it has
/// a continuous acceleration.
fn smoothstep<S: Scalar>(x: S) -> S {
    match x.value() {
        v if v <= 0.0 => S::zero(),
        v if v >= 1.0 => S::one(),
        _ => x.powi(3) * ((x * 6.0 - 15.0) * x + 10.0),
    }
}

/// sqrt(a^2 + b^2) without overflow on the way. At the origin, its tip, the derivatives are taken as zero.
fn hypot<S: Scalar>(a: S, b: S) -> S {
    if a.value() == 0.0 && b.value() == 0.0 {
        return S::zero();
    }
    let scale = a.value().abs().max(b.value().abs());
    let (a, b) = (a / scale, b / scale);
    (a * a + b * b).sqrt() * scale
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::math::Taylor;

    fn moving(x: f64) -> Taylor<f64> {
        Taylor::new(x, 2.0, 3.0)
    }

    #[test]
    fn not_a_number_goes_through_every_operation() {
        use {One::*, Two::*};
        let one = [
            Neg,
            Not,
            Plus(1.0),
            Power(-2),
            Power(3),
            Sin,
            Cos,
            Tan,
            Asin,
            Acos,
            Atan,
            Sinh,
            Cosh,
            Tanh,
            Exp,
            Ln,
            Log10,
            Sqrt,
            Abs,
            Sign,
            Step,
            Smoothstep,
        ];
        one.iter().for_each(|f| assert!(f.apply(f64::NAN).is_nan(), "{f:?}"));
        let two =
            [Add, Sub, Mul, Div, Pow, Less, AtMost, Greater, AtLeast, Equal, Unequal, And, Or, Atan2, Min, Max, Hypot];
        for f in two {
            assert!(f.apply(f64::NAN, 0.0).is_nan() && f.apply(1.0, f64::NAN).is_nan(), "{f:?}");
            assert!(f.apply(f64::NAN, 2.0).is_nan() && f.apply(2.0, f64::NAN).is_nan(), "{f:?}");
        }
    }

    #[test]
    fn roots_and_angles_of_a_constant_zero_are_constant() {
        let zero = Taylor::fixed(0.0);
        assert_eq!(One::Sqrt.apply(zero), zero);
        assert_eq!(Two::Pow.apply(zero, Taylor::fixed(1.5)), zero);
        assert_eq!(Two::Atan2.apply(zero, zero), zero);
        assert_eq!(Two::Hypot.apply(zero, zero), zero);
        assert_eq!(One::Asin.apply(Taylor::fixed(1.0)).d, 0.0);
        assert!(One::Sqrt.apply(moving(0.0)).d > 1e300, "an infinite slope must not pass for a finite one");
    }

    #[test]
    fn powers_of_a_moving_zero_have_the_derivatives_that_exist() {
        let power = |y: f64| Two::Pow.apply(moving(0.0), Taylor::fixed(y));
        assert_eq!(power(2.5), Taylor::fixed(0.0));
        assert_eq!((power(1.5).x, power(1.5).d), (0.0, 0.0));
        assert!(power(1.5).dd > 1e300);
        assert_eq!(power(2.0), Taylor::new(0.0, 0.0, 8.0));
        assert_eq!(power(0.0), Taylor::fixed(1.0));
        assert_eq!(power(-1.0).x, f64::INFINITY);
        assert_eq!(One::Power(0).apply(moving(0.0)), Taylor::fixed(1.0));
        assert_eq!(One::Power(1).apply(moving(0.0)), moving(0.0));
        assert_eq!(One::Power(2).apply(moving(0.0)), Taylor::new(0.0, 0.0, 8.0));
    }

    #[test]
    fn underflow_and_overflow_leave_derivatives_finite() {
        let finite = |y: Taylor<f64>| assert!(y.x.is_finite() && y.d.is_finite() && y.dd.is_finite(), "{y:?}");
        for x in [1e2, 7e2, 705.0, 709.7, 709.8, 1e3, 1e10, 1e160, 1e300] {
            finite(One::Exp.apply(-moving(x)));
            finite(One::Exp.apply(-One::Power(4).apply(moving(x))));
            finite(One::Tanh.apply(moving(x)));
            finite(Two::Div.apply(Taylor::fixed(1.0), One::Exp.apply(moving(x) * 100.0) + 1.0));
            finite(One::Power(-2).apply(One::Cosh.apply(moving(x))));
            finite(Two::Hypot.apply(moving(x), moving(x)));
        }
    }

    #[test]
    fn common_values_are_exact() {
        assert_eq!(One::Log10.apply(1000.0), 3.0);
        assert_eq!(One::Log10.apply(moving(1000.0)).x, 3.0);
        assert_eq!(One::Tanh.apply(1e-9_f64), 1e-9_f64.tanh());
        assert_eq!(Two::Hypot.apply(3.0, -4.0), 5.0);
        assert_eq!(Two::Atan2.apply(-0.0, -1.0), std::f64::consts::PI);
        assert_eq!(Two::Hypot.apply(3e300, 4e300), 5e300);
        assert_eq!(One::Power(-3).apply(10.0), 1e-3);
        assert_eq!([-2.0, 0.0, 3.0].map(|x| One::Sign.apply(x)), [-1.0, 0.0, 1.0]);
        assert_eq!([-2.0, 0.0, 3.0].map(|x| One::Step.apply(x)), [0.0, 1.0, 1.0]);
    }
}
