//! The dense null-space solution as a solver of its own.

use super::null_space::NullSpace;
use super::system::System;
use super::{Pattern, Singular, Solver};

/// [M G^T; G 0] always by a pivoted QR of G^T: a = Y y + Z z with G Z = 0, then Z^T M Z z = Z^T (r1 - M Y y), then
/// lambda from r1 - M a. Dependent rows get multipliers of least norm, contradictions a least-squares solution.
pub struct Reduced {
    /// Rows of G count as dependent when their pivot in the QR falls below this fraction of the largest,
    /// or below 1e-4 of the reference value.
    pub rank_tolerance: f64,
    system: System,
    null_space: NullSpace,
    is_factored: bool,
}

impl Reduced {
    /// `None` if the sizes of the patterns do not agree.
    pub fn new(mass: &Pattern, g: &Pattern) -> Option<Self> {
        let fits = mass.cols == mass.rows && g.cols == mass.rows && mass.is_inside() && g.is_inside();
        fits.then(|| Reduced {
            rank_tolerance: 1e-10,
            system: System::new(mass, g),
            null_space: NullSpace::new(mass, g),
            is_factored: false,
        })
    }
}

impl Solver for Reduced {
    fn factor(&mut self, mass: &[f64], g: &[f64], reference: f64) -> Result<(), Singular> {
        self.is_factored = false;
        if mass.len() != self.system.mass.entries.len() || g.len() != self.system.g.entries.len() {
            return Err(Singular::Shape);
        }
        if !mass.iter().chain(g).all(|v| v.is_finite()) {
            return Err(Singular::NotFinite);
        }
        self.system.store(mass, g);
        self.null_space.factor_truncated(&self.system, self.rank_tolerance, reference)?;
        self.is_factored = true;
        Ok(())
    }

    fn solve(&mut self, top: &mut [f64], bottom: &mut [f64]) -> Result<(), Singular> {
        if top.len() != self.system.mass.rows || bottom.len() != self.system.g.rows {
            return Err(Singular::Shape);
        }
        if !self.is_factored {
            return Err(Singular::NotFactored);
        }
        self.null_space.solve(&self.system, top, bottom);
        Ok(())
    }

    fn is_rank_deficient(&self) -> bool {
        self.null_space.is_deficient(self.rank_tolerance)
    }

    fn rank_indicator(&self) -> f64 {
        self.null_space.smallest_ratio().sqrt()
    }

    fn row_indicator(&self) -> Option<f64> {
        Some(self.rank_indicator())
    }
}
