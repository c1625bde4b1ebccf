//! The arithmetic of bodies, W coordinates wide: S -= G M^-1 G^T, and both ways through G.

use super::bodies::{BlockSide, Bodies, BodyRun};
use super::kernels::{at, at_mut, subtract};
use super::lanes::Lanes;
use crate::math::array::from_fn;
use std::slice::Iter;

/// The Schur complement as it is made.
pub(super) struct Schur<'a> {
    pub bodies: &'a Bodies,
    /// Values of G, and the inverse masses by coordinate.
    pub g: &'a [f64],
    pub inverse: &'a [f64],
    /// The matrix of the unknowns that are left.
    pub work: &'a mut [f64],
}

impl Schur<'_> {
    /// Calls `reduce` for each body with its inverse masses, its blocks, the places of their products, G and the matrix.
    #[inline(always)]
    fn by_bodies<const W: usize>(
        &mut self,
        run: &BodyRun,
        reduce: impl Fn(&[f64; W], &[BlockSide], &mut Iter<u32>, &[f64], &mut [f64]),
    ) {
        let Schur { bodies, g, inverse, work } = self;
        let mut rest = &bodies.sides[run.sides.clone()];
        let mut targets = bodies.targets[run.targets.clone()].iter();
        for body in &bodies.all[run.bodies.clone()] {
            let Some(inverse) = at::<_, W>(inverse, body.first as usize) else { return };
            let (sides, others) = rest.split_at(body.sides as usize);
            rest = others;
            reduce(inverse, sides, &mut targets, g, work);
        }
    }

    /// Subtracts the products of blocks [s I | a], s = 1 or -1, of T rows for T translations and K rotations:
    ///
    /// ```text
    /// [s_k I | a_k] M^-1 [s_l I | a_l]^T = s_k s_l / m + a_k J^-1 a_l^T
    /// ```
    ///
    /// W = T + K, TW = T W, TT = T T.
    pub fn levers<const T: usize, const K: usize, const W: usize, const TW: usize, const TT: usize>(
        &mut self,
        run: &BodyRun,
    ) {
        self.by_bodies::<W>(run, |inverse, sides, targets, g, work| {
            for (l, side) in sides.iter().enumerate() {
                let Some(x) = at::<_, TW>(g, side.entries as usize) else { return };
                let scaled: [[f64; T]; K] = from_fn(|p| from_fn(|j| x[j * W + T + p] * inverse[T + p]));
                let identity: [f64; T] = from_fn(|i| side.sign * inverse[i]);
                for (side, &target) in sides[l..].iter().zip(targets.by_ref()) {
                    let x = at::<_, TW>(g, side.entries as usize);
                    let (Some(x), Some(target)) = (x, at_mut::<_, TT>(work, target as usize)) else { return };
                    for i in 0..T {
                        let mut row: [f64; T] = from_fn(|j| target[i * T + j]);
                        row[i] -= side.sign * identity[i];
                        for p in 0..K {
                            (0..T).for_each(|j| row[j] -= x[i * W + T + p] * scaled[p][j]);
                        }
                        (0..T).for_each(|j| target[i * T + j] = row[j]);
                    }
                }
            }
        });
    }

    /// Subtracts the products of other blocks.
    pub fn blocks<const W: usize>(&mut self, run: &BodyRun) {
        self.by_bodies::<W>(run, |inverse, sides, targets, g, work| {
            for (l, side) in sides.iter().enumerate() {
                let part = Products { inverse, sides: &sides[l..], targets: &mut *targets };
                by_width!(side.rows, part.subtract(g, work));
            }
        });
    }
}

/// The products of a body that are still to be subtracted: from some block on.
struct Products<'a, 'b, const W: usize> {
    inverse: &'a [f64; W],
    sides: &'a [BlockSide],
    targets: &'a mut Iter<'b, u32>,
}

impl<const W: usize> Products<'_, '_, W> {
    /// Subtracts the products of the first block, with R rows, and all.
    #[inline]
    fn subtract<const R: usize>(self, g: &[f64], work: &mut [f64]) {
        let Some(x) = block::<W>(g, &self.sides[0]).first_chunk::<R>() else { return };
        let scaled: [[f64; R]; W] = from_fn(|p| from_fn(|j| x[j][p] * self.inverse[p]));
        for (side, &target) in self.sides.iter().zip(self.targets) {
            let target = work[target as usize..].as_chunks_mut::<R>().0;
            block::<W>(g, side).iter().zip(target).for_each(|(x, row)| subtract(row, x, &scaled));
        }
    }
}

