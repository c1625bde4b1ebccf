//! One level of the staircase that deflates infinite eigenvalues.

use super::super::{Matrix, Unsolved};
use crate::tolerances;

/// One level: with regular P = [P1 P2] and X = [X1 X2],
///
/// ```text
/// P^T (A - lambda E) X = [A11 - lambda E11   A12 - lambda E12]
///                        [A21 - lambda E21   A22             ]
/// ```
///
/// where A22 is regular and either the lower left or the upper right block is zero: A11 - lambda E11 has all
/// eigenvalues except as many infinite ones as A22 has rows.
pub struct Level {
    /// Block A11.
    pub a: Matrix,
    /// Block E11.
    pub e: Matrix,
    pub corner: Matrix,
    pub p: [Matrix; 2],
    pub x: [Matrix; 2],
    pub coupling: Coupling,
}

/// The off-diagonal block that is not zero.
pub enum Coupling {
    UpperRight { a: Matrix, e: Matrix },
    LowerLeft { a: Matrix, e: Matrix },
}

impl Level {
    pub fn size(&self) -> usize {
        self.corner.nrows()
    }

    /// The basis V with A V = E V F from Z with A11 Z = E11 Z F: V = X1 Z + X2 A22^-1 (E21 Z F - A21 Z).
    pub fn lift(&self, z: &Matrix, rate: &Matrix) -> Option<Matrix> {
        let kept = &self.x[0] * z;
        match &self.coupling {
            Coupling::UpperRight { .. } => Some(kept),
            Coupling::LowerLeft { a, e } => {
                let follows = self.corner.clone().full_piv_lu().solve(&(e * z * rate - a * z))?;
                Some(kept + &self.x[1] * follows)
            }
        }
    }

    /// W with W A = F W E from Z with Z A11 = F Z E11: W = Z P1^T + (F Z E12 - Z A12) A22^-1 P2^T.
    pub fn lift_left(&self, z: &Matrix, rate: &Matrix) -> Option<Matrix> {
        let kept = z * self.p[0].transpose();
        match &self.coupling {
            Coupling::LowerLeft { .. } => Some(kept),
            Coupling::UpperRight { a, e } => {
                let right = (rate * z * e - z * a).transpose();
                let follows = self.corner.transpose().full_piv_lu().solve(&right)?;
                Some(kept + (&self.p[1] * follows).transpose())
            }
        }
    }
}

/// Decides ranks, with the smallest gap of all decisions.
pub struct Ranks {
    tolerance: f64,
    gap: f64,
}

impl Ranks {
    pub fn new(tolerance: f64) -> Ranks {
        Ranks { tolerance: tolerance.max(tolerances::ROUNDED_ZERO), gap: f64::INFINITY }
    }

    /// Number of these descending singular values above the tolerance.
    pub fn rank(&mut self, values: &[f64]) -> usize {
        let rank = values.iter().take_while(|value| **value > self.tolerance).count();
        let kept = rank.checked_sub(1).map_or(1.0, |last| values[last]);
        let dropped = values.get(rank).copied().unwrap_or(0.0).max(tolerances::ROUNDED_ZERO);
        self.gap = self.gap.min(kept / dropped);
        rank
    }

    pub fn gap(&self) -> Result<f64, Unsolved> {
        let gap = self.gap.min(tolerances::ROUNDED_ZERO.recip());
        if gap < tolerances::RANK_GAP { Err(Unsolved::Doubtful { gap }) } else { Ok(gap) }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_rank_near_the_tolerance_is_doubtful() {
        let mut ranks = Ranks::new(1e-10);
        assert_eq!((ranks.rank(&[1.0, 1e-3]), ranks.rank(&[]), ranks.rank(&[1.0, 1e-15])), (2, 0, 1));
        assert_eq!(ranks.gap(), Ok(1e12));
        assert_eq!(ranks.rank(&[1.0, 3e-10, 0.5e-10]), 2);
        assert!(matches!(ranks.gap(), Err(Unsolved::Doubtful { .. })));
    }
}
