//! The arithmetic of columns of blocks, W unknowns wide.

use super::super::pivot::{Quality, Rule};
use super::groups::LARGEST;
use super::layout::{Column, Layout};
use std::array::from_fn;
use std::ops::Range;

/// How pivots are judged, and what was found so far.
pub(super) struct Judge<'a> {
    /// Number of coordinates.
    pub n: usize,
    pub rule: Rule,
    pub skipped: &'a mut Vec<usize>,
    pub quality: Quality,
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

/// The products of a column that are still to be subtracted.
struct Products<'a, const W: usize> {
    /// X from some partner on, with the widths of these partners.
    xs: &'a [[f64; W]],
    partners: &'a [u8],
    /// Inverse of D.
    inverse: [f64; W],
    targets: &'a [u32],
    later: &'a mut [f64],
}

impl<const W: usize> Products<'_, W> {
    /// Subtracts X_k D^-1 X_l^T for the first partner l, R wide, and all partners k from it on.
    #[inline]
    fn subtract<const R: usize>(&mut self) {
        let Some(x) = self.xs.first_chunk::<R>() else { return };
        // By columns, so that the products of a row of X are those of whole rows.
        let scaled: [[f64; R]; W] = from_fn(|p| from_fn(|j| x[j][p] * self.inverse[p]));
        let mut rows = self.xs;
        for (&width, &target) in self.partners.iter().zip(self.targets) {
            let (x, others) = rows.split_at(usize::from(width));
            let target = self.later[target as usize..].as_chunks_mut::<R>().0;
            for (x, target) in x.iter().zip(target) {
                let mut row = *target;
                (0..W).for_each(|p| (0..R).for_each(|j| row[j] -= x[p] * scaled[p][j]));
                *target = row;
            }
            rows = others;
        }
        self.targets = &self.targets[self.partners.len()..];
        (self.xs, self.partners) = (&self.xs[R..], &self.partners[1..]);
    }
}

impl Elimination<'_, '_> {
    /// Eliminates columns whose partners are all R wide.
    pub fn alike<const W: usize, const R: usize>(&mut self, columns: Range<usize>) -> Result<(), usize> {
        let layout = self.layout;
        for column in &layout.columns[columns] {
            let Products { xs, inverse, targets, later, .. } = self.divide::<W>(column)?;
            let (xs, mut targets) = (xs.as_chunks::<R>().0, targets.iter());
            for (l, x) in xs.iter().enumerate() {
                let scaled: [[f64; W]; R] = from_fn(|j| from_fn(|p| x[j][p] * inverse[p]));
                for (x, target) in xs[l..].iter().zip(targets.by_ref()) {
                    let target = later[*target as usize..].as_chunks_mut::<R>().0;
                    if let Some(target) = target.first_chunk_mut::<R>() {
                        *target = from_fn(|i| from_fn(|j| target[i][j] - dot(&x[i], &scaled[j])));
                    }
                }
            }
        }
        Ok(())
    }

    /// Eliminates columns with partners of any width.
    pub fn mixed<const W: usize>(&mut self, columns: Range<usize>) -> Result<(), usize> {
        let layout = self.layout;
        for column in &layout.columns[columns] {
            let mut products = self.divide::<W>(column)?;
            for partner in &layout.partners[column.partners.clone()] {
                match partner {
                    1 => products.subtract::<1>(),
                    2 => products.subtract::<2>(),
                    3 => products.subtract::<3>(),
                    4 => products.subtract::<4>(),
                    5 => products.subtract::<5>(),
                    6 => products.subtract::<6>(),
                    7 => products.subtract::<7>(),
                    _ => products.subtract::<LARGEST>(),
                }
            }
        }
        Ok(())
    }

    /// Factors the diagonal block of a column and makes X of the blocks below.
    #[inline(always)]
    fn divide<const W: usize>(&mut self, column: &Column) -> Result<Products<'_, W>, usize> {
        let (own, later) = self.work[column.diagonal..].split_at_mut(column.below.end - column.diagonal);
        let (partners, targets) =
            (&self.layout.partners[column.partners.clone()], &self.layout.targets[column.targets..]);
        let unknowns = column.first..column.first + W;
        let (sizes, place) = (self.sizes[unknowns.clone()].first_chunk(), self.inverse[unknowns].first_chunk_mut());
        let (Some((diagonal, below)), Some(sizes), Some(place)) =
            (own.as_chunks_mut::<W>().0.split_first_chunk_mut::<W>(), sizes, place)
        else {
            return Ok(Products { xs: &[], partners: &[], inverse: [0.0; W], targets, later });
        };
        let judged = (sizes, column.sign, |p: usize| self.layout.nodes[column.first + p]);
        let inverse = match column.is_diagonal {
            true => inverse_of_diagonal(diagonal, judged, self.judge)?,
            false => {
                let inverse = factor(diagonal, judged, self.judge)?;
                below.iter_mut().for_each(|row| *row = forward(diagonal, *row));
                inverse
            }
        };
        *place = inverse;
        Ok(Products { xs: below, partners, inverse, targets, later })
    }
}

/// A right side as it is solved for.
pub(super) struct Solution<'a> {
    pub layout: &'a Layout,
    pub work: &'a [f64],
    pub inverse: &'a [f64],
    pub x: &'a mut [f64],
}

/// L_jj and X of a column, R rows at a time.
type Factors<'a, const W: usize, const R: usize> = (&'a [[f64; W]; W], &'a [[[f64; W]; R]]);