/// A block of G, row by row.
#[inline]
fn block<'a, const W: usize>(g: &'a [f64], side: &BlockSide) -> &'a [[f64; W]] {
    g[side.entries as usize..][..side.rows as usize * W].as_chunks::<W>().0
}

/// A right side as it is solved for.
pub(super) struct RightSide<'a, N> {
    pub bodies: &'a Bodies,
    pub g: &'a [f64],
    pub inverse: &'a [f64],
    /// Right sides of the coordinates, then M^-1 times them, then the solution.
    pub top: &'a mut [N],
    /// Those of the unknowns that are left.
    pub x: &'a mut [N],
}

impl<N: Lanes> RightSide<'_, N> {
    /// top := M^-1 top and x -= G top. `subtract` does the second for a block and the part of top of its body.
    #[inline(always)]
    fn forward_by<const W: usize>(&mut self, run: &BodyRun, subtract: impl Fn(&BlockSide, &[f64], &[N; W], &mut [N])) {
        let RightSide { bodies, g, inverse, top, x } = self;
        let mut rest = &bodies.sides[run.sides.clone()];
        for body in &bodies.all[run.bodies.clone()] {
            let first = body.first as usize;
            let (Some(inverse), Some(top)) = (at::<_, W>(inverse, first), at_mut::<_, W>(top, first)) else { return };
            *top = from_fn(|p| top[p] * inverse[p]);
            let (sides, others) = rest.split_at(body.sides as usize);
            rest = others;
            sides.iter().for_each(|side| subtract(side, g, top, x));
        }
    }

    /// top -= M^-1 G^T x. `add` adds the part of G^T x of a block.
    #[inline(always)]
    fn backward_by<const W: usize>(&mut self, run: &BodyRun, add: impl Fn(&BlockSide, &[f64], &mut [N; W], &[N])) {
        let RightSide { bodies, g, inverse, top, x } = self;
        let mut rest = &bodies.sides[run.sides.clone()];
        for body in &bodies.all[run.bodies.clone()] {
            let first = body.first as usize;
            let (Some(inverse), Some(top)) = (at::<_, W>(inverse, first), at_mut::<_, W>(top, first)) else { return };
            let (sides, others) = rest.split_at(body.sides as usize);
            rest = others;
            let mut sum = [N::default(); W];
            sides.iter().for_each(|side| add(side, g, &mut sum, x));
            *top = from_fn(|p| top[p] - sum[p] * inverse[p]);
        }
    }

    /// Forwards through blocks [s I | a].
    pub fn forward_levers<const T: usize, const K: usize, const W: usize, const TW: usize>(&mut self, run: &BodyRun) {
        self.forward_by::<W>(run, |side, g, mine, x| {
            let block = at::<_, TW>(g, side.entries as usize);
            let (Some(block), Some(x)) = (block, at_mut::<_, T>(x, side.position as usize)) else { return };
            for i in 0..T {
                let start = x[i] - mine[i] * side.sign;
                x[i] = (0..K).fold(start, |x, p| x - mine[T + p] * block[i * W + T + p]);
            }
        });
    }

    /// Backwards through blocks [s I | a].
    pub fn backward_levers<const T: usize, const K: usize, const W: usize, const TW: usize>(&mut self, run: &BodyRun) {
        self.backward_by::<W>(run, |side, g, sum, x| {
            let block = at::<_, TW>(g, side.entries as usize);
            let (Some(block), Some(x)) = (block, at::<_, T>(x, side.position as usize)) else { return };
            for i in 0..T {
                sum[i] = sum[i] + x[i] * side.sign;
                (0..K).for_each(|p| sum[T + p] = sum[T + p] + x[i] * block[i * W + T + p]);
            }
        });
    }

    /// Forwards through other blocks.
    pub fn forward<const W: usize>(&mut self, run: &BodyRun) {
        self.forward_by::<W>(run, |side, g, mine, x| {
            for (row, x) in block::<W>(g, side).iter().zip(&mut x[side.position as usize..]) {
                *x = (0..W).fold(*x, |x, p| x - mine[p] * row[p]);
            }
        });
    }

    /// Backwards through other blocks.
    pub fn backward<const W: usize>(&mut self, run: &BodyRun) {
        self.backward_by::<W>(run, |side, g, sum, x| {
            for (row, x) in block::<W>(g, side).iter().zip(&x[side.position as usize..]) {
                (0..W).for_each(|p| sum[p] = sum[p] + *x * row[p]);
            }
        });
    }
}
