//! The saddle-point system by a pseudo-inverse, dense.

use super::pivoted::PivotedCholesky;
use super::system::{add_scaled, dot, index_of_largest};
use super::{Pattern, Singular, Solver};
use crate::tolerances::math as tolerances;
use faer::diag::DiagMut;
use faer::dyn_stack::{MemBuffer, MemStack};
use faer::linalg::svd::{ComputeSvdVectors, svd, svd_scratch};
use faer::{MatMut, MatRef, Par, Spec};

/// Solution by the pseudo-inverse, with M = R^-T R^-1 (Cholesky), A = G R and its singular values A = W S U^T above the
/// tolerance:
///
/// ```text
/// a = R (p + A^+ b),   p = R^T r1,   b = r2 - A p,   A^+ = U S^-1 W^T,   lambda = -(A A^T)^+ b
/// ```
///
/// Any R gives the same a as M^-1/2, since they differ by a rotation. Contradicting rows are solved by least squares,
/// lambda has the least norm. Costs about n^3/3 + 12 n m^2. Nothing allocates after the first use, in which faer
/// queries the sizes of the caches.
pub struct PseudoInverse {
    /// Singular values up to this fraction of the largest, and up to 1e-4 of the reference value, count as zero.
    pub tolerance: f64,
    mass: Pattern,
    g: Pattern,
    root: PivotedCholesky,
    scale: Vec<f64>,
    /// A by rows, then U and W by columns.
    a: Vec<f64>,
    u: Vec<f64>,
    w: Vec<f64>,
    s: Vec<f64>,
    rank: usize,
    dropped: Vec<usize>,
    is_factored: bool,
    x: Vec<f64>,
    y: Vec<f64>,
    memory: MemBuffer,
}

impl PseudoInverse {
    /// `None` if the sizes of the patterns do not agree or there is not enough memory.
    pub fn new(mass: &Pattern, g: &Pattern, tolerance: f64) -> Option<Self> {
        let (n, m) = (mass.rows, g.rows);
        if mass.cols != n || g.cols != n || !mass.is_inside() || !g.is_inside() {
            return None;
        }
        let (size, thin) = (n.min(m), ComputeSvdVectors::Thin);
        Some(PseudoInverse {
            tolerance,
            mass: mass.clone(),
            g: g.clone(),
            root: PivotedCholesky::new(n),
            scale: vec![1.0; n],
            a: vec![0.0; n * m],
            u: vec![0.0; n * size],
            w: vec![0.0; m * size],
            s: vec![0.0; size],
            rank: 0,
            dropped: Vec::with_capacity(m),
            is_factored: false,
            x: vec![0.0; n],
            y: vec![0.0; m],
            memory: MemBuffer::try_new(svd_scratch::<f64>(n, m, thin, thin, Par::Seq, Spec::default())).ok()?,
        })
    }

    /// D M D = P L L^T P^T with D that makes the masses one, so that R = D P L^-T.
    fn factor_mass(&mut self, mass: &[f64]) -> Result<(), Singular> {
        let n = self.scale.len();
        self.scale.fill(0.0);
        self.mass.add_diagonal(mass, &mut self.scale);
        if let Some(coordinate) = self.scale.iter().position(|m| *m <= 0.0) {
            return Err(Singular::Massless { coordinate });
        }
        self.scale.iter_mut().for_each(|m| *m = m.sqrt().recip());
        self.root.size = n;
        self.root.values.fill(0.0);
        for (&(i, j), value) in self.mass.entries.iter().zip(mass) {
            self.root.values[i.min(j) * n + i.max(j)] += value * self.scale[i] * self.scale[j];
        }
        match self.root.factor(tolerances::MASSLESS, &mut self.x) {
            Ok(()) => Ok(()),
            Err(()) => Err(Singular::Massless { coordinate: index_of_largest(&self.x) }),
        }
    }

    fn decompose(&mut self, reference: f64) -> Result<(), Singular> {
        let (n, m, size) = (self.scale.len(), self.g.rows, self.s.len());
        let result = svd(
            MatRef::from_column_major_slice(&self.a, n, m),
            DiagMut::from_slice_mut(&mut self.s),
            Some(MatMut::from_column_major_slice_mut(&mut self.u, n, size)),
            Some(MatMut::from_column_major_slice_mut(&mut self.w, m, size)),
            Par::Seq,
            MemStack::new(&mut self.memory),
            Spec::default(),
        );
        let largest = self.s.first().copied().unwrap_or(0.0);
        let limit = largest * self.tolerance.max(tolerances::TRUNCATED_RANK * reference);
        self.rank = self.s.iter().take_while(|s| **s > limit).count();
        result.map_err(|_| Singular::NotFinite)
    }
}

impl Solver for PseudoInverse {
    fn factor(&mut self, mass: &[f64], g: &[f64], reference: f64) -> Result<(), Singular> {
        self.is_factored = false;
        if mass.len() != self.mass.entries.len() || g.len() != self.g.entries.len() {
            return Err(Singular::Shape);
        }
        if !mass.iter().chain(g).all(|v| v.is_finite()) {
            return Err(Singular::NotFinite);
        }
        self.factor_mass(mass)?;
        let n = self.scale.len();
        self.a.fill(0.0);
        self.g.entries.iter().zip(g).for_each(|(&(j, i), value)| self.a[j * n + i] += value * self.scale[i]);
        for &row in &self.dropped {
            self.a[row * n..(row + 1) * n].fill(0.0);
        }
        for row in self.a.chunks_exact_mut(n.max(1)) {
            self.root.forward(row);
        }
        self.decompose(reference)?;
        self.is_factored = true;
        Ok(())
    }

    fn solve(&mut self, top: &mut [f64], bottom: &mut [f64]) -> Result<(), Singular> {
        let (n, m) = (self.scale.len(), self.g.rows);
        if top.len() != n || bottom.len() != m {
            return Err(Singular::Shape);
        }
        if !self.is_factored {
            return Err(Singular::NotFactored);
        }
        top.iter_mut().zip(&self.scale).for_each(|(x, s)| *x *= s);
        self.root.forward(top);
        for (b, row) in bottom.iter_mut().zip(self.a.chunks_exact(n.max(1))) {
            *b -= dot(row, top);
        }
        self.y.fill(0.0);
        let columns = self.u.chunks_exact(n.max(1)).zip(self.w.chunks_exact(m.max(1)));
        for ((u, w), s) in columns.zip(&self.s[..self.rank]) {
            let part = dot(w, bottom) / s;
            add_scaled(part, u, top);
            add_scaled(-part / s, w, &mut self.y);
        }
        bottom.copy_from_slice(&self.y);
        self.root.backward(top);
        top.iter_mut().zip(&self.scale).for_each(|(x, s)| *x *= s);
        Ok(())
    }

    fn drop_rows(&mut self, rows: &[usize]) {
        self.dropped.clear();
        self.dropped.extend(rows.iter().filter(|row| **row < self.g.rows));
    }

    /// The smallest nonzero singular value over the largest.
    fn rank_indicator(&self) -> f64 {
        self.s[..self.rank].last().map_or(0.0, |smallest| smallest / self.s[0])
    }

    fn is_rank_deficient(&self) -> bool {
        let limit = self.tolerance * self.s.first().copied().unwrap_or(0.0);
        self.s.iter().take_while(|s| **s > limit).count() < self.g.rows
    }
}
