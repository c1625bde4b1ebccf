//! Weighted sums of stages.

use super::From;
use crate::math::threads::{Divisible, each};
use crate::tolerances::system::NUMBERS_OF_A_PORTION;

/// Numbers in sequence, from `first` on, that a large sum is divided in.
struct Section<'a> {
    first: usize,
    out: &'a mut [f64],
}

impl Divisible for Section<'_> {
    fn divided(self) -> (Self, Option<Self>) {
        let Section { first, out } = self;
        if out.len() < 2 * NUMBERS_OF_A_PORTION {
            return (Section { first, out }, None);
        }
        let half = out.len() / 2;
        let (out, others) = out.split_at_mut(half);
        (Section { first, out }, Some(Section { first: first + half, out: others }))
    }
}

/// out = y + h sum_j weights_j k_j, in the order of j, for the entries that both have, and y for the others. Four stages
/// at a time, so that `out` is loaded and stored once for them.
pub(super) fn combine(out: &mut [f64], y: &[f64], h: f64, weights: &[f64], k: &[Vec<f64>]) {
    let len = k.first().map_or(0, Vec::len).min(y.len());
    let ((out, others), (y, rest)) = (out.split_at_mut(len), y.split_at(len));
    others.copy_from_slice(rest);
    each(Section { first: 0, out }, &|Section { first, out }| {
        let mut terms = terms(first, h, weights, k);
        let (head, count) = next_four(&mut terms);
        let y = &y[first..][..out.len()];
        match head[..count] {
            [a, b, c, d] => sum(out, y, [a, b, c, d]),
            [a, b, c] => sum(out, y, [a, b, c]),
            [a, b] => sum(out, y, [a, b]),
            [a] => sum(out, y, [a]),
            _ => out.copy_from_slice(y),
        }
        add_all(out, terms);
    });
}

/// The works at the end of a step of order 2, the last components of `to`, by the trapezoidal rule from the powers
/// there.
pub(super) fn trapezoid(from: From, h: f64, powers: &[f64], to: &mut [f64]) {
    for i in to.len() - powers.len()..to.len() {
        to[i] = from.y[i] + 0.5 * h * (from.slope[i] + powers[i + powers.len() - to.len()]);
    }
}

/// y += h sum_j weights_j k_j, likewise, for the entries that both have.
pub(super) fn accumulate(y: &mut [f64], h: f64, weights: &[f64], k: &[Vec<f64>]) {
    let len = k.first().map_or(0, Vec::len).min(y.len());
    add_all(&mut y[..len], terms(0, h, weights, k));
}

/// A factor and what it multiplies.
type Term<'a> = (f64, &'a [f64]);

/// The terms of a sum that are not zero, from an entry on.
fn terms<'a>(first: usize, h: f64, weights: &'a [f64], k: &'a [Vec<f64>]) -> impl Iterator<Item = Term<'a>> {
    let stages = weights.iter().zip(k).filter(|(weight, _)| **weight != 0.0);
    stages.map(move |(weight, k)| (h * weight, &k[first..]))
}

fn add_all<'a>(y: &mut [f64], mut terms: impl Iterator<Item = Term<'a>>) {
    loop {
        let (next, count) = next_four(&mut terms);
        match next[..count] {
            [a, b, c, d] => add(y, [a, b, c, d]),
            [a, b, c] => add(y, [a, b, c]),
            [a, b] => add(y, [a, b]),
            [a] => add(y, [a]),
            _ => {}
        }
        if count < 4 {
            return;
        }
    }
}

/// The next four terms at most, and their number.
#[inline]
fn next_four<'a>(terms: &mut impl Iterator<Item = Term<'a>>) -> ([Term<'a>; 4], usize) {
    let mut four: [Term; 4] = [(0.0, &[]); 4];
    let mut count = 0;
    for (place, term) in four.iter_mut().zip(terms) {
        *place = term;
        count += 1;
    }
    (four, count)
}

#[inline(always)]
fn sum<const N: usize>(out: &mut [f64], y: &[f64], terms: [Term; N]) {
    let y = &y[..out.len()];
    let terms = terms.map(|(factor, k)| (factor, &k[..y.len()]));
    for (i, out) in out.iter_mut().enumerate() {
        *out = terms.iter().fold(y[i], |sum, (factor, k)| sum + factor * k[i]);
    }
}

#[inline(always)]
fn add<const N: usize>(y: &mut [f64], terms: [Term; N]) {
    let terms = terms.map(|(factor, k)| (factor, &k[..y.len()]));
    for (i, y) in y.iter_mut().enumerate() {
        for (factor, k) in terms {
            *y += factor * k[i];
        }
    }
}
