//! Weighted sums of stages.

use super::From;

/// out = y + h sum_j weights_j k_j
pub(super) fn combine(out: &mut [f64], y: &[f64], h: f64, weights: &[f64], k: &[Vec<f64>]) {
    out.copy_from_slice(y);
    accumulate(out, h, weights, k);
}

/// The works at the end of a step of order 2, the last components of `to`, by the trapezoidal rule from the powers
/// there.
pub(super) fn trapezoid(from: From, h: f64, powers: &[f64], to: &mut [f64]) {
    for i in to.len() - powers.len()..to.len() {
        to[i] = from.y[i] + 0.5 * h * (from.slope[i] + powers[i + powers.len() - to.len()]);
    }
}

/// y += h sum_j weights_j k_j, in the order of j, for the entries that both have. Four stages at a time, so that y is
/// loaded and stored once for them.
pub(super) fn accumulate(y: &mut [f64], h: f64, weights: &[f64], k: &[Vec<f64>]) {
    let len = k.first().map_or(0, Vec::len).min(y.len());
    let y = &mut y[..len];
    let mut terms = [(0.0, &[][..]); 4];
    let mut count = 0;
    for (weight, k) in weights.iter().zip(k).filter(|(weight, _)| **weight != 0.0) {
        terms[count] = (h * weight, &k[..]);
        count += 1;
        if count == 4 {
            add(y, terms);
            count = 0;
        }
    }
    match terms[..count] {
        [first, second, third] => add(y, [first, second, third]),
        [first, second] => add(y, [first, second]),
        [first] => add(y, [first]),
        _ => {}
    }
}

#[inline(always)]
fn add<const N: usize>(y: &mut [f64], terms: [(f64, &[f64]); N]) {
    let terms = terms.map(|(factor, k)| (factor, &k[..y.len()]));
    for (i, y) in y.iter_mut().enumerate() {
        for (factor, k) in terms {
            *y += factor * k[i];
        }
    }
}
