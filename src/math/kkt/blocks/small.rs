//! L D L^T of a small matrix of which every entry may be there, as those of own equations are.
//!
//! The same operations in the same order as of one body and one joint, without lists of places.

use super::super::Pattern;
use super::super::pivot::{Judge, Quality, Rule, farthest_first};
use super::groups::LARGEST;
use crate::math::array::from_fn;

/// The factors, with the memory to make them.
pub(in super::super) struct Small {
    /// Numbers of coordinates and multipliers.
    n: usize,
    m: usize,
    /// L of the coordinates, row by row; beyond the diagonal nothing is read.
    lower: Vec<f64>,
    /// G L^-T, row by row.
    rows: Vec<f64>,
    /// -G M^-1 G^T by its upper triangle, row by row; then D on the diagonal and L^T beside it.
    schur: Vec<f64>,
    /// L^T of the row in work.
    scaled: Vec<f64>,
    /// Inverses of the pivots, those of multipliers last, and what the latter are compared with.
    inverse: Vec<f64>,
    sizes: Vec<f64>,
}

impl Small {
    /// `None` for patterns with places that are not all there in their order, and for larger ones.
    pub fn new(mass: &Pattern, g: &Pattern) -> Option<Self> {
        let n = mass.rows;
        let m = g.rows;
        let is_small = (1..=LARGEST).contains(&n) && m <= LARGEST;
        let zeros = |len: usize| vec![0.0; len];
        (is_small && *mass == Pattern::lower(n) && *g == Pattern::dense(m, n)).then(|| Small {
            n,
            m,
            lower: zeros(n * n),
            rows: zeros(m * n),
            schur: zeros(m * m),
            scaled: zeros(m),
            inverse: zeros(n + m),
            sizes: zeros(m),
        })
    }

    /// See [`Blocks::factor`](super::Blocks::factor).
    pub fn factor(&mut self, mass: &[f64], g: &[f64], rule: Rule, skipped: &mut Vec<usize>) -> Result<Quality, usize> {
        let mut judge = Judge { n: self.n, rule, skipped, quality: Quality::GOOD };
        by_width!(self.n, self.factor_coordinates(mass, g, &mut judge))?;
        if self.m > 0 {
            self.factor_multipliers(&mut judge)?;
        }
        Ok(judge.quality)
    }

    /// L and D of M, G L^-T and -G M^-1 G^T.
    fn factor_coordinates<const N: usize>(&mut self, mass: &[f64], g: &[f64], judge: &mut Judge) -> Result<(), usize> {
        let mut l = [[0.0; N]; N];
        let mass = &mass[..N * (N + 1) / 2];
        for i in 0..N {
            (0..=i).for_each(|j| l[i][j] = mass[i * (i + 1) / 2 + j]);
        }
        let sizes: [f64; N] = from_fn(|p| l[p][p]);
        let mut inverse = [0.0; N];
        for p in 0..N {
            inverse[p] = judge.inverse(l[p][p], sizes[p], 1.0, || p)?;
            for q in p + 1..N {
                let factor = l[q][p] * inverse[p];
                (p + 1..=q).for_each(|r| l[q][r] -= factor * l[r][p]);
            }
            (p + 1..N).for_each(|q| l[q][p] *= inverse[p]);
        }
        let rows = self.rows.as_chunks_mut::<N>().0;
        for (row, g) in rows.iter_mut().zip(g.as_chunks::<N>().0) {
            *row = *g;
            (0..N).for_each(|p| (p + 1..N).for_each(|q| row[q] -= row[p] * l[q][p]));
        }
        for (k, row) in rows.iter().enumerate() {
            let scaled: [f64; N] = from_fn(|p| row[p] * inverse[p]);
            for (row, entry) in rows[k..].iter().zip(&mut self.schur[k * self.m + k..]) {
                *entry = (0..N).fold(0.0, |sum, p| sum - row[p] * scaled[p]);
            }
        }
        self.lower.copy_from_slice(l.as_flattened());
        self.inverse[..N].copy_from_slice(&inverse);
        Ok(())
    }

