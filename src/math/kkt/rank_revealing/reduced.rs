//! The dense null-space solution as a solver of its own.

use super::super::system::System;
use super::super::{Pattern, Singular};
use super::{NullSpace, truncated};

/// [M G^T; G 0] always by a pivoted QR of G^T: a = Y y + Z z with G Z = 0, then Z^T M Z z = Z^T (r1 - M Y y), then
/// lambda from r1 - M a. Dependent rows get multipliers of least norm, contradictions a least-squares solution.
pub struct Reduced {
    rank_tolerance: f64,
    system: System,
    null_space: NullSpace,
    drops_rows: bool,
    is_factored: bool,
}

impl Reduced {
    /// Rows of G count as dependent when their pivot in the QR falls below `rank_tolerance` of the largest, or below
    /// 1e-4 of the reference value. `None` if the sizes of the patterns do not agree.
    pub fn new(mass: &Pattern, g: &Pattern, rank_tolerance: f64) -> Option<Self> {
        let fits = mass.cols == mass.rows && g.cols == mass.rows && mass.is_inside() && g.is_inside();
        fits.then(|| Reduced {
            rank_tolerance,
            system: System::new(mass, g),
            null_space: NullSpace::new(mass, g),
            drops_rows: false,
            is_factored: false,
        })
    }

    /// Drops these rows, and those that depend on the others, from the next factorization on: see
    /// [`SaddlePoint::drop_rows`](super::super::SaddlePoint::drop_rows).
    pub fn drop_rows(&mut self, rows: &[usize]) {
        self.drops_rows = !rows.is_empty();
        self.null_space.drop_rows(rows);
    }

    /// Factors with these values at the places of M and G. Near singular states rows count as dependent below 1e-4 of
    /// `reference`, the rank indicator at regular states; zero if that is not known.
    pub fn factor(&mut self, mass: &[f64], g: &[f64], reference: f64) -> Result<(), Singular> {
        self.is_factored = false;
        if mass.len() != self.system.mass.entries.len() || g.len() != self.system.g.entries.len() {
            return Err(Singular::Shape);
        }
        if !mass.iter().chain(g).all(|v| v.is_finite()) {
            return Err(Singular::NotFinite);
        }
        self.system.store(mass, g);
        self.null_space.factor(&self.system, truncated(self.rank_tolerance, reference))?;
        self.is_factored = true;
        Ok(())
    }

    /// Solves in place: (r1, r2) -> (a, lambda).
    pub fn solve(&mut self, top: &mut [f64], bottom: &mut [f64]) -> Result<(), Singular> {
        if top.len() != self.system.mass.rows || bottom.len() != self.system.g.rows {
            return Err(Singular::Shape);
        }
        if !self.is_factored {
            return Err(Singular::NotFactored);
        }
        self.null_space.solve(&self.system, top, bottom);
        Ok(())
    }

    /// True if rows were dependent at the last factorization, to round-off.
    pub fn is_rank_deficient(&self) -> bool {
        self.drops_rows || self.null_space.is_deficient(self.rank_tolerance)
    }

    /// Smallest pivot of the QR over the largest, without dropped rows.
    pub fn rank_indicator(&self) -> f64 {
        self.null_space.smallest_ratio().sqrt()
    }
}
