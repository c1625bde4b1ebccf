//! The Schur form of a small complex matrix, largest eigenvalues first.

use super::super::{Complex, ComplexMatrix, Unsolved, dense};
use super::Ritz;
use crate::tolerances::math as tolerances;
use nalgebra::Vector2;
use nalgebra::linalg::{Schur, givens::GivensRotation};

/// H = Q T Q^H with upper triangular T.
pub struct Ordered {
    pub q: ComplexMatrix,
    pub t: ComplexMatrix,
}

impl Ordered {
    pub fn of(h: &ComplexMatrix) -> Result<Ordered, Unsolved> {
        if let Some(ordered) = Self::by_vectors(h)? {
            return Ok(ordered);
        }
        let m = h.nrows();
        let schur = Schur::try_new(h.clone(), f64::EPSILON, tolerances::QR_STEPS * m.max(1));
        let (q, t) = schur.ok_or(Unsolved::NotConverged { converged: 0, wanted: m })?.unpack();
        let mut ordered = Ordered { q, t };
        ordered.sort();
        Ok(ordered)
    }

    /// The Schur form from eigenvectors, made orthonormal in the order of their values, in a sixth of the time; `None`
    /// if they are too dependent for that.
    fn by_vectors(h: &ComplexMatrix) -> Result<Option<Ordered>, Unsolved> {
        let m = h.nrows();
        let vectors = Ritz::of(h, 0.0, m)?.vectors;
        let q = dense::copy(dense::view(&vectors).qr().compute_thin_Q().as_ref());
        let t =
            dense::product(dense::view(&q).adjoint(), dense::view(&dense::product(dense::view(h), dense::view(&q))));
        let below = t.column_iter().enumerate().map(|(j, column)| column.rows(j + 1, m - j - 1).norm());
        let is_triangular = below.fold(0.0, f64::max) <= tolerances::ROUND_OFF_OF_FACTORS * t.norm();
        Ok(is_triangular.then(|| Ordered { q, t: t.upper_triangle() }))
    }

    /// Sorts the eigenvalues by descending magnitude, by insertion.
    fn sort(&mut self) {
        for end in 1..self.t.nrows() {
            let mut k = end;
            while k > 0 && self.t[(k, k)].norm() > self.t[(k - 1, k - 1)].norm() {
                self.swap(k - 1);
                k -= 1;
            }
        }
    }

    /// Exchanges the eigenvalues k and k + 1 by a rotation that takes the second's vector to the first place.
    fn swap(&mut self, k: usize) {
        let (first, second) = (self.t[(k, k)], self.t[(k + 1, k + 1)]);
        let vector = Vector2::new(self.t[(k, k + 1)], second - first);
        let Some((rotation, _)) = GivensRotation::cancel_y(&vector) else { return };
        let behind = self.t.ncols() - k - 2;
        rotation.rotate(&mut self.t.view_mut((k, k + 2), (2, behind)));
        let back = rotation.inverse();
        // The two eigenvalues are set below; the entry between them is that after both rotations.
        rotation.rotate(&mut self.t.view_mut((k, k), (2, 2)));
        back.rotate_rows(&mut self.t.view_mut((0, k), (k + 2, 2)));
        back.rotate_rows(&mut self.q.columns_mut(k, 2));
        self.t[(k + 1, k)] = Complex::ZERO;
        (self.t[(k, k)], self.t[(k + 1, k + 1)]) = (second, first);
    }
}
