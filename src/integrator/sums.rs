//! Weighted sums of stages.

use super::StepStart;
use crate::math::array::Each;
use crate::math::threads::{Divisible, each};
use crate::tolerances::NUMBERS_OF_A_PORTION;

/// Numbers in sequence, from `first` on, that a large sum is divided in.
struct Section<'a> {
    first: usize,
    out: &'a mut [f64],
}

impl Divisible for Section<'_> {
    fn is_whole(&self) -> bool {
        self.out.len() < 2 * NUMBERS_OF_A_PORTION
    }

    fn divided(self) -> [Self; 2] {
        let Section { first, out } = self;
        let half = out.len() / 2;
        let (out, others) = out.split_at_mut(half);
        [Section { first, out }, Section { first: first + half, out: others }]
    }
}

/// sum += terms
pub(super) fn add(sum: &mut [f64], terms: &[f64]) {
    sum.iter_mut().zip(terms).for_each(|(sum, term)| *sum += term);
}

/// out = y + h sum_j weights_j k_j
pub(super) fn combine(out: &mut [f64], y: &[f64], h: f64, weights: &[f64], k: &[Vec<f64>]) {
    if out.len() < 2 * NUMBERS_OF_A_PORTION {
        out.copy_from_slice(y);
        return accumulate(out, h, weights, k);
    }
    each(Section { first: 0, out }, &|Section { first, out }| {
        out.copy_from_slice(&y[first..][..out.len()]);
        accumulate_from(first, out, h, weights, k);
    });
}

/// The works at the end of a step of order 2, the last components of `to`, by the trapezoidal rule from the powers
/// there.
pub(super) fn trapezoid(from: StepStart, powers: &[f64], to: &mut [f64]) {
    for i in to.len() - powers.len()..to.len() {
        to[i] = from.y[i] + 0.5 * from.h * (from.slope[i] + powers[i + powers.len() - to.len()]);
    }
}

/// y += h sum_j weights_j k_j, in the order of j, for the entries that both have. Four stages at a time, so that y is
/// loaded and stored once for them.
pub(super) fn accumulate(y: &mut [f64], h: f64, weights: &[f64], k: &[Vec<f64>]) {
    accumulate_from(0, y, h, weights, k);
}

/// The same for a part of y, the entries from `first` on.
#[inline(always)]
fn accumulate_from(first: usize, y: &mut [f64], h: f64, weights: &[f64], k: &[Vec<f64>]) {
    let len = k.first().map_or(0, |k| k.len().saturating_sub(first)).min(y.len());
    let y = &mut y[..len];
    let mut terms = [(0.0, &[][..]); 4];
    let mut count = 0;
    for (weight, k) in weights.iter().zip(k).filter(|(weight, _)| **weight != 0.0) {
        terms[count] = (h * weight, &k[first.min(k.len())..]);
        count += 1;
        if count == 4 {
            add_products(y, terms);
            count = 0;
        }
    }
    match terms[..count] {
        [first, second, third] => add_products(y, [first, second, third]),
        [first, second] => add_products(y, [first, second]),
        [first] => add_products(y, [first]),
        _ => {}
    }
}

/// Not inlined: the compiler then knows that y does not overlap the stages, and does not check it in each call.
#[inline(never)]
fn add_products<const N: usize>(y: &mut [f64], terms: [(f64, &[f64]); N]) {
    let terms = terms.each(|(factor, k)| (factor, &k[..y.len()]));
    for (i, y) in y.iter_mut().enumerate() {
        for (factor, k) in terms {
            *y += factor * k[i];
        }
    }
}
