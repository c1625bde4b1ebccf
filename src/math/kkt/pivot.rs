//! Acceptance of pivots of L D L^T, and replacement of those that collapse.

use crate::math::array::Each;
use crate::tolerances;

/// Ratios of a pivot to its size before elimination. For a multiplier the ratio is the squared sine of the angle
/// between its row of G and the rows before it, in the metric of M^-1; round-off of exactly dependent rows leaves 1e-16
/// to 1e-14.
#[derive(Clone, Copy)]
pub(super) struct Rule {
    /// At or below this the pivot has collapsed.
    pub collapsed: f64,
    /// At or below this the pivot is kept, but solutions need a refinement.
    pub weak: f64,
    /// Least value that replaces a collapsed coordinate pivot; if `None`, a collapse stops the factorization.
    pub floor: Option<f64>,
}

impl Rule {
    /// Stops at a collapsed pivot: the fast path.
    pub const STRICT: Rule =
        Rule { collapsed: tolerances::COLLAPSED_FAST, weak: tolerances::HALF_OF_THE_DIGITS, floor: None };

    /// Continues at a collapsed pivot: a multiplier is dropped, a coordinate gets a small mass.
    pub fn lenient(collapsed: f64, mass_diagonal: &[f64]) -> Rule {
        let largest = mass_diagonal.iter().fold(0.0, |largest: f64, v| largest.max(v.abs()));
        let floor = tolerances::HALF_OF_THE_DIGITS * if largest > 0.0 { largest } else { 1.0 };
        Rule { collapsed, weak: 1e-8, floor: Some(floor) }
    }
}

#[derive(Clone, Copy)]
pub(super) struct Quality {
    /// True if solutions need a refinement.
    pub weak: bool,
    /// True if a multiplier was dropped, or kept, whose row is neither surely dependent nor surely independent.
    pub doubtful: bool,
    /// True if a coordinate pivot was replaced.
    pub replaced: bool,
}

impl Quality {
    pub const GOOD: Quality = Quality { weak: false, doubtful: false, replaced: false };

    /// What is true of either of two.
    pub fn with(self, other: Quality) -> Quality {
        Quality {
            weak: self.weak || other.weak,
            doubtful: self.doubtful || other.doubtful,
            replaced: self.replaced || other.replaced,
        }
    }
}

/// The judgement of pivots of one factorization.
pub(super) struct Judge<'a> {
    /// Number of coordinates.
    pub n: usize,
    pub rule: Rule,
    pub skipped: &'a mut Vec<usize>,
    pub quality: Quality,
}

impl Judge<'_> {
    /// The inverse of a pivot, whose sign is that of `sign`.
    #[inline(always)]
    pub fn inverse(&mut self, pivot: f64, size: f64, sign: f64, node: impl Fn() -> usize) -> Result<f64, usize> {
        let positive = sign * pivot;
        // Written so that a NaN is judged too.
        if positive > self.rule.weak * size && positive < f64::INFINITY {
            Ok(1.0 / pivot)
        } else {
            self.judge(node(), positive, size)
        }
    }

    /// Checks a pivot at a node, with its sign changed so that it should be positive, and returns its inverse; that of
    /// a dropped multiplier is zero. The error is the node.
    #[cold]
    #[inline(never)]
    pub fn judge(&mut self, node: usize, pivot: f64, size: f64) -> Result<f64, usize> {
        let sign = if node < self.n { 1.0 } else { -1.0 };
        // Written so that a NaN collapses.
        if pivot > self.rule.collapsed * size && pivot < f64::INFINITY {
            self.quality.weak = true;
            self.quality.doubtful = true;
            return Ok(sign / pivot);
        }
        let Some(floor) = self.rule.floor else { return Err(node) };
        if node < self.n {
            self.quality.replaced = true;
            return Ok(1.0 / (tolerances::HALF_OF_THE_DIGITS * size).max(floor));
        }
        self.quality.doubtful |= pivot.abs() > tolerances::ROUND_OFF_OF_FACTORS * size;
        self.skipped.push(node - self.n);
        Ok(0.0)
    }
}

/// The ratios of a joint's pivots with the largest first, from its block L D L^T, D on the diagonal and L below, and the
/// sizes that pivots are compared with.
pub(super) fn farthest_first<const W: usize>(rows: &[[f64; W]; W], sizes: &[f64; W], ratios: &mut [f64; W]) {
    let l = |i: usize, p: usize| if i == p { 1.0 } else { rows[i][p] };
    let scale = sizes.each(|size| size.sqrt().recip());
    let mut block = [[0.0; W]; W];
    for (i, j) in (0..W).flat_map(|i| (0..=i).map(move |j| (i, j))) {
        let sum: f64 = (0..=j).map(|p| l(i, p) * -rows[p][p] * l(j, p)).sum();
        block[i][j] = sum * scale[i] * scale[j];
        block[j][i] = block[i][j];
    }
    let mut is_left = [true; W];
    for ratio in ratios.iter_mut() {
        let left = (0..W).filter(|&i| is_left[i]);
        let Some(next) = left.max_by(|&i, &j| block[i][i].total_cmp(&block[j][j])) else { return };
        is_left[next] = false;
        *ratio = block[next][next];
        let row = block[next];
        let part = row.each(|x| x / *ratio);
        for i in (0..W).filter(|&i| is_left[i]) {
            (0..W).for_each(|j| block[i][j] -= row[i] * part[j]);
        }
    }
}
