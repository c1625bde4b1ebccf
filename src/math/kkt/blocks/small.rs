//! L D L^T of a small matrix of which every entry may be there, as those of own equations are.
//!
//! The same operations in the same order as of one block of coordinates and one of multipliers, without lists of places.

use super::super::Pattern;
use super::super::pivot::{Judge, Quality, Rule, farthest_first};
use super::groups::LARGEST;
use crate::math::array::from_fn;

/// The factors, with the memory to make them.
pub(in super::super) struct Small {
    /// Numbers of coordinates and of all unknowns.
    n: usize,
    total: usize,
    /// The upper triangle row by row, `total` apart: D on the diagonal, L^T beside it, but L^T D in the columns of
    /// multipliers and rows of coordinates.
    upper: Vec<f64>,
    /// L^T of the row in work.
    scaled: Vec<f64>,
    /// Inverses of the pivots, and what they are compared with.
    inverse: Vec<f64>,
    sizes: Vec<f64>,
}

impl Small {
    /// `None` for patterns with places that are not all there in their order, and for larger ones.
    pub fn new(mass: &Pattern, g: &Pattern) -> Option<Self> {
        let n = mass.rows;
        let total = n + g.rows;
        let zeros = |len: usize| vec![0.0; len];
        let is_small = total > 0 && n <= LARGEST && g.rows <= LARGEST;
        (is_small && *mass == Pattern::lower(n) && *g == Pattern::dense(g.rows, n)).then(|| Small {
            n,
            total,
            upper: zeros(total * total),
            scaled: zeros(total),
            inverse: zeros(total),
            sizes: zeros(total),
        })
    }

    /// See [`Blocks::factor`](super::Blocks::factor).
    pub fn factor(&mut self, mass: &[f64], g: &[f64], rule: Rule, skipped: &mut Vec<usize>) -> Result<Quality, usize> {
        let Small { n, total, upper, scaled, inverse, sizes } = self;
        let (n, total) = (*n, *total);
        let mut judge = Judge { n, rule, skipped, quality: Quality::GOOD };
        fill(upper, (n, total), mass, g);
        (0..n).for_each(|p| sizes[p] = upper[p * total + p]);
        for p in 0..total {
            if p == n {
                (n..total).for_each(|j| sizes[j] = -upper[j * total + j]);
            }
            let (above, below) = upper.split_at_mut((p + 1) * total);
            let row = &mut above[p * total..];
            let sign = if p < n { 1.0 } else { -1.0 };
            inverse[p] = judge.inverse(row[p], (sizes[p], sign), || p)?;
            for (scaled, x) in scaled[p + 1..].iter_mut().zip(&row[p + 1..]) {
                *scaled = x * inverse[p];
            }
            // Products of coordinates and multipliers take the other factor scaled, as those of blocks do.
            let split = if p < n { n } else { total };
            for (r, target) in (p + 1..total).zip(below.chunks_exact_mut(total)) {
                subtract(&mut target[r..split.max(r)], &scaled[r..], row[r]);
                subtract(&mut target[split.max(r)..], &row[split.max(r)..], scaled[r]);
            }
            row[p + 1..split.max(p + 1)].copy_from_slice(&scaled[p + 1..split.max(p + 1)]);
        }
        Ok(judge.quality)
    }

    /// Solves in place; dropped multipliers are zero.
    pub fn solve(&mut self, top: &mut [f64], bottom: &mut [f64]) {
        let Small { n, total, upper, inverse, .. } = self;
        let rows = || upper.chunks_exact(*total);
        let coordinates = || rows().take(*n).enumerate();
        let multipliers = || rows().skip(*n).map(|row| &row[*n..]).enumerate();
        for (p, row) in coordinates() {
            let x = top[p];
            subtract(&mut top[p + 1..], &row[p + 1..], x);
        }
        for (p, row) in coordinates() {
            top[p] *= inverse[p];
            subtract(bottom, &row[*n..], top[p]);
        }
        for (p, row) in multipliers() {
            let x = bottom[p];
            subtract(&mut bottom[p + 1..], &row[p + 1..], x);
        }
        bottom.iter_mut().zip(&inverse[*n..]).for_each(|(x, inverse)| *x *= inverse);
        for (p, row) in multipliers().rev() {
            bottom[p] = bottom[p + 1..].iter().zip(&row[p + 1..]).fold(bottom[p], |sum, (x, l)| sum - x * l);
        }
        for (p, row) in coordinates().rev() {
            let sum = bottom.iter().zip(&row[*n..]).fold(0.0, |sum, (x, g)| sum + x * g);
            let start = top[p] - sum * inverse[p];
            top[p] = top[p + 1..].iter().zip(&row[p + 1..]).rev().fold(start, |x, (y, l)| x - y * l);
        }
    }

    /// See [`Blocks::smallest_ratio`](super::Blocks::smallest_ratio).
    pub fn smallest_ratio(&self, collapsed: f64) -> (f64, usize) {
        if self.total == self.n { (1.0, 0) } else { by_width!(self.total - self.n, self.ratio(collapsed)) }
    }

    fn ratio<const W: usize>(&self, collapsed: f64) -> (f64, usize) {
        let Small { n, total, upper, sizes, .. } = self;
        let rows = from_fn(|i| from_fn(|p| upper[(n + p.min(i)) * total + n + i.max(p)]));
        let sizes = from_fn(|p| sizes[n + p]);
        let mut ratios: [f64; W] = from_fn(|p| -rows[p][p] / sizes[p]);
        // Written so that the NaN of a row of zeros has collapsed.
        let lost = W - ratios.iter().filter(|ratio| **ratio > collapsed).count();
        if lost == 0 && W > 1 {
            farthest_first(&rows, &sizes, &mut ratios);
        }
        (ratios.iter().filter(|ratio| **ratio > collapsed).fold(1.0, |least: f64, x| least.min(*x)), lost)
    }
}

/// The upper triangle of [M G^T; G 0] from the lower one of M, both row by row.
fn fill(upper: &mut [f64], (n, total): (usize, usize), mass: &[f64], g: &[f64]) {
    let mut entries = mass.iter();
    for i in 0..n {
        (0..=i).zip(&mut entries).for_each(|(j, entry)| upper[j * total + i] = *entry);
    }
    for j in n..total {
        (0..n).zip(&g[(j - n) * n..]).for_each(|(i, entry)| upper[i * total + j] = *entry);
        upper[j * total + j..][..total - j].fill(0.0);
    }
}

/// y -= x a
#[inline(always)]
fn subtract(y: &mut [f64], x: &[f64], a: f64) {
    y.iter_mut().zip(x).for_each(|(y, x)| *y -= x * a);
}
