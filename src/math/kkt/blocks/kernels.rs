//! The arithmetic of columns of blocks, W unknowns wide.

use super::super::pivot::Judge;
use super::lanes::Lanes;
use super::layout::{ColumnRun, Layout};
use crate::math::array::from_fn;

/// The first N numbers from `place` on.
#[inline(always)]
pub(super) fn at<T, const N: usize>(numbers: &[T], place: usize) -> Option<&[T; N]> {
    numbers.get(place..)?.first_chunk()
}

#[inline(always)]
pub(super) fn at_mut<T, const N: usize>(numbers: &mut [T], place: usize) -> Option<&mut [T; N]> {
    numbers.get_mut(place..)?.first_chunk_mut()
}

/// row -= x scaled
#[inline(always)]
pub(super) fn subtract<const W: usize, const R: usize>(row: &mut [f64; R], x: &[f64; W], scaled: &[[f64; R]; W]) {
    let mut left = *row;
    for p in 0..W {
        (0..R).for_each(|j| left[j] -= x[p] * scaled[p][j]);
    }
    *row = left;
}

/// The factors as they are made.
pub(super) struct Elimination<'a, 'j> {
    pub layout: &'a Layout,
    /// The matrix, then D, L_jj and X.
    pub work: &'a mut [f64],
    /// By position: inverses of the pivots, and what these are compared with.
    pub inverse: &'a mut [f64],
    pub sizes: &'a [f64],
    pub judge: &'a mut Judge<'j>,
}

impl Elimination<'_, '_> {
    /// Eliminates columns whose partners are all R wide; WR = W R.
    pub fn alike<const W: usize, const R: usize, const WR: usize>(&mut self, run: &ColumnRun) -> Result<(), usize> {
        let layout = self.layout;
        let mut targets = layout.targets[run.targets.clone()].iter();
        self.columns::<W>(run, |xs, inverse, later| {
            let xs = xs.as_chunks::<WR>().0;
            for (l, x) in xs.iter().enumerate() {
                let scaled: [[f64; R]; W] = from_fn(|p| from_fn(|j| x[j * W + p] * inverse[p]));
                for (x, &target) in xs[l..].iter().zip(targets.by_ref()) {
                    for i in 0..R {
                        if let Some(row) = at_mut::<_, R>(later, target as usize + i * R) {
                            subtract(row, &from_fn(|p| x[i * W + p]), &scaled);
                        }
                    }
                }
            }
        })
    }

    /// Eliminates columns with partners of any width.
    pub fn mixed<const W: usize>(&mut self, run: &ColumnRun) -> Result<(), usize> {
        let layout = self.layout;
        let mut targets = &layout.targets[run.targets.clone()];
        let mut widths = &layout.widths[run.partners.clone()];
        self.columns::<W>(run, |xs, inverse, later| {
            let mut xs = xs.as_chunks::<W>().0;
            while let (false, Some(&width)) = (xs.is_empty(), widths.first()) {
                let part = Products { xs, widths, inverse, targets, later: &mut *later };
                let products = by_width!(width, part.subtract());
                (xs, widths, targets) = (&xs[usize::from(width)..], &widths[1..], &targets[products..]);
            }
        })
    }

    /// Factors the diagonal block of each column and makes X of the blocks below. `update` subtracts the products of X
    /// from the columns behind it, with the inverse of D.
    #[inline(always)]
    fn columns<const W: usize>(
        &mut self,
        run: &ColumnRun,
        mut update: impl FnMut(&[f64], &[f64; W], &mut [f64]),
    ) -> Result<(), usize> {
        let Elimination { layout, work, inverse, sizes, judge } = self;
        let mut rest = &mut work[run.place..];
        let inverses = inverse[run.first..].as_chunks_mut::<W>().0.iter_mut();
        let sizes = sizes[run.first..].as_chunks::<W>().0.iter();
        let heights = layout.heights[run.columns.clone()].iter();
        for (j, ((&height, inverse), sizes)) in heights.zip(inverses).zip(sizes).enumerate() {
            let (own, later) = rest.split_at_mut(W * (W + height as usize));
            rest = later;
            let (diagonal, below) = own.split_at_mut(W * W);
            let Some(diagonal) = diagonal.as_chunks_mut::<W>().0.first_chunk_mut::<W>() else { return Ok(()) };
            for p in 0..W {
                let node = || layout.nodes[run.first + j * W + p];
                inverse[p] = judge.inverse(diagonal[p][p], sizes[p], run.sign, node)?;
                if !run.is_diagonal {
                    for q in p + 1..W {
                        let factor = diagonal[q][p] * inverse[p];
                        (p + 1..=q).for_each(|r| diagonal[q][r] -= factor * diagonal[r][p]);
                    }
                    (p + 1..W).for_each(|q| diagonal[q][p] *= inverse[p]);
                }
            }
            if !run.is_diagonal {
                below.as_chunks_mut::<W>().0.iter_mut().for_each(|row| forward(diagonal, row));
            }
            update(below, inverse, rest);
        }
        Ok(())
    }
}

