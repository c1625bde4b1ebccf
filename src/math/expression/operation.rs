//! The operations of a program, over any scalar.
//!
//! A piecewise operation is evaluated on one piece: that of its argument, or a prescribed one, see
//! [`Regime`](crate::math::Regime).
//!
//! Derivatives are those of the piece of the value, taken from the right at steps and breakpoints. Where a
//! product in the chain rule would be 0 times infinity although the derivative is known, the operation sets it itself:
//! a function that has underflowed is constant, and a root of a constant zero is constant. NaN propagates through
//! every operation, comparisons included (but `x^0` is 1 for any x), so that it is detected where the result is used.

use crate::math::{Piece, Scalar, Thresholds, piece_of, piece_of_whole, whole_below};

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
    Floor,
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
    /// a - b floor(a/b), of the sign of b.
    Mod,
}

impl One {
    /// True if the form changes with the argument.
    #[inline]
    pub fn is_piecewise(self) -> bool {
        self == One::Floor || !self.changes().is_empty()
    }

    /// Arguments at which the form changes; most operations have none.
    pub fn thresholds(self) -> Thresholds {
        if self == One::Floor { Thresholds::Whole } else { Thresholds::At(self.changes().into()) }
    }

    /// The thresholds that are listed.
    #[inline]
    fn changes(self) -> &'static [f64] {
        match self {
            One::Abs | One::Sign | One::Step => &[0.0],
            One::Smoothstep => &[0.0, 1.0],
            _ => &[],
        }
    }

    /// The piece of an argument; `None` where it has none, as for NaN.
    #[inline]
    pub fn piece(self, x: f64) -> Option<Piece> {
        let changes = self.changes();
        if self == One::Floor { piece_of_whole(x) } else { piece_of(x, changes.len(), |k| changes[k]) }
    }

    /// The operation on a piece of its form.
    #[inline]
    pub fn on<S: Scalar>(self, piece: Piece, x: S) -> S {
        match (self, piece) {
            (One::Abs, 0) => -x,
            (One::Abs, _) => x,
            (One::Sign, _) => S::constant(f64::from(piece) - 1.0),
            (One::Step, 0) | (One::Smoothstep, 0 | 1) => S::zero(),
            (One::Smoothstep, 2) => smoothstep(x),
            (One::Step | One::Smoothstep, _) => S::one(),
            (One::Floor, _) => S::constant(whole_below(piece)),
            (smooth, _) => smooth.apply(x),
        }
    }

    #[inline]
    pub fn apply<S: Scalar>(self, x: S) -> S {
        match self {
            One::Abs | One::Sign | One::Step | One::Smoothstep | One::Floor => {
                self.piece(x.value()).map_or(S::constant(f64::NAN), |piece| self.on(piece, x))
            }
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
        }
    }
}

impl Two {
    /// True if the form changes with the operands: where both are equal, or for `mod` where a/b is whole.
    #[inline]
    pub fn is_piecewise(self) -> bool {
        use Two::{AtLeast, AtMost, Equal, Greater, Less, Max, Min, Mod, Unequal};
        matches!(self, Less | AtMost | Greater | AtLeast | Equal | Unequal | Min | Max | Mod)
    }

    /// The [`argument`](Self::argument)s at which the form changes.
    pub fn thresholds(self) -> Thresholds {
        if self == Two::Mod { Thresholds::Whole } else { Thresholds::At([0.0].into()) }
    }

    /// The argument of a piecewise operation.
    #[inline]
    pub fn argument<S: Scalar>(self, a: S, b: S) -> S {
        if self == Two::Mod { quotient(a, b) } else { a - b }
    }

    /// The piece of a piecewise operation; `None` if one operand is NaN.
    #[inline]
    pub fn piece<S: Scalar>(self, a: S, b: S) -> Option<Piece> {
        if self == Two::Mod {
            return piece_of_whole(a.value() / b.value());
        }
        // Not by the difference, since infinities compare too.
        a.value().partial_cmp(&b.value()).map(|order| (order as i8 + 1) as Piece)
    }

    /// A piecewise operation on a given piece: 0 for a < b, 1 for a = b, 2 for a > b, but for `mod`.
    #[inline]
    pub fn on<S: Scalar>(self, piece: Piece, a: S, b: S) -> S {
        let truth = |holds: bool| S::constant(f64::from(u8::from(holds)));
        match self {
            Two::Less => truth(piece == 0),
            Two::AtMost => truth(piece <= 1),
            Two::Greater => truth(piece == 2),
            Two::AtLeast => truth(piece >= 1),
            Two::Equal => truth(piece == 1),
            Two::Unequal => truth(piece != 1),
            Two::Min if piece == 2 => b,
            Two::Max if piece == 0 => b,
            Two::Min | Two::Max => a,
            Two::Mod => a - b * whole_below(piece),
            smooth => smooth.apply(a, b),
        }
    }

