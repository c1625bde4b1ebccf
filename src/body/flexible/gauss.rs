//! Gauss-Legendre integration.

use std::f64::consts::PI;

/// Points in (-1, 1) with their weights: exact for polynomials up to degree 2 n - 1.
pub fn gauss_legendre(n: usize) -> Vec<(f64, f64)> {
    (0..n).rev().map(|i| node(n, i)).collect()
}

/// Node i by Newton's method on Legendre's polynomial P_n; weight 2/((1 - x^2) P_n'(x)^2).
fn node(n: usize, i: usize) -> (f64, f64) {
    let mut x = (PI * (i as f64 + 0.75) / (n as f64 + 0.5)).cos();
    let mut slope = 1.0;
    // From Tricomi's first guess three steps are enough; a few more cost nothing.
    for _ in 0..6 {
        let (value, lower) = legendre(n, x);
        slope = n as f64 * (lower - x * value) / (1.0 - x * x);
        x -= value / slope;
    }
    (x, 2.0 / ((1.0 - x * x) * slope * slope))
}

/// P_n and P_(n-1) at x.
fn legendre(n: usize, x: f64) -> (f64, f64) {
    let mut value = 1.0;
    let mut lower = 0.0;
    for k in 1..=n {
        let k = k as f64;
        (value, lower) = (((2.0 * k - 1.0) * x * value - (k - 1.0) * lower) / k, value);
    }
    (value, lower)
}

/// Points and weights of `rule` between two ends.
pub fn on_interval(rule: &[(f64, f64)], ends: [f64; 2]) -> impl Iterator<Item = (f64, f64)> {
    let [from, to] = ends;
    let half = (to - from) / 2.0;
    rule.iter().map(move |(x, weight)| (from + half * (1.0 + x), weight * half))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn polynomials_are_integrated_exactly() {
        for n in 1..=24 {
            let rule = gauss_legendre(n);
            assert!(rule.windows(2).all(|pair| pair[0].0 < pair[1].0));
            for degree in 0..2 * n {
                let sum: f64 = on_interval(&rule, [0.0, 1.0]).map(|(x, w)| w * x.powi(degree as i32)).sum();
                assert!((sum * (degree as f64 + 1.0) - 1.0).abs() < 2e-14, "{n} points, degree {degree}: {sum}");
            }
        }
    }
}
