//! Rank, dropped rows and rank indicator of the last factorization.

use super::{SaddlePoint, Way};

impl SaddlePoint {
    /// Forgets the last factors.
    pub fn forget(&mut self) {
        self.way = Way::None;
    }

    /// True if the last factorization succeeded.
    pub fn is_factored(&self) -> bool {
        self.way != Way::None
    }

    /// Rows that the last factorization dropped as dependent.
    pub fn left_out(&self) -> &[usize] {
        match (self.way, &self.kept, &self.skipping, &self.dense) {
            (Way::Kept, Some(kept), ..) => kept.left_out(),
            (Way::RedundantRowSolve, _, Some(skipping), _) => skipping.left_out(),
            (Way::Dense, .., Some(dense)) => dense.left_out(),
            _ => &[],
        }
    }

    /// The rank of G: m on the fast path, 0 without a factorization.
    pub fn rank(&self) -> usize {
        match self.way {
            Way::None => 0,
            _ => self.m - self.left_out().len(),
        }
    }

    /// True if the last factorization needed no rank-revealing one.
    #[inline]
    pub fn is_fast(&self) -> bool {
        matches!(self.way, Way::Ldlt { .. })
    }

    /// True if a factorization truncated below `part` of the reference value would give the same factors.
    #[inline]
    pub fn is_regular(&self, part: f64) -> bool {
        match (self.way, &self.kept) {
            (Way::Ldlt { refine }, _) => !refine || self.rank_indicator() >= part * self.rank_reference,
            (Way::Kept, Some(kept)) => kept.inner.is_regular(part),
            _ => false,
        }
    }

    /// True if rows are dependent, to round-off.
    #[inline]
    pub fn is_rank_deficient(&self) -> bool {
        !self.is_fast() && (self.drops_rows || !self.is_truncated && self.rank() < self.m)
    }

    /// Norm of the inconsistent part of the last right side r2, for which no a exists; zero unless rows are dependent.
    pub fn inconsistency(&self) -> f64 {
        match (self.way, &self.kept, &self.skipping, &self.dense) {
            (Way::Kept, Some(kept), ..) => kept.inconsistency(),
            (Way::RedundantRowSolve, _, Some(skipping), _) => skipping.inconsistency(),
            (Way::Dense, .., Some(dense)) => dense.inconsistency(),
            _ => 0.0,
        }
    }

    /// [`Self::rank_indicator`] of the rows that are not dropped: nonzero for redundant constraints, too.
    pub fn kept_indicator(&self) -> f64 {
        let ratio: f64 = match (self.way, &self.kept, &self.skipping, &self.dense) {
            (Way::Kept, Some(kept), ..) => return kept.inner.kept_indicator(),
            (Way::RedundantRowSolve, _, Some(skipping), _) => skipping.kept_ratio(),
            (Way::Dense, .., Some(dense)) => dense.smallest_ratio(),
            _ => return self.rank_indicator(),
        };
        ratio.max(0.0).sqrt()
    }

    /// Rank indicator of G: about the smallest sine of the angle between a row and those before it (metric M^-1), the
    /// rows of one joint with the farthest first, without dropped rows; by the smallest ratio of a pivot to its size
    /// before elimination, which is its square. In [0, 1]; zero if other rows are dependent, and without a factorization.
    pub fn rank_indicator(&self) -> f64 {
        let ratio: f64 = match (self.way, &self.fast, &self.kept, &self.skipping, &self.dense) {
            (Way::Ldlt { .. }, Some(orders), ..) => orders.smallest_ratio(),
            (Way::Kept, _, Some(kept), ..) if self.drops_rows => return kept.inner.rank_indicator(),
            (Way::RedundantRowSolve, .., Some(skipping), _) => skipping.smallest_ratio(),
            (Way::Dense, .., Some(dense)) if dense.left_out().is_empty() => dense.smallest_ratio(),
            _ => 0.0,
        };
        ratio.max(0.0).sqrt()
    }
}