/// L_jj and X of a column, and the inverse of D; `None` if the column is not W wide.
#[inline]
fn factors<'a, const W: usize, const R: usize>(
    column: &Column,
    work: &'a [f64],
    inverse: &'a [f64],
) -> Option<(Factors<'a, W, R>, &'a [f64; W])> {
    let rows = work[column.diagonal..column.below.end].as_chunks::<W>().0;
    let (diagonal, below) = rows.split_first_chunk::<W>()?;
    Some(((diagonal, below.as_chunks::<R>().0), inverse[column.first..].first_chunk::<W>()?))
}

impl Solution<'_> {
    /// x := L^-1 x for these columns, whose partners are R wide, or of any width if R is 1.
    pub fn forward<const W: usize, const R: usize>(&mut self, columns: Range<usize>) {
        let Solution { layout, work, inverse, x } = self;
        for column in &layout.columns[columns] {
            let Some(((diagonal, below), inverse)) = factors::<W, R>(column, work, inverse) else { return };
            let Some(place) = x[column.first..].first_chunk_mut::<W>() else { return };
            let mine = if column.is_diagonal { *place } else { forward(diagonal, *place) };
            *place = mine;
            let mine: [f64; W] = from_fn(|p| mine[p] * inverse[p]);
            for (rows, places) in below.iter().zip(layout.rows[column.rows.clone()].as_chunks::<R>().0) {
                if let Some(x) = x[places[0] as usize..].first_chunk_mut::<R>() {
                    *x = from_fn(|i| x[i] - dot(&rows[i], &mine));
                }
            }
        }
    }

    /// x := L^-T D^-1 x for these columns, the last first.
    pub fn backward<const W: usize, const R: usize>(&mut self, columns: Range<usize>) {
        let Solution { layout, work, inverse, x } = self;
        for column in layout.columns[columns].iter().rev() {
            let Some(((diagonal, below), inverse)) = factors::<W, R>(column, work, inverse) else { return };
            let Some(place) = x[column.first..].first_chunk::<W>() else { return };
            let mut mine = *place;
            for (rows, places) in below.iter().zip(layout.rows[column.rows.clone()].as_chunks::<R>().0) {
                if let Some(x) = x[places[0] as usize..].first_chunk::<R>() {
                    rows.iter().zip(x).for_each(|(row, x)| mine = from_fn(|p| mine[p] - row[p] * x));
                }
            }
            mine = from_fn(|p| mine[p] * inverse[p]);
            if !column.is_diagonal {
                for p in (0..W).rev() {
                    (p + 1..W).for_each(|q| mine[p] -= diagonal[q][p] * mine[q]);
                }
            }
            if let Some(place) = x[column.first..].first_chunk_mut::<W>() {
                *place = mine;
            }
        }
    }
}

/// What the pivots of a block are judged by: their sizes, their sign and their nodes.
type Judged<'a, N, const W: usize> = (&'a [f64; W], f64, N);

/// L D L^T of a diagonal block in place; returns the inverse of D.
#[inline(always)]
fn factor<N: Fn(usize) -> usize, const W: usize>(
    block: &mut [[f64; W]; W],
    judged: Judged<N, W>,
    judge: &mut Judge,
) -> Result<[f64; W], usize> {
    let (mut own, mut inverse) = (*block, [0.0; W]);
    for p in 0..W {
        inverse[p] = judge.inverse(own[p][p], p, &judged)?;
        for q in p + 1..W {
            let factor = own[q][p] * inverse[p];
            (p + 1..=q).for_each(|r| own[q][r] -= factor * own[r][p]);
        }
        (p + 1..W).for_each(|q| own[q][p] *= inverse[p]);
    }
    *block = own;
    Ok(inverse)
}

#[inline(always)]
fn inverse_of_diagonal<N: Fn(usize) -> usize, const W: usize>(
    block: &[[f64; W]; W],
    judged: Judged<N, W>,
    judge: &mut Judge,
) -> Result<[f64; W], usize> {
    let mut inverse = [0.0; W];
    for p in 0..W {
        inverse[p] = judge.inverse(block[p][p], p, &judged)?;
    }
    Ok(inverse)
}

impl Judge<'_> {
    /// The inverse of a pivot.
    #[inline(always)]
    fn inverse<N: Fn(usize) -> usize, const W: usize>(
        &mut self,
        pivot: f64,
        p: usize,
        (sizes, sign, node): &Judged<N, W>,
    ) -> Result<f64, usize> {
        let positive = sign * pivot;
        // Written so that a NaN is judged too.
        match positive > self.rule.weak * sizes[p] && positive < f64::INFINITY {
            true => Ok(1.0 / pivot),
            false => self.judge(node(p), positive, sizes[p]),
        }
    }

    #[cold]
    #[inline(never)]
    fn judge(&mut self, node: usize, pivot: f64, size: f64) -> Result<f64, usize> {
        self.quality.judge((node, self.n), (pivot, size), self.rule, self.skipped)
    }
}

/// L^-1 x with the unit lower triangle of a diagonal block.
#[inline]
fn forward<const W: usize>(block: &[[f64; W]; W], mut x: [f64; W]) -> [f64; W] {
    for p in 0..W {
        (p + 1..W).for_each(|q| x[q] -= block[q][p] * x[p]);
    }
    x
}

#[inline]
fn dot<const W: usize>(a: &[f64; W], b: &[f64; W]) -> f64 {
    let mut sum = a[0] * b[0];
    (1..W).for_each(|p| sum += a[p] * b[p]);
    sum
}
