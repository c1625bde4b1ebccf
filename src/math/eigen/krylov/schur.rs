//! The Schur form of a small matrix, largest eigenvalues first.

use super::super::{Unsolved, dense};
use super::{Ritz, Scalar};
use crate::tolerances;
use nalgebra::DMatrix;
use nalgebra::linalg::Schur;

/// H = Q T Q^H with upper triangular T; of a real H T has a block of two rows for each conjugate pair.
pub struct Ordered<T> {
    pub q: DMatrix<T>,
    pub t: DMatrix<T>,
}

impl<T: Scalar> Ordered<T> {
    pub fn of(h: &DMatrix<T>, ritz: &Ritz) -> Result<Self, Unsolved> {
        if let Some(ordered) = Self::by_vectors(h, ritz) {
            return Ok(ordered);
        }
        let m = h.nrows();
        // Two or three an eigenvalue are usual; LAPACK allows thirty.
        let schur = Schur::try_new(h.clone(), f64::EPSILON, 60 * m.max(1));
        let (q, t) = schur.ok_or(Unsolved::NotConverged { converged: 0, wanted: m })?.unpack();
        let mut ordered = Ordered { q, t };
        ordered.sort();
        Ok(ordered)
    }

    /// The Schur form from eigenvectors, made orthonormal in the order of their values, in a sixth of the time; `None`
    /// if they are too dependent for that.
    fn by_vectors(h: &DMatrix<T>, ritz: &Ritz) -> Option<Self> {
        let m = h.nrows();
        let (columns, sizes) = T::columns(ritz);
        let q = dense::copy(dense::view(&DMatrix::from_columns(&columns)).qr().compute_thin_Q().as_ref());
        let mut t =
            dense::product(dense::view(&q).adjoint(), dense::view(&dense::product(dense::view(h), dense::view(&q))));
        let mut start = 0;
        let mut below = 0.0f64;
        for size in sizes {
            let mut under = t.view_mut((start + size, start), (m - start - size, size));
            below = below.max(under.norm());
            under.fill(T::ZERO);
            start += size;
        }
        (below <= tolerances::ROUND_OFF_OF_FACTORS * t.norm()).then_some(Ordered { q, t })
    }

    /// Returns the number of leading columns that span an invariant space: `count`, or one more where that parts a pair.
    pub fn whole(&self, count: usize) -> usize {
        let is_parted = count > 0 && count < self.t.nrows() && self.t[(count, count - 1)] != T::ZERO;
        if is_parted { count + 1 } else { count }
    }

    /// Sorts the blocks by descending magnitude of their eigenvalues, by insertion.
    fn sort(&mut self) {
        let mut sizes = Vec::new();
        let mut start = 0;
        while start < self.t.nrows() {
            sizes.push(self.whole(start + 1) - start);
            start += sizes[sizes.len() - 1];
        }
        for end in 1..sizes.len() {
            let mut k = end;
            let mut start: usize = sizes[..end].iter().sum();
            while k > 0 {
                let before = start - sizes[k - 1];
                let is_sorted = self.radius(start, sizes[k]) <= self.radius(before, sizes[k - 1]);
                if is_sorted || !self.swap(before, sizes[k - 1], sizes[k]) {
                    break;
                }
                sizes.swap(k - 1, k);
                (k, start) = (k - 1, before);
            }
        }
    }

    /// Magnitude of the eigenvalues of a block.
    fn radius(&self, start: usize, size: usize) -> f64 {
        self.t.view((start, start), (size, size)).determinant().modulus().powf(1.0 / size as f64)
    }

    /// Exchanges neighbouring blocks A and B; false where they have a common eigenvalue. With A X - X B = C, their
    /// coupling, the vectors of B are [-X; 1] (Bai, Demmel, "On swapping diagonal blocks in real Schur form", Linear
    /// Algebra Appl. 186 (1993) 73-95).
    fn swap(&mut self, start: usize, p: usize, q: usize) -> bool {
        let both = p + q;
        let block = self.t.view((start, start), (both, both)).clone_owned();
        let a = block.view((0, 0), (p, p)).clone_owned();
        let b = block.view((p, p), (q, q)).clone_owned();
        let coupling = DMatrix::from_column_slice(p * q, 1, block.view((0, p), (p, q)).clone_owned().as_slice());
        let eye = |n| DMatrix::<T>::identity(n, n);
        let sylvester = eye(q).kronecker(&a) - b.transpose().kronecker(&eye(p));
        let Some(x) = sylvester.lu().solve(&coupling) else { return false };
        let vectors = DMatrix::from_fn(both, both, |i, j| match (i < p, j < q) {
            (true, true) => -x[i + p * j],
            (true, false) if i + q == j => T::from_real(1.0),
            (false, true) if i == j + p => T::from_real(1.0),
            _ => T::ZERO,
        });
        let rotation = vectors.qr().q();
        let rows = self.t.rows(start, both).clone_owned();
        self.t.rows_mut(start, both).copy_from(&(rotation.adjoint() * rows));
        for matrix in [&mut self.t, &mut self.q] {
            let columns = matrix.columns(start, both) * &rotation;
            matrix.columns_mut(start, both).copy_from(&columns);
        }
        self.t.view_mut((start + q, start), (p, q)).fill(T::ZERO);
        true
    }
}