    fn factor_multipliers(&mut self, judge: &mut Judge) -> Result<(), usize> {
        let Small { n, m, schur, scaled, inverse, sizes, .. } = self;
        (0..*m).for_each(|j| sizes[j] = -schur[j * *m + j]);
        for p in 0..*m {
            let (above, below) = schur.split_at_mut((p + 1) * *m);
            let row = &mut above[p * *m + p..];
            let own = judge.inverse(row[0], sizes[p], -1.0, || *n + p)?;
            inverse[*n + p] = own;
            if below.is_empty() {
                break;
            }
            let scaled = &mut scaled[p + 1..];
            scaled.iter_mut().zip(&row[1..]).for_each(|(scaled, x)| *scaled = x * own);
            for (r, target) in below.chunks_exact_mut(*m).enumerate() {
                subtract(&mut target[p + 1 + r..], &scaled[r..], row[1 + r]);
            }
            row[1..].copy_from_slice(scaled);
        }
        Ok(())
    }

    /// Solves in place; dropped multipliers are zero.
    pub fn solve(&mut self, top: &mut [f64], bottom: &mut [f64]) {
        by_width!(self.n, self.solve_for(top, bottom));
    }

    fn solve_for<const N: usize>(&self, top: &mut [f64], bottom: &mut [f64]) {
        let (l, _) = self.lower.as_chunks::<N>();
        let (rows, _) = self.rows.as_chunks::<N>();
        let (Some(l), Some(inverse)) = (l.first_chunk::<N>(), self.inverse.first_chunk::<N>()) else { return };
        let Some(top) = top.first_chunk_mut::<N>() else { return };
        (0..N).for_each(|p| (p + 1..N).for_each(|q| top[q] -= top[p] * l[q][p]));
        (0..N).for_each(|p| top[p] *= inverse[p]);
        if self.m > 0 {
            for (x, row) in bottom.iter_mut().zip(rows) {
                *x = (0..N).fold(*x, |x, p| x - top[p] * row[p]);
            }
            self.solve_multipliers(bottom);
            let mut sum = [0.0; N];
            for (x, row) in bottom.iter().zip(rows) {
                (0..N).for_each(|p| sum[p] += x * row[p]);
            }
            (0..N).for_each(|p| top[p] -= sum[p] * inverse[p]);
        }
        (0..N).rev().for_each(|p| (p + 1..N).rev().for_each(|q| top[p] -= top[q] * l[q][p]));
    }

    fn solve_multipliers(&self, bottom: &mut [f64]) {
        let Small { n, m, schur, inverse, .. } = self;
        let upper = |p: usize| &schur[p * *m + p + 1..(p + 1) * *m];
        // The last row has nothing beside its diagonal.
        let others = m.saturating_sub(1);
        for p in 0..others {
            let x = bottom[p];
            subtract(&mut bottom[p + 1..], upper(p), x);
        }
        bottom.iter_mut().zip(&inverse[*n..]).for_each(|(x, inverse)| *x *= inverse);
        for p in (0..others).rev() {
            bottom[p] = bottom[p + 1..].iter().zip(upper(p)).fold(bottom[p], |sum, (x, l)| sum - x * l);
        }
    }

    /// See [`Blocks::smallest_ratio`](super::Blocks::smallest_ratio).
    pub fn smallest_ratio(&self, collapsed: f64) -> (f64, usize) {
        if self.m == 0 { (1.0, 0) } else { by_width!(self.m, self.ratio(collapsed)) }
    }

    fn ratio<const W: usize>(&self, collapsed: f64) -> (f64, usize) {
        let rows = from_fn(|i| from_fn(|p| self.schur[p.min(i) * W + i.max(p)]));
        let sizes = from_fn(|p| self.sizes[p]);
        let mut ratios: [f64; W] = from_fn(|p| -rows[p][p] / sizes[p]);
        // Written so that the NaN of a row of zeros has collapsed.
        let lost = W - ratios.iter().filter(|ratio| **ratio > collapsed).count();
        if lost == 0 && W > 1 {
            farthest_first(&rows, &sizes, &mut ratios);
        }
        (ratios.iter().filter(|ratio| **ratio > collapsed).fold(1.0, |least: f64, x| least.min(*x)), lost)
    }
}

/// y -= x a
#[inline(always)]
fn subtract(y: &mut [f64], x: &[f64], a: f64) {
    y.iter_mut().zip(x).for_each(|(y, x)| *y -= x * a);
}
