//! Values, slopes and curvatures against closed forms, through all kinds of numbers.

use super::parse;
use crate::math::{Dual, Taylor};

type Jet = [f64; 3];

/// Compares f, f' and f'' of `text` in x with closed forms, through Taylor, Dual and both nested.
fn check(text: &str, points: &[f64], exact: impl Fn(f64) -> Jet) {
    let expression = parse(text);
    let near =
        |a: f64, b: f64, what: &str| assert!((a - b).abs() <= 2e-13 * (1.0 + b.abs()), "{what} of {text}: {a} {b}");
    for &x in points {
        let [f, d, dd] = exact(x);
        let v = 1.3;
        let a = -0.7;
        near(expression.eval(&[x]), f, "value");
        let motion = expression.eval(&[Taylor::new(x, v, a)]);
        near(motion.x, f, "value");
        near(motion.d, d * v, "rate");
        near(motion.dd, dd * v * v + d * a, "second rate");
        let slope = expression.eval(&[Dual::<f64, 2> { re: x, eps: [1.0, -2.0] }]);
        near(slope.eps[0], d, "slope");
        near(slope.eps[1], -2.0 * d, "slope");
        let nested = expression.eval(&[Dual::<Taylor<f64>, 1>::seeded(Taylor::new(x, v, a), 0)]);
        near(nested.eps[0].x, d, "slope");
        near(nested.eps[0].d, dd * v, "rate of the slope");
    }
}

#[test]
fn derivatives_of_elementary_functions() {
    let wide = [-2.3, -0.4, 0.0, 0.7, 3.1];
    let inner = [-0.9, -0.3, 0.0, 0.5, 0.99];
    let positive = [1e-3, 0.5, 1.0, 20.0];
    check("sin(x)", &wide, |x| [x.sin(), x.cos(), -x.sin()]);
    check("cos(x)", &wide, |x| [x.cos(), -x.sin(), -x.cos()]);
    check("tan(x)", &inner, |x| {
        let c = x.cos().powi(-2);
        [x.tan(), c, 2.0 * x.tan() * c]
    });
    check("asin(x)", &inner, |x| [x.asin(), (1.0 - x * x).powf(-0.5), x * (1.0 - x * x).powf(-1.5)]);
    check("acos(x)", &inner, |x| [x.acos(), -(1.0 - x * x).powf(-0.5), -x * (1.0 - x * x).powf(-1.5)]);
    check("atan(x)", &wide, |x| [x.atan(), 1.0 / (1.0 + x * x), -2.0 * x / (1.0 + x * x).powi(2)]);
    check("sinh(x)", &wide, |x| [x.sinh(), x.cosh(), x.sinh()]);
    check("cosh(x)", &wide, |x| [x.cosh(), x.sinh(), x.cosh()]);
    check("tanh(x)", &[-30.0, -2.3, 0.0, 0.4, 1.0, 3.1, 500.0], |x| {
        let c = x.cosh().powi(-2);
        [x.tanh(), c, -2.0 * x.tanh() * c]
    });
    check("exp(x)", &wide, |x| [x.exp(); 3]);
    check("ln(x)", &positive, |x| [x.ln(), 1.0 / x, -1.0 / x / x]);
    check("log(x)", &positive, |x| [x.ln(), 1.0 / x, -1.0 / x / x]);
    let l = std::f64::consts::LN_10;
    check("log10(x)", &positive, |x| [x.log10(), 1.0 / x / l, -1.0 / x / x / l]);
    check("sqrt(x)", &positive, |x| [x.sqrt(), 0.5 / x.sqrt(), -0.25 * x.powf(-1.5)]);
}

#[test]
fn derivatives_of_pieces() {
    let wide = [-2.3, -0.4, 0.2, 0.7, 3.1];
    check("abs(x)", &wide, |x| [x.abs(), x.signum(), 0.0]);
    check("sign(x)", &wide, |x| [x.signum(), 0.0, 0.0]);
    check("step(x)", &wide, |x| [f64::from(x >= 0.0), 0.0, 0.0]);
    check("smoothstep(x)", &[-1.0, 0.0, 0.3, 0.5, 0.9, 1.0, 4.0], |x| {
        let x = x.clamp(0.0, 1.0);
        [
            x.powi(3) * (6.0 * x * x - 15.0 * x + 10.0),
            30.0 * (x * (1.0 - x)).powi(2),
            60.0 * x * (1.0 - x) * (1.0 - 2.0 * x),
        ]
    });
    check("floor(x)", &wide, |x| [x.floor(), 0.0, 0.0]);
    check("mod(x^2, 0.3)", &wide, |x| [(x * x).rem_euclid(0.3), 2.0 * x, 2.0]);
    check("mod(x, -2)", &wide, |x| [x + 2.0 * (x / -2.0).floor(), 1.0, 0.0]);
    check("min(x^2, x)", &wide, |x| if x * x <= x { [x * x, 2.0 * x, 2.0] } else { [x, 1.0, 0.0] });
    check("max(x^2, x)", &wide, |x| if x * x >= x { [x * x, 2.0 * x, 2.0] } else { [x, 1.0, 0.0] });
    check("if(x < 0.3 or x >= 3, x^3, 2*x)", &wide, |x| {
        if !(0.3..3.0).contains(&x) { [x.powi(3), 3.0 * x * x, 6.0 * x] } else { [2.0 * x, 2.0, 0.0] }
    });
    check("table(x^2, 0, 1, 1, 3, 4, 0)", &[0.5, -0.9, 1.5, -1.9, 2.5], |x| match x * x {
        u if u < 1.0 => [1.0 + 2.0 * u, 4.0 * x, 4.0],
        u if u < 4.0 => [4.0 - u, -2.0 * x, -2.0],
        _ => [0.0; 3],
    });
}