/// The products of a column that are still to be subtracted.
struct Products<'a, const W: usize> {
    /// X from some partner on, with the widths of these partners.
    xs: &'a [[f64; W]],
    widths: &'a [u8],
    /// Inverse of D.
    inverse: &'a [f64; W],
    targets: &'a [u32],
    later: &'a mut [f64],
}

impl<const W: usize> Products<'_, W> {
    /// Subtracts X_k D^-1 X_l^T for the first partner l, R wide, and all partners k from it on; returns their number.
    #[inline]
    fn subtract<const R: usize>(self) -> usize {
        let Some(x) = self.xs.first_chunk::<R>() else { return 0 };
        // By columns, so that the products of a row of X are those of whole rows.
        let scaled: [[f64; R]; W] = from_fn(|p| from_fn(|j| x[j][p] * self.inverse[p]));
        let mut rows = self.xs;
        let mut count = 0;
        for (&width, &target) in self.widths.iter().zip(self.targets) {
            if rows.is_empty() {
                break;
            }
            let (x, others) = rows.split_at(usize::from(width));
            let target = self.later[target as usize..].as_chunks_mut::<R>().0;
            x.iter().zip(target).for_each(|(x, row)| subtract(row, x, &scaled));
            (rows, count) = (others, count + 1);
        }
        count
    }
}

/// A right side as it is solved for.
pub(super) struct Solution<'a, T> {
    pub layout: &'a Layout,
    pub work: &'a [f64],
    pub inverse: &'a [f64],
    pub x: &'a mut [T],
}

impl<T: Lanes> Solution<'_, T> {
    /// x := L^-1 x
    pub fn forward<const W: usize>(&mut self, run: &ColumnRun) {
        let Solution { layout, work, inverse, x } = self;
        let mut work = &work[run.place..];
        let mut below = &layout.below[run.rows.clone()];
        let inverses = inverse[run.first..].as_chunks::<W>().0;
        for (j, (&height, inverse)) in layout.heights[run.columns.clone()].iter().zip(inverses).enumerate() {
            let (own, rest) = work.split_at(W * (W + height as usize));
            let (positions, others) = below.split_at(height as usize);
            work = rest;
            below = others;
            let Some(mine) = solved_forward(run, own, inverse, run.first + j * W, x) else { return };
            for (row, &position) in own[W * W..].as_chunks::<W>().0.iter().zip(positions) {
                let x = &mut x[position as usize];
                *x = (0..W).fold(*x, |x, p| x - mine[p] * row[p]);
            }
        }
    }

    /// x := L^-T D^-1 x, the last column first.
    pub fn backward<const W: usize>(&mut self, run: &ColumnRun) {
        let Solution { layout, work, inverse, x } = self;
        let mut work = &work[..run.end];
        let mut below = &layout.below[run.rows.clone()];
        let inverses = inverse[run.first..].as_chunks::<W>().0;
        for (j, (&height, inverse)) in layout.heights[run.columns.clone()].iter().zip(inverses).enumerate().rev() {
            let (rest, own) = work.split_at(work.len() - W * (W + height as usize));
            let (others, positions) = below.split_at(below.len() - height as usize);
            work = rest;
            below = others;
            let mut sum = [T::default(); W];
            for (row, &position) in own[W * W..].as_chunks::<W>().0.iter().zip(positions) {
                let x = x[position as usize];
                (0..W).for_each(|p| sum[p] = sum[p] + x * row[p]);
            }
            solve_backward(run, own, inverse, &sum, run.first + j * W, x);
        }
    }
}

/// x := L_jj^-1 x for a column with its diagonal block ahead; returns D^-1 x.
#[inline(always)]
fn solved_forward<T: Lanes, const W: usize>(
    run: &ColumnRun,
    block: &[f64],
    inverse: &[f64; W],
    first: usize,
    x: &mut [T],
) -> Option<[T; W]> {
    let diagonal = block.as_chunks::<W>().0.first_chunk::<W>()?;
    let x = at_mut::<_, W>(x, first)?;
    if !run.is_diagonal {
        forward(diagonal, x);
    }
    Some(from_fn(|p| x[p] * inverse[p]))
}

/// x := L_jj^-T D^-1 (x - sum) for a column with its diagonal block ahead.
#[inline(always)]
fn solve_backward<T: Lanes, const W: usize>(
    run: &ColumnRun,
    block: &[f64],
    inverse: &[f64; W],
    sum: &[T; W],
    first: usize,
    x: &mut [T],
) {
    let diagonal = block.as_chunks::<W>().0.first_chunk::<W>();
    let (Some(diagonal), Some(x)) = (diagonal, at_mut::<_, W>(x, first)) else { return };
    *x = from_fn(|p| (x[p] - sum[p]) * inverse[p]);
    if !run.is_diagonal {
        for p in (0..W).rev() {
            (p + 1..W).for_each(|q| x[p] = x[p] - x[q] * diagonal[q][p]);
        }
    }
}

/// x := L^-1 x with the unit lower triangle of a diagonal block.
#[inline(always)]
fn forward<T: Lanes, const W: usize>(block: &[[f64; W]; W], x: &mut [T; W]) {
    for p in 0..W {
        (p + 1..W).for_each(|q| x[q] = x[q] - x[p] * block[q][p]);
    }
}
