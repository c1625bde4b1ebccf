//! Column-pivoted Householder QR and diagonally pivoted Cholesky on flat column-major slices, without allocation.
//!
//! faer's column-pivoted QR, twice as slow at 20 columns and three times as fast at 60, subtracts what it eliminates from
//! the norms of columns, which hides norms below 1e-8: of 140 columns, four of them dependent and a fifth but for 1.8e-9,
//! it took one with 7e-17 left before the fifth, and the rank at 1e-10 was one too low.

use crate::math::{add_scaled, dot};

/// A Pi = Q R of a tall or wide `rows` x `cols` matrix, in place: R above, the reflectors (leading 1 not stored) below.
pub struct PivotedQr {
    pub rows: usize,
    pub values: Vec<f64>,
    pub permutation: Vec<usize>,
    pub rank: usize,
    /// True for columns that are never chosen: they count as dependent.
    pub bars: Vec<bool>,
    /// Norm of the first dropped column's remainder, over the first pivot.
    rest: f64,
    factors: Vec<f64>,
    squares: Vec<f64>,
}

impl PivotedQr {
    pub fn new(rows: usize, cols: usize) -> Self {
        PivotedQr {
            rows,
            values: vec![0.0; rows * cols],
            permutation: (0..cols).collect(),
            rank: 0,
            bars: vec![false; cols],
            rest: 0.0,
            factors: vec![0.0; rows.min(cols)],
            squares: vec![0.0; cols],
        }
    }

    /// Factors `values` up to the first |R_kk| <= tolerance |R_00|. Column norms are recomputed, not downdated, for the
    /// accuracy of small ones; barred columns have a norm of -1. 3 rows cols^2 operations.
    pub fn factor(&mut self, tolerance: f64) {
        let rows = self.rows;
        let cols = self.permutation.len();
        self.permutation.iter_mut().enumerate().for_each(|(j, p)| *p = j);
        (self.rank, self.rest) = (0, 0.0);
        if rows == 0 {
            return;
        }
        let columns = self.values.chunks_exact(rows).zip(&self.bars);
        for (square, (column, is_barred)) in self.squares.iter_mut().zip(columns) {
            *square = if *is_barred { -1.0 } else { dot(column, column) };
        }
        let mut first = 0.0;
        for k in 0..rows.min(cols) {
            let best = (k..cols).fold(k, |best, j| if self.squares[j] > self.squares[best] { j } else { best });
            let norm = self.squares[best].sqrt();
            if k == 0 {
                first = norm;
            }
            if !(norm > tolerance * first && norm.is_finite()) {
                self.rest = norm / first;
                return;
            }
            self.swap(k, best);
            self.step(k, norm);
            self.rank = k + 1;
        }
    }

    /// True if columns are dependent to `tolerance`.
    pub fn is_deficient(&self, tolerance: f64) -> bool {
        self.rank < self.permutation.len() && (self.rest <= tolerance || self.rest.is_nan())
    }

    /// |R_rr| / |R_00|, the last kept pivot over the first.
    pub fn smallest_ratio(&self) -> f64 {
        let last = self.rank.checked_sub(1);
        last.map_or(1.0, |last| (self.r(last)[last] / self.r(0)[0]).abs())
    }

    fn swap(&mut self, k: usize, best: usize) {
        if k != best {
            self.permutation.swap(k, best);
            self.squares.swap(k, best);
            let (head, tail) = self.values.split_at_mut(best * self.rows);
            head[k * self.rows..(k + 1) * self.rows].swap_with_slice(&mut tail[..self.rows]);
        }
    }

    /// Column k becomes (.., beta, reflector); the columns behind it are reflected.
    fn step(&mut self, k: usize, norm: f64) {
        let rows = self.rows;
        let (head, tail) = self.values.split_at_mut((k + 1) * rows);
        let column = &mut head[k * rows + k..];
        let alpha = column[0];
        let beta = if alpha > 0.0 { -norm } else { norm };
        self.factors[k] = (beta - alpha) / beta;
        column[0] = beta;
        column[1..].iter_mut().for_each(|v| *v /= alpha - beta);
        for (other, square) in tail.chunks_exact_mut(rows).zip(&mut self.squares[k + 1..]) {
            // A column orthogonal to the reflector, as many of a sparse matrix, stays unchanged.
            if reflect(self.factors[k], &column[1..], &mut other[k..]) && *square >= 0.0 {
                *square = dot(&other[k + 1..], &other[k + 1..]);
            }
        }
    }

    /// x := Q x.
    pub fn apply(&self, x: &mut [f64]) {
        for k in (0..self.rank).rev() {
            reflect(self.factors[k], self.reflector(k), &mut x[k..]);
        }
    }

    /// x := Q^T x.
    pub fn apply_transposed(&self, x: &mut [f64]) {
        for k in 0..self.rank {
            reflect(self.factors[k], self.reflector(k), &mut x[k..]);
        }
    }

    fn reflector(&self, k: usize) -> &[f64] {
        &self.values[k * self.rows + k + 1..(k + 1) * self.rows]
    }