#[test]
fn derivatives_of_powers_and_angles() {
    let wide = [-2.3, -0.4, 0.0, 0.7, 3.1];
    let positive = [0.2, 1.0, 2.5];
    check("x^2", &wide, |x| [x * x, 2.0 * x, 2.0]);
    check("x^3 - 2*x^1 + x^0", &wide, |x| [x.powi(3) - 2.0 * x + 1.0, 3.0 * x * x - 2.0, 6.0 * x]);
    check("(2 - x)^-2", &wide, |x| [(2.0 - x).powi(-2), 2.0 * (2.0 - x).powi(-3), 6.0 * (2.0 - x).powi(-4)]);
    check("x^1.5", &positive, |x| [x.powf(1.5), 1.5 * x.sqrt(), 0.75 / x.sqrt()]);
    check("x^0.5", &positive, |x| [x.sqrt(), 0.5 / x.sqrt(), -0.25 * x.powf(-1.5)]);
    check("2^x", &wide, |x| [1.0, 2f64.ln(), 2f64.ln().powi(2)].map(|c| c * 2f64.powf(x)));
    check("pow(x, x)", &positive, |x| {
        let f = x.powf(x);
        let l = x.ln() + 1.0;
        [f, f * l, f * (l * l + 1.0 / x)]
    });
    let circle = |x: f64| {
        let s = 1.0 + x * x;
        [s.sqrt(), x / s.sqrt(), s.powf(-1.5)]
    };
    check("hypot(x, 1)", &wide, circle);
    check("hypot(-x, 1)", &wide, circle);
    check("atan2(sin(x), cos(x))", &[-3.0, -1.0, 0.0, 2.0, 3.0], |x| [x, 1.0, 0.0]);
    check("atan2(-1, x)", &wide, |x| {
        let s = 1.0 + x * x;
        [(-1f64).atan2(x), 1.0 / s, -2.0 * x / s / s]
    });
}

#[test]
fn a_bump_has_finite_derivatives_everywhere() {
    let bump = parse("0.05*exp(-((t-0.5)/0.07)^2)");
    for i in -4000..4000 {
        let t = f64::from(i) * 0.01;
        let y = bump.eval(&[Taylor::fixed(0.0), Taylor::fixed(0.0), Taylor::time(t)]);
        let u = (t - 0.5) / 0.07;
        let w = 1.0 / 0.07;
        let f = 0.05 * (-u * u).exp();
        let exact = [f, -2.0 * u * w * f, (4.0 * u * u - 2.0) * w * w * f];
        [y.x, y.d, y.dd].iter().zip(exact).for_each(|(a, b)| assert!((a - b).abs() < 1e-12 * (1.0 + b.abs()), "{t}"));
    }
    let far = |text: &str, t: f64| parse(text).eval(&[Taylor::fixed(0.0), Taylor::fixed(0.0), Taylor::time(t)]);
    for t in [-1e200, -1e9, -100.0, 0.0, 100.0, 1e9, 1e200] {
        let all =
            ["exp(-(t/0.1)^2)", "exp(-t^4)", "1/(1+exp(-100*(t-0.5)))", "tanh(t*100)", "1/cosh(t)^2", "max(t,0)^1.5"];
        for text in all {
            let y = far(text, t);
            assert!(y.x.is_finite() && y.d.is_finite() && (y.dd.is_finite() || t == 0.0), "{text} at {t}: {y:?}");
        }
    }
}

#[test]
fn two_variables_have_their_own_derivatives() {
    let x = Dual::<f64, 2>::seeded(3.0, 0);
    let y = Dual::<f64, 2>::seeded(2.0, 1);
    let f = parse("x^2*y - y/x").eval(&[x, y]);
    assert!((f.eps[0] - (12.0 + 2.0 / 9.0)).abs() < 1e-14 && (f.eps[1] - (9.0 - 1.0 / 3.0)).abs() < 1e-14);
}
