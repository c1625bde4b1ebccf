//! Redundant rows of G in the unsymmetric system.

use super::super::Pattern;
use super::super::ldlt::Ldlt;
use super::super::pivot::Rule;
use crate::tolerances::math as tolerances;

/// The rows whose pivots collapse in the L D L^T of G diag(weight)^-1 G^T, which stays sparse where G is. The order of
/// elimination is frozen, so that the same rows of a mechanism are dropped from state to state.
pub(super) struct Redundancy {
    fast: Ldlt,
    skipped: Vec<usize>,
}

impl Redundancy {
    pub fn new(g: &Pattern) -> Self {
        Redundancy {
            fast: Ldlt::new(&Pattern::diagonal(g.cols), g, &vec![false; g.cols]),
            skipped: Vec::with_capacity(g.rows),
        }
    }

    /// Marks dependent rows in `out` and returns their number; zero if the factorization fails.
    pub fn find(&mut self, weight: &[f64], values: &[f64], out: &mut [bool]) -> usize {
        if self.fast.factor(weight, values, Rule::lenient(tolerances::COLLAPSED, weight), &mut self.skipped).is_err() {
            self.skipped.clear();
        }
        out.fill(false);
        self.skipped.iter().for_each(|&row| out[row] = true);
        self.skipped.len()
    }
}
