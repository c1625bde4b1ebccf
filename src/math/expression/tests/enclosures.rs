//! An enclosure contains every value, rate and second rate within its interval.

use super::parse;
use crate::math::{Interval, Taylor};

const FORMULAS: [&str; 34] = [
    "x",
    "-x^2 + 3*x",
    "x^3 - x",
    "x^-2",
    "1/x",
    "sin(3*x)",
    "cos(x)*x",
    "tan(x)",
    "exp(-(x/0.3)^2)",
    "ln(x)",
    "sqrt(x)",
    "sqrt(x^2 + 1)",
    "atan(5*x)",
    "asin(x/4)",
    "acos(x/4)",
    "sinh(x)",
    "cosh(x)",
    "tanh(20*x)",
    "tanh(x/5)",
    "1/(1 + exp(-300*x))",
    "1e3/(1 + exp(-30*(x - 1)))",
    "atan2(x, 0.1)",
    "atan2(0.3, x)",
    "hypot(x, 0.01)",
    "hypot(x, 1)",
    "log10(x)",
    "x^0.5",
    "(x + 4)^1.5",
    "2^x",
    "x^x",
    "abs(x)",
    "max(x, 1)*min(x, 2)",
    "smoothstep(x)",
    "table(x, -1, 0, 1, 3, 2, -4)",
];

#[test]
fn enclosures_contain_all_samples() {
    for text in FORMULAS {
        let expression = parse(text);
        // Pieces are those of the middle, so intervals with a threshold inside are left out where there is one.
        let has_pieces = ["abs", "max", "smoothstep", "table"].iter().any(|name| text.contains(name));
        for (from, to) in [(-3.0, 3.0), (-0.7, 0.2), (0.0, 0.5), (0.1, 0.9), (1.1, 1.9), (2.5, 2.500_01), (-2.0, -1.5)]
        {
            let crosses = [-1.0, 0.0, 1.0, 2.0].iter().any(|c| from < *c && *c < to);
            if has_pieces && crosses {
                continue;
            }
            let x = expression.eval(&[Taylor::running(Interval::new(from, to))]);
            for k in 0..=50 {
                let at = from + f64::from(k) / 50.0 * (to - from);
                let sample: Taylor<f64> = expression.eval(&[Taylor::time(at)]);
                for (found, value) in [(x.x, sample.x), (x.d, sample.d), (x.dd, sample.dd)] {
                    // Rounding is not directed.
                    let slack = 1e-12 * (1.0 + value.abs());
                    let wide = Interval { low: found.low - slack, high: found.high + slack };
                    assert!(
                        !value.is_finite() || wide.contains(value),
                        "{text} at {at} in {from}..{to}: {value} {found:?}"
                    );
                }
            }
        }
    }
}

#[test]
fn narrow_intervals_have_narrow_enclosures() {
    for text in FORMULAS {
        let expression = parse(text);
        let x = expression.eval(&[Taylor::running(Interval::new(0.4, 0.4 + 1e-9))]);
        assert!(x.x.width() < 1e-6 && x.d.width() < 1e-4, "{text}: {x:?}");
    }
}

#[test]
fn sines_know_their_crests() {
    let sine = parse("sin(x)");
    let enclosed = |from: f64, to: f64| sine.eval(&[Interval::new(from, to)]);
    assert_eq!(enclosed(0.0, 2.0).high, 1.0);
    assert_eq!(enclosed(0.0, 7.0), Interval { low: -1.0, high: 1.0 });
    assert_eq!(enclosed(4.0, 5.0).low, -1.0);
    assert_eq!(enclosed(0.1, 0.2), Interval { low: 0.1f64.sin(), high: 0.2f64.sin() });
}
