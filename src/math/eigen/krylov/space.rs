//! Orthonormal bases of Krylov spaces.

use super::super::{Unsolved, dense};
use super::{Ordered, Partial, Ritz, Scalar};
use crate::tolerances;
use faer::linalg::matmul::matmul;
use faer::{Accum, MatMut, MatRef, Par};
use nalgebra::{DMatrix, DVector};

/// Krylov decomposition apply(V) = V H + rest v e_m^T with orthonormal [V v], V n x m.
pub struct Krylov<T, F> {
    apply: F,
    /// [V v]: m + 1 columns, the last one the direction v of the residual.
    v: DMatrix<T>,
    pub h: DMatrix<T>,
    pub rest: f64,
    /// Number of columns of V and H computed so far.
    size: usize,
    /// Row below H that couples the residual of a contracted space to V.
    below: Vec<T>,
    starts: u64,
    filter: usize,
}

impl<T: Scalar, F: FnMut(&[T], &mut [T]) -> Result<(), Unsolved>> Krylov<T, F> {
    pub fn new(n: usize, m: usize, filter: usize, apply: F) -> Result<Self, Unsolved> {
        let mut space = Krylov {
            apply,
            v: DMatrix::zeros(n, m + 1),
            h: DMatrix::zeros(m, m),
            rest: 0.0,
            size: 0,
            below: Vec::new(),
            starts: 0,
            filter,
        };
        space.start(0)?;
        Ok(space)
    }

    /// Writes a new direction to column k, orthogonal to those before it; zero if these span the whole space.
    fn start(&mut self, k: usize) -> Result<(), Unsolved> {
        self.starts += 1;
        let direction = dense::direction(self.v.nrows(), self.starts).map(T::from_real);
        let mut fresh = DVector::from_iterator(self.v.nrows(), direction);
        fresh.unscale_mut(fresh.norm());
        for _ in 0..self.filter {
            fresh = self.image(&fresh)?;
            fresh.unscale_mut(fresh.norm().max(f64::MIN_POSITIVE));
        }
        self.orthogonalize(&mut fresh, k);
        let norm = fresh.norm();
        if norm > tolerances::ROUND_OFF_OF_SUMS {
            self.v.set_column(k, &fresh.unscale(norm));
        } else {
            self.v.column_mut(k).fill(T::ZERO);
        }
        Ok(())
    }

    fn image(&mut self, x: &DVector<T>) -> Result<DVector<T>, Unsolved> {
        let mut image = DVector::zeros(x.len());
        (self.apply)(x.as_slice(), image.as_mut_slice())?;
        if image.iter().all(|x| x.size().is_finite()) { Ok(image) } else { Err(Unsolved::NotFinite) }
    }

    /// Makes a vector orthogonal to the first k columns, twice; returns its components along them.
    fn orthogonalize(&self, vector: &mut DVector<T>, k: usize) -> DVector<T> {
        let n = self.v.nrows();
        let known = dense::view(&self.v).subcols(0, k);
        let mut total = DVector::zeros(k);
        let mut part = DVector::zeros(k);
        let one = T::from_real(1.0);
        for _ in 0..2 {
            let x = MatRef::from_column_major_slice(vector.as_slice(), n, 1);
            let to = MatMut::from_column_major_slice_mut(part.as_mut_slice(), k, 1);
            matmul(to, Accum::Replace, known.adjoint(), x, one, Par::Seq);
            let from = MatRef::from_column_major_slice(part.as_slice(), k, 1);
            let rest = MatMut::from_column_major_slice_mut(vector.as_mut_slice(), n, 1);
            matmul(rest, Accum::Add, known, from, -one, Par::Seq);
            total += &part;
        }
        total
    }

    /// Extends the space to m columns.
    pub fn extend(&mut self) -> Result<(), Unsolved> {
        let m = self.h.ncols();
        while self.size < m {
            let k = self.size;
            let mut next = self.image(&self.v.column(k).clone_owned())?;
            let before = next.norm();
            let part = self.orthogonalize(&mut next, k + 1);
            self.h.view_mut((0, k), (k + 1, 1)).copy_from(&part);
            for (j, coupling) in std::mem::take(&mut self.below).into_iter().enumerate() {
                self.h[(k, j)] = coupling;
            }
            let after = next.norm();
            self.size += 1;
            let is_inside = after <= tolerances::ROUND_OFF_OF_SUMS * before;
            self.rest = if is_inside { 0.0 } else { after };
            if is_inside {
                self.start(k + 1)?
            } else {
                self.v.set_column(k + 1, &next.unscale(after))
            }
            if self.size < m {
                self.h[(k + 1, k)] = T::from_real(self.rest);
            }
        }
        Ok(())
    }

    /// Combinations of the columns of V by the first `count` columns of `by`.
    fn spanned(&self, by: &DMatrix<T>, count: usize) -> DMatrix<T> {
        dense::product(dense::view(&self.v).subcols(0, by.nrows()), dense::view(by).subcols(0, count))
    }

    /// Keeps the leading `kept` Schur vectors, one more where a pair would be parted.
    pub fn contract(&mut self, schur: &Ordered<T>, kept: usize) {
        let m = self.h.ncols();
        let kept = schur.whole(kept);
        let v = self.spanned(&schur.q, kept);
        let last = self.v.column(m).clone_owned();
        self.v.columns_mut(0, kept).copy_from(&v);
        self.v.set_column(kept, &last);
        self.h.fill(T::ZERO);
        self.h.view_mut((0, 0), (kept, kept)).copy_from(&schur.t.view((0, 0), (kept, kept)));
        self.below = (0..kept).map(|j| schur.q[(m - 1, j)] * self.rest).collect();
        self.size = kept;
    }

    /// Keeps the leading `kept` Schur vectors, which have converged, and continues from a new direction.
    pub fn renew(&mut self, schur: &Ordered<T>, kept: usize) -> Result<(), Unsolved> {
        self.contract(schur, kept);
        self.below.clear();
        self.start(self.size)
    }

    /// The first `count` values with as many leading Schur vectors, one more where a pair would be parted.
    pub fn finish(self, mut ritz: Ritz, count: usize) -> Result<Partial<T>, Unsolved> {
        let schur = Ordered::of(&self.h, &ritz)?;
        let count = schur.whole(count);
        ritz.values.truncate(count);
        Ok(Partial { values: ritz.values, basis: self.spanned(&schur.q, count) })
    }
}