    #[inline]
    pub fn apply<S: Scalar>(self, a: S, b: S) -> S {
        let u = a.value();
        let v = b.value();
        match self {
            Two::Add => a + b,
            Two::Sub => a - b,
            Two::Mul => a * b,
            Two::Div => quotient(a, b),
            Two::Pow => power(a, b),
            Two::And => truth(u != 0.0 && v != 0.0, a, b),
            Two::Or => truth(u != 0.0 || v != 0.0, a, b),
            Two::Atan2 if [a.bounds(), b.bounds()] == [[0.0; 2]; 2] => a * f64::MAX,
            // Adding zero makes -0 into 0: the angle of the negative x axis is pi, never -pi.
            Two::Atan2 => S::atan2(a + 0.0, b),
            Two::Hypot => hypot(a, b),
            compares => self.piece(a, b).map_or(S::constant(f64::NAN), |piece| compares.on(piece, a, b)),
        }
    }
}

/// 1 for true and 0 for false; NaN if an operand is NaN.
fn truth<S: Scalar>(holds: bool, a: S, b: S) -> S {
    let known = !a.value().is_nan() && !b.value().is_nan();
    S::constant(if known { f64::from(u8::from(holds)) } else { f64::NAN })
}

/// Makes a value that has underflowed to zero constant: it decreases faster than any derivative in its chain can grow.
fn settled<S: Scalar>(y: S) -> S {
    if y.bounds() == [0.0; 2] { S::zero() } else { y }
}

/// a/b. If b is about to overflow, as in 1/(1 + exp(-100*t)), its derivatives may have overflowed already.
fn quotient<S: Scalar>(a: S, b: S) -> S {
    let ([low, high], plain) = (b.bounds(), a.value() / b.value());
    if (low > 1e280 || high < -1e280) && plain.abs() < 1e-200 { S::constant(plain) } else { a / b }
}

fn whole_power<S: Scalar>(x: S, n: i32) -> S {
    if n < 0 { quotient(S::one(), x.powi(n.saturating_neg())) } else { x.powi(n) }
}

/// The square root. Its infinite slope at zero is replaced by the largest number, so that a constant zero has a
/// constant root and other derivatives are visibly huge.
fn root<S: Scalar>(x: S) -> S {
    if x.bounds() == [0.0; 2] { x * f64::MAX } else { x.sqrt() }
}

/// x^y for x >= 0; NaN for x < 0, where it has no derivative with respect to y.
fn power<S: Scalar>(x: S, y: S) -> S {
    match x.bounds() {
        [0.0, 0.0] => power_of_zero(x, y.value()),
        [_, high] if high < 0.0 || high.is_nan() || y.value().is_nan() => S::constant(f64::NAN),
        _ => settled(x.pow(y)),
    }
}

/// 0^y: derivatives up to the order of the exponent vanish; those above it are infinite, unless the exponent is whole.
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

/// tanh by the quotient near zero, which has all digits; by the scalar's own form, which cannot overflow; constant from
/// 400 on.
fn tanh<S: Scalar>(x: S) -> S {
    match x.bounds() {
        [low, high] if -1.0 < low && high < 1.0 => x.sinh() / x.cosh(),
        [low, high] if low >= 400.0 || high <= -400.0 => S::constant(x.value().signum()),
        _ => x.tanh(),
    }
}

/// ln(x)/ln(10), with a value that is exact at powers of ten.
fn log10<S: Scalar>(x: S) -> S {
    let scaled = x.ln() * std::f64::consts::LOG10_E;
    let correction = x.value().log10() - scaled.value();
    let [low, high] = x.bounds();
    if correction.is_finite() && low == high { scaled + correction } else { scaled }
}

/// 6 x^5 - 15 x^4 + 10 x^3: on (0, 1) slope and curvature vanish at both ends, so a prescribed motion built on it has
/// a continuous acceleration.
fn smoothstep<S: Scalar>(x: S) -> S {
    x.powi(3) * ((x * 6.0 - 15.0) * x + 10.0)
}

/// sqrt(a^2 + b^2) without overflow. At the origin, where it is not differentiable, the derivatives are taken as zero.
fn hypot<S: Scalar>(a: S, b: S) -> S {
    let sizes = [a.bounds(), b.bounds()];
    if sizes == [[0.0; 2]; 2] {
        return S::zero();
    }
    let scale = sizes.into_iter().flatten().fold(0.0, |scale: f64, x| scale.max(x.abs()));
    let a = a / scale;
    let b = b / scale;
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
        let numbered = [Plus(1.0), Power(-2), Power(3)];
        let named = [
            Neg, Not, Sin, Cos, Tan, Asin, Acos, Atan, Sinh, Cosh, Tanh, Exp, Ln, Log10, Sqrt, Abs, Sign, Step,
            Smoothstep, Floor,
        ];
        numbered.iter().chain(&named).for_each(|f| assert!(f.apply(f64::NAN).is_nan(), "{f:?}"));
        let two = [
            Add, Sub, Mul, Div, Pow, Less, AtMost, Greater, AtLeast, Equal, Unequal, And, Or, Atan2, Min, Max, Hypot,
            Mod,
        ];
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