    /// Column j of R, down to its diagonal or the rank.
    pub fn r(&self, j: usize) -> &[f64] {
        &self.values[j * self.rows..][..self.rank.min(j + 1)]
    }

    /// x[..rank] := R11^-1 x[..rank].
    pub fn solve(&self, x: &mut [f64]) {
        for k in (0..self.rank).rev() {
            let column = self.r(k);
            x[k] /= column[k];
            let value = x[k];
            add_scaled(-value, &column[..k], &mut x[..k]);
        }
    }

    /// x[..rank] := R11^-T x[..rank].
    pub fn solve_transposed(&self, x: &mut [f64]) {
        for k in 0..self.rank {
            let column = self.r(k);
            x[k] = (x[k] - dot(&column[..k], &x[..k])) / column[k];
        }
    }
}

/// x := (I - factor v v^T) x with v = (1, below); false if x begins with zero and stays unchanged.
fn reflect(factor: f64, below: &[f64], x: &mut [f64]) -> bool {
    let Some((first, rest)) = x.split_first_mut() else { return false };
    let w = factor * (*first + dot(below, rest));
    if w == 0.0 && *first == 0.0 {
        return false;
    }
    *first -= w;
    add_scaled(-w, below, rest);
    true
}

/// P^T H P = L L^T of a symmetric positive semidefinite H (lower triangle given), in place.
pub struct PivotedCholesky {
    pub size: usize,
    pub values: Vec<f64>,
    permutation: Vec<usize>,
    x: Vec<f64>,
}

impl PivotedCholesky {
    pub fn new(largest: usize) -> Self {
        PivotedCholesky {
            size: 0,
            values: vec![0.0; largest * largest],
            permutation: vec![0; largest],
            x: vec![0.0; largest],
        }
    }

    /// Factors the leading size x size part. At a pivot <= tolerance times the largest diagonal entry it stops and
    /// leaves a null vector of H in `null`.
    pub fn factor(&mut self, tolerance: f64, null: &mut [f64]) -> Result<(), ()> {
        let size = self.size;
        self.permutation.iter_mut().enumerate().for_each(|(j, p)| *p = j);
        let mut limit = 0.0;
        for k in 0..size {
            let diagonal = |j: usize| self.values[j * size + j];
            let best = (k..size).fold(k, |best, j| if diagonal(j) > diagonal(best) { j } else { best });
            let pivot = diagonal(best);
            if k == 0 {
                limit = tolerance * pivot;
            }
            self.swap(k, best);
            if !(pivot > limit && pivot.is_finite()) {
                self.null_vector(k, null);
                return Err(());
            }
            self.step(k, pivot.sqrt());
        }
        Ok(())
    }

    /// Exchanges rows and columns k and best of the lower triangle.
    fn swap(&mut self, k: usize, best: usize) {
        let size = self.size;
        if k == best {
            return;
        }
        self.permutation.swap(k, best);
        let place = |i: usize, j: usize| i.min(j) * size + i.max(j);
        for i in (0..size).filter(|&i| i != k && i != best) {
            self.values.swap(place(i, k), place(i, best));
        }
        self.values.swap(k * size + k, best * size + best);
    }

    fn step(&mut self, k: usize, root: f64) {
        let size = self.size;
        let (head, tail) = self.values.split_at_mut((k + 1) * size);
        let column = &mut head[k * size + k..];
        column[0] = root;
        column[1..].iter_mut().for_each(|v| *v /= root);
        for (j, other) in tail.chunks_exact_mut(size).take(size - k - 1).enumerate() {
            add_scaled(-column[1 + j], &column[1 + j..], &mut other[k + 1 + j..size]);
        }
    }

    /// Null vector after k columns, the others being zero: (-L11^-T L21^T e, e).
    fn null_vector(&mut self, k: usize, null: &mut [f64]) {
        let size = self.size;
        self.x.fill(0.0);
        for j in 0..k {
            self.x[j] = -self.values[j * size + k];
        }
        for j in (0..k).rev() {
            let column = &self.values[j * size..(j + 1) * size];
            self.x[j] = (self.x[j] - dot(&column[j + 1..k], &self.x[j + 1..k])) / column[j];
        }
        self.x[k] = 1.0;
        for (x, &p) in self.x.iter().zip(&self.permutation[..size]) {
            null[p] = *x;
        }
    }

    /// b := H^-1 b.
    pub fn solve(&mut self, b: &mut [f64]) {
        let size = self.size;
        let x = &mut self.x;
        for (x, &p) in x.iter_mut().zip(&self.permutation[..size]) {
            *x = b[p];
        }
        for j in 0..size {
            let column = &self.values[j * size..(j + 1) * size];
            x[j] /= column[j];
            let value = x[j];
            add_scaled(-value, &column[j + 1..], &mut x[j + 1..size]);
        }
        for j in (0..size).rev() {
            let column = &self.values[j * size..(j + 1) * size];
            x[j] = (x[j] - dot(&column[j + 1..], &x[j + 1..size])) / column[j];
        }
        for (x, &p) in x.iter().zip(&self.permutation[..size]) {
            b[p] = *x;
        }
    }
}
