//! Bodies whose mass matrix is not diagonal, such as those with products of inertia.
//!
//! With M = L D L^T of the body, coordinates L^T v have the masses D, and G enters as G L^-T:
//!
//! ```text
//! [M  G^T]   [L   ] [D        G̃^T] [L^T   ]
//! [G   0 ] = [   I] [G̃         0 ] [     I],    G̃ = G L^-T
//! ```

use super::super::pivot::Judge;
use super::groups::LARGEST;
use super::lanes::Lanes;
use crate::math::array::from_fn;
use std::ops::Range;

/// A body with its entries of M.
pub struct DenseBody {
    first: usize,
    width: usize,
    /// Entries of M in its lower triangle, with the row and the column there.
    entries: Vec<(usize, usize, usize)>,
    /// Rows and columns of the entries of L below the diagonal, column by column, and their places.
    lower: Vec<(usize, usize)>,
    places: Range<usize>,
    /// Entries of G in each of its blocks.
    blocks: Vec<Range<usize>>,
}

impl DenseBody {
    /// Of `width` coordinates from `first` on with these entries of M and blocks; L stands from `place` on. `None` if M
    /// is diagonal.
    pub fn new(
        first: usize,
        width: usize,
        mass: &[(usize, (usize, usize))],
        blocks: Vec<Range<usize>>,
        place: usize,
    ) -> Option<Self> {
        let entries: Vec<_> = mass.iter().map(|&(k, (i, j))| (k, i.max(j) - first, i.min(j) - first)).collect();
        let mut is_filled = [[false; LARGEST]; LARGEST];
        entries.iter().for_each(|&(_, p, q)| is_filled[p][q] = true);
        for q in 0..width {
            let below: Vec<usize> = (q + 1..width).filter(|&p| is_filled[p][q]).collect();
            below.iter().for_each(|&p| below.iter().filter(|&&r| r < p).for_each(|&r| is_filled[p][r] = true));
        }
        let places = (0..width).flat_map(|q| (q + 1..width).map(move |p| (p, q)));
        let lower: Vec<_> = places.filter(|&(p, q)| is_filled[p][q]).collect();
        let places = place..place + lower.len();
        (!lower.is_empty()).then_some(DenseBody { first, width, entries, lower, places, blocks })
    }

    /// Where the next body's entries of L begin.
    pub fn end(&self) -> usize {
        self.places.end
    }

    /// L and the inverse of D from M; each pivot is compared with its mass.
    pub(super) fn factor(
        &self,
        mass: &[f64],
        lower: &mut [f64],
        inverse: &mut [f64],
        judge: &mut Judge,
    ) -> Result<(), usize> {
        let mut m = [[0.0; LARGEST]; LARGEST];
        self.entries.iter().for_each(|&(entry, p, q)| m[p][q] += mass[entry]);
        let sizes: [f64; LARGEST] = from_fn(|p| m[p][p]);
        for p in 0..self.width {
            let own = judge.inverse(m[p][p], sizes[p], 1.0, || self.first + p)?;
            inverse[self.first + p] = own;
            for q in p + 1..self.width {
                let factor = m[q][p] * own;
                (p + 1..=q).for_each(|r| m[q][r] -= factor * m[r][p]);
            }
            (p + 1..self.width).for_each(|q| m[q][p] *= own);
        }
        lower[self.places.clone()].iter_mut().zip(&self.lower).for_each(|(l, &(p, q))| *l = m[p][q]);
        Ok(())
    }

    /// G := G L^-T of the body.
    pub fn transform(&self, lower: &[f64], g: &mut [f64]) {
        for block in &self.blocks {
            g[block.clone()].chunks_exact_mut(self.width).for_each(|row| self.forward(lower, row));
        }
    }

    /// top := L^-1 top
    pub fn enter(&self, lower: &[f64], top: &mut [f64]) {
        self.forward(lower, &mut top[self.first..][..self.width]);
    }

    /// top := L^-T top
    pub fn leave<T: Lanes>(&self, lower: &[f64], top: &mut [T]) {
        let x = &mut top[self.first..][..self.width];
        self.lower.iter().zip(&lower[self.places.clone()]).rev().for_each(|(&(p, q), l)| x[q] = x[q] - x[p] * *l);
    }

    fn forward(&self, lower: &[f64], x: &mut [f64]) {
        self.lower.iter().zip(&lower[self.places.clone()]).for_each(|(&(p, q), l)| x[p] -= l * x[q]);
    }

    /// True if the first coordinates are coupled to no other.
    pub fn leaves_alone(&self, first: usize) -> bool {
        self.lower.iter().all(|&(_, q)| q >= first)
    }
}
