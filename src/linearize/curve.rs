//! Curves of eigenvalues between the points of a branch, by their derivatives.

use super::{Branch, Complex};
use crate::tolerances::EIGENVALUES_AGREE;

/// A point of a branch.
#[derive(Clone, Copy)]
struct Knot {
    /// Time or parameter.
    at: f64,
    value: Complex<f64>,
    /// Derivative of the eigenvalue, where it is known.
    slope: Option<Complex<f64>>,
}

/// Largest difference of the mean of both derivatives from the slope of the chord where a cubic is drawn. Unit: `[1]` of the
/// larger derivative. Why: 0 for a parabola, 1/2 for a root at its end: there eigenvalues meet, and no cubic follows.
/// Test: `curves_follow_derivatives`.
const SMOOTH_INTERVAL: f64 = 0.4;

impl Branch {
    /// Returns the branch with points between its own that follow its derivatives: cubic Hermite interpolation of a real
    /// eigenvalue, or of the real part and of the square of the imaginary part of one of a pair, which is smooth up to the
    /// value at which the pair becomes real and beyond. Where derivatives are unknown, or belong to no smooth curve, the
    /// chord stays.
    pub fn curve(&self) -> Branch {
        // More are not seen in a figure, nor chords of a twelfth of a cubic.
        let parts = (800 / self.points.len().max(1)).clamp(1, 12);
        let slopes = self.slopes.iter().copied().chain(std::iter::repeat(None));
        let knots: Vec<Knot> =
            self.points.iter().zip(slopes).map(|(&(at, value), slope)| Knot { at, value, slope }).collect();
        let mut points = Vec::new();
        for pair in knots.windows(2) {
            points.push((pair[0].at, pair[0].value));
            points.extend(between(pair[0], pair[1], parts));
        }
        points.extend(self.points.last());
        Branch { kind: self.kind, slopes: vec![None; points.len()], points }
    }
}

/// Returns points between two knots, in their order.
fn between(from: Knot, to: Knot, parts: usize) -> Vec<(f64, Complex<f64>)> {
    let inner = (1..parts).map(|i| i as f64 / parts as f64);
    let is_real = |knot: Knot| knot.value.im == 0.0;
    let is_known = from.value.im.is_finite() && to.value.im.is_finite();
    if !is_known {
        Vec::new()
    } else if is_real(from) == is_real(to) {
        smooth(from, to, inner).unwrap_or_default()
    } else if is_real(to) {
        meeting(from, to, parts)
    } else {
        let mut points = meeting(to, from, parts);
        points.reverse();
        points
    }
}

/// The real part and the square of the imaginary part of an eigenvalue, or their derivatives along `length`.
fn squared(value: Complex<f64>) -> [f64; 2] {
    [value.re, value.im * value.im]
}

fn squared_rate(value: Complex<f64>, slope: Complex<f64>, length: f64) -> [f64; 2] {
    [slope.re * length, 2.0 * value.im * slope.im * length]
}

/// The cubic between two knots that are both real or both of a pair; none where it is not smooth.
fn smooth(from: Knot, to: Knot, inner: impl Iterator<Item = f64>) -> Option<Vec<(f64, Complex<f64>)>> {
    let length = to.at - from.at;
    let rates = [squared_rate(from.value, from.slope?, length), squared_rate(to.value, to.slope?, length)];
    let ends = [squared(from.value), squared(to.value)];
    let size = from.value.norm().max(to.value.norm());
    for (k, size) in [size, size * size].into_iter().enumerate() {
        let off = 0.5 * (rates[0][k] + rates[1][k]) - (ends[1][k] - ends[0][k]);
        let largest = rates[0][k].abs().max(rates[1][k].abs());
        let is_smooth = off.abs() <= SMOOTH_INTERVAL * largest + EIGENVALUES_AGREE * size;
        if !is_smooth {
            return None;
        }
    }
    let cubic = |k: usize, s: f64| hermite([ends[0][k], ends[1][k]], [rates[0][k], rates[1][k]], s);
    let point = |s: f64| {
        let im = cubic(1, s).max(0.0).sqrt().copysign(from.value.im);
        (from.at + s * length, Complex::new(cubic(0, s), im))
    };
    Some(inner.map(point).collect())
}

/// The curve from an eigenvalue of a pair over the value at which the pair becomes real to a real one, m -+ sqrt(d): the mean
/// m of the pair goes straight on, and d is the cubic with the values and derivatives that both ends have. Half-way on the
/// axis where derivatives do not tell.
fn meeting(from: Knot, to: Knot, parts: usize) -> Vec<(f64, Complex<f64>)> {
    let pair = from.value;
    let Some((start, end)) = from.slope.zip(to.slope) else {
        return vec![(0.5 * (from.at + to.at), Complex::new(pair.re, 0.0))];
    };
    let length = to.at - from.at;
    let mean = |s: f64| pair.re + start.re * length * s;
    let gap = to.value.re - mean(1.0);
    let ends = [-pair.im * pair.im, gap * gap];
    let rates = [-2.0 * pair.im * start.im * length, 2.0 * gap * (end.re - start.re) * length];
    let square = |s: f64| hermite(ends, rates, s);
    let mut meets = [0.0, 1.0];
    for _ in 0..f64::MANTISSA_DIGITS {
        let middle = 0.5 * (meets[0] + meets[1]);
        meets[usize::from(square(middle) > 0.0)] = middle;
    }
    let meets = meets[1];
    // Closer together where the roots are steep.
    let near = |i: usize| (i as f64 / parts as f64).powi(2);
    let before = (0..parts).rev().map(|i| {
        let s = meets * (1.0 - near(i));
        (s, Complex::new(mean(s), (-square(s)).max(0.0).sqrt().copysign(pair.im)))
    });
    let after = (1..parts).map(|i| {
        let s = meets + (1.0 - meets) * near(i);
        (s, Complex::new(mean(s) + square(s).max(0.0).sqrt().copysign(gap), 0.0))
    });
    before.chain(after).map(|(s, value)| (from.at + s * length, value)).collect()
}

/// The cubic with these values and derivatives at s = 0 and s = 1.
fn hermite(values: [f64; 2], rates: [f64; 2], s: f64) -> f64 {
    let [p, q] = values;
    let [u, v] = rates;
    p + s * (u + s * (3.0 * (q - p) - 2.0 * u - v + s * (2.0 * (p - q) + u + v)))
}
