//! Orthonormal bases of Krylov spaces.

use super::super::{ComplexMatrix, Unsolved, dense};
use super::{C, Ordered, Partial};
use crate::tolerances::math as tolerances;
use faer::linalg::matmul::matmul;
use faer::{Accum, MatMut, MatRef, Par};
use nalgebra::DVector;

type Vector = DVector<C>;

/// Krylov decomposition apply(V) = V H + rest v e_m^T with orthonormal [V v], V n x m.
pub struct Krylov<F> {
    apply: F,
    /// [V v]: m + 1 columns, the last one the direction v of the residual.
    v: ComplexMatrix,
    pub h: ComplexMatrix,
    pub rest: f64,
    /// Number of columns of V and H computed so far.
    size: usize,
    /// Row below H that couples the residual of a contracted space to V.
    below: Vec<C>,
    starts: u64,
    filter: usize,
}

impl<F: FnMut(&[C], &mut [C]) -> Result<(), Unsolved>> Krylov<F> {
    pub fn new(n: usize, m: usize, filter: usize, apply: F) -> Result<Self, Unsolved> {
        let mut space = Krylov {
            apply,
            v: ComplexMatrix::zeros(n, m + 1),
            h: ComplexMatrix::zeros(m, m),
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
        let mut fresh = Vector::from_iterator(self.v.nrows(), dense::direction(self.v.nrows(), self.starts));
        fresh /= C::from(fresh.norm());
        for _ in 0..self.filter {
            fresh = self.image(&fresh)?;
            fresh /= C::from(fresh.norm().max(f64::MIN_POSITIVE));
        }
        self.orthogonalize(&mut fresh, k);
        let norm = fresh.norm();
        if norm > tolerances::ROUND_OFF_OF_SUMS {
            self.v.set_column(k, &(fresh / C::from(norm)));
        } else {
            self.v.column_mut(k).fill(C::ZERO);
        }
        Ok(())
    }

    fn image(&mut self, x: &Vector) -> Result<Vector, Unsolved> {
        let mut image = Vector::zeros(x.len());
        (self.apply)(x.as_slice(), image.as_mut_slice())?;
        if image.iter().all(|x| x.is_finite()) { Ok(image) } else { Err(Unsolved::NotFinite) }
    }

    /// Makes a vector orthogonal to the first k columns, twice; returns its components along them.
    fn orthogonalize(&self, vector: &mut Vector, k: usize) -> Vector {
        let n = self.v.nrows();
        let known = dense::view(&self.v).subcols(0, k);
        let (mut total, mut part) = (Vector::zeros(k), Vector::zeros(k));
        let one = C::from(1.0);
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
            match is_inside {
                true => self.start(k + 1)?,
                false => self.v.set_column(k + 1, &(next / C::from(after))),
            }
            if self.size < m {
                self.h[(k + 1, k)] = C::from(self.rest);
            }
        }
        Ok(())
    }

    /// Combinations of the first m columns of V by the first `count` columns of `by`.
    fn spanned(&self, m: usize, by: &ComplexMatrix, count: usize) -> ComplexMatrix {
        dense::product(dense::view(&self.v).subcols(0, m), dense::view(by).subcols(0, count))
    }

    /// Keeps the leading `kept` Schur vectors.
    pub fn contract(&mut self, schur: &Ordered, kept: usize) {
        let m = self.h.ncols();
        let v = self.spanned(m, &schur.q, kept);
        let last = self.v.column(m).clone_owned();
        self.v.columns_mut(0, kept).copy_from(&v);
        self.v.set_column(kept, &last);
        self.h.fill(C::ZERO);
        self.h.view_mut((0, 0), (kept, kept)).copy_from(&schur.t.view((0, 0), (kept, kept)));
        self.below = (0..kept).map(|j| schur.q[(m - 1, j)] * self.rest).collect();
        self.size = kept;
    }

    /// Keeps the leading `kept` Schur vectors, which have converged, and continues from a new direction.
    pub fn renew(&mut self, schur: &Ordered, kept: usize) -> Result<(), Unsolved> {
        self.contract(schur, kept);
        self.below.clear();
        self.start(kept)
    }

    /// The values with as many leading Schur vectors, and their part of T.
    pub fn finish(self, values: Vec<C>) -> Result<Partial, Unsolved> {
        let (Ordered { q, t }, count) = (Ordered::of(&self.h)?, values.len());
        let vectors = self.spanned(self.h.ncols(), &q, count);
        let schur = [vectors, t.view((0, 0), (count, count)).clone_owned()];
        Ok(Partial { values, schur })
    }
}
