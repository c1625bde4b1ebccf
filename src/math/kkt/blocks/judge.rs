//! The judgement of pivots.

use super::super::pivot::{Quality, Rule};

/// How pivots are judged, and what was found so far.
pub(in super::super) struct Judge<'a> {
    /// Number of coordinates.
    pub n: usize,
    pub rule: Rule,
    pub skipped: &'a mut Vec<usize>,
    pub quality: Quality,
}

impl Judge<'_> {
    /// The inverse of a pivot, whose sign is that of `sign`.
    #[inline(always)]
    pub fn inverse(&mut self, pivot: f64, (size, sign): (f64, f64), node: impl Fn() -> usize) -> Result<f64, usize> {
        let positive = sign * pivot;
        // Written so that a NaN is judged too.
        if positive > self.rule.weak * size && positive < f64::INFINITY {
            Ok(1.0 / pivot)
        } else {
            self.judge(node(), positive, size)
        }
    }

    #[cold]
    #[inline(never)]
    fn judge(&mut self, node: usize, pivot: f64, size: f64) -> Result<f64, usize> {
        self.quality.judge((node, self.n), (pivot, size), self.rule, self.skipped)
    }
}
