//! Block L D L^T over a frozen pattern.
//!
//! The saddle-point matrix is a matrix of small blocks, one for a body and a joint on it, in the order of
//! [`order`](super::order). Right-looking: with its diagonal block factored, L_jj D_j L_jj^T, column j subtracts
//!
//! ```text
//! A_kl -= X_k D_j^-1 X_l^T,      X_k = A_kj L_jj^-T = L_kj D_j
//! ```
//!
//! from the blocks right of it. For a rigid body that is the part of G M^-1 G^T that the body couples two of its joints
//! by, for a joint one update of Gaussian elimination. Pivots are those of the scalar factorization, and are judged one
//! by one.

mod groups;
mod kernels;
mod layout;

use super::pivot::{Quality, Rule};
use kernels::{Elimination, Judge, Solution};
pub(super) use layout::Layout;
use std::sync::Arc;

/// The factors, with the memory to make them and to solve.
pub(super) struct Blocks {
    layout: Arc<Layout>,
    /// Number of coordinates.
    n: usize,
    /// D, L_jj and X at the places of the layout.
    work: Vec<f64>,
    /// Inverses of the pivots, and what they are compared with, by position.
    inverse: Vec<f64>,
    sizes: Vec<f64>,
    x: Vec<f64>,
}

/// Calls a method with the widths of a run's columns and of their partners as constants: those of usual joints (one row,
/// hinge and sphere in the plane and in space), or another method for the other runs.
macro_rules! by_widths {
    ($run:ident, $part:ident, $alike:ident, $mixed:ident $(::<$rows:literal>)?) => {
        match ($run.width, $run.partner_width) {
            (1, 1) => $part.$alike::<1, 1>($run.columns.clone()),
            (2, 2) => $part.$alike::<2, 2>($run.columns.clone()),
            (3, 2) => $part.$alike::<3, 2>($run.columns.clone()),
            (3, 3) => $part.$alike::<3, 3>($run.columns.clone()),
            (5, 5) => $part.$alike::<5, 5>($run.columns.clone()),
            (6, 3) => $part.$alike::<6, 3>($run.columns.clone()),
            (6, 5) => $part.$alike::<6, 5>($run.columns.clone()),
            (1, _) => $part.$mixed::<1 $(, $rows)?>($run.columns.clone()),
            (2, _) => $part.$mixed::<2 $(, $rows)?>($run.columns.clone()),
            (3, _) => $part.$mixed::<3 $(, $rows)?>($run.columns.clone()),
            (4, _) => $part.$mixed::<4 $(, $rows)?>($run.columns.clone()),
            (5, _) => $part.$mixed::<5 $(, $rows)?>($run.columns.clone()),
            (6, _) => $part.$mixed::<6 $(, $rows)?>($run.columns.clone()),
            (7, _) => $part.$mixed::<7 $(, $rows)?>($run.columns.clone()),
            _ => $part.$mixed::<{ groups::LARGEST } $(, $rows)?>($run.columns.clone()),
        }
    };
}

impl Blocks {
    /// For M and G of the layout, with `n` coordinates.
    pub fn new(layout: Arc<Layout>, n: usize) -> Self {
        let zeros = || vec![0.0; layout.nodes.len()];
        Blocks { n, work: vec![0.0; layout.len], inverse: zeros(), sizes: zeros(), x: zeros(), layout }
    }

    /// Factors. The pivot of an early coordinate is compared with its mass; that of a multiplier with (G M^-1 G^T)_jj,
    /// which is on its diagonal after elimination of the early coordinates; that of a late coordinate with what the
    /// early ones subtracted from it. So units of coordinates and rows cancel. The error is the node whose pivot
    /// collapsed.
    pub fn factor(&mut self, mass: &[f64], g: &[f64], rule: Rule, skipped: &mut Vec<usize>) -> Result<Quality, usize> {
        self.work.fill(0.0);
        let (of_mass, of_g) = self.layout.slots.split_at(mass.len());
        of_mass.iter().zip(mass).for_each(|(&slot, value)| self.work[slot as usize] += value);
        of_g.iter().zip(g).for_each(|(&slot, value)| self.work[slot as usize] += value);
        let mut judge = Judge { n: self.n, rule, skipped, quality: Quality::GOOD };
        for (size, &place) in self.sizes.iter_mut().zip(&self.layout.diagonals) {
            *size = self.work[place as usize];
        }
        self.eliminate(true, &mut judge)?;
        for p in self.layout.early_unknowns..self.sizes.len() {
            let value = self.work[self.layout.diagonals[p] as usize];
            self.sizes[p] = if self.layout.nodes[p] < self.n { self.sizes[p] - value } else { -value };
        }
        self.eliminate(false, &mut judge)?;
        Ok(judge.quality)
    }

    /// Eliminates the early columns, or the others.
    fn eliminate(&mut self, early: bool, judge: &mut Judge) -> Result<(), usize> {
        let Blocks { layout, work, inverse, sizes, .. } = self;
        let mut part = Elimination { layout, work, inverse, sizes, judge };
        for run in layout.runs.iter().filter(|run| run.is_early == early) {
            by_widths!(run, part, alike, mixed)?;
        }
        Ok(())
    }

    /// Solves in place; dropped multipliers are zero. 2 multiplications for each entry of L.
    pub fn solve(&mut self, top: &mut [f64], bottom: &mut [f64]) {
        let Blocks { layout, work, inverse, x, .. } = self;
        let (of_top, of_bottom) = layout.positions.split_at(self.n);
        of_top.iter().zip(&*top).for_each(|(&p, value)| x[p as usize] = *value);
        of_bottom.iter().zip(&*bottom).for_each(|(&p, value)| x[p as usize] = *value);
        let mut part = Solution { layout, work, inverse, x };
        for run in &layout.runs {
            by_widths!(run, part, forward, forward::<1>);
        }
        for run in layout.runs.iter().rev() {
            by_widths!(run, part, backward, backward::<1>);
        }
        of_top.iter().zip(top).for_each(|(&p, value)| *value = self.x[p as usize]);
        of_bottom.iter().zip(bottom).for_each(|(&p, value)| *value = self.x[p as usize]);
    }

    /// The smallest ratio above `collapsed` of a pivot to its size before elimination, and the number of multipliers
    /// not above it.
    pub fn smallest_ratio(&self, collapsed: f64) -> (f64, usize) {
        let mut found = (1.0, 0);
        for (p, &place) in self.layout.diagonals.iter().enumerate() {
            let is_coordinate = self.layout.nodes[p] < self.n;
            let pivot = if is_coordinate { self.work[place as usize] } else { -self.work[place as usize] };
            let is_late = is_coordinate && p >= self.layout.early_unknowns;
            let ratio: f64 = pivot / if is_late { self.sizes[p] + pivot } else { self.sizes[p] };
            // Written so that the NaN of a row of zeros has collapsed.
            match ratio > collapsed {
                true => found.0 = ratio.min(found.0),
                false => found.1 += usize::from(!is_coordinate),
            }
        }
        found
    }
}
