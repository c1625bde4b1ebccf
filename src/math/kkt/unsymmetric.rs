//! The saddle-point system of implicit methods, whose upper block is not symmetric; dense.

use super::{Pattern, Singular};
use faer::dyn_stack::{MemBuffer, MemStack, StackReq};
use faer::linalg::lu::partial_pivoting::{factor, solve};
use faer::{MatMut, MatRef, Par, Spec};

/// Factors and solves
///
/// ```text
/// [ A  G^T ] [ a      ]   [ r1 ]
/// [ G  0   ] [ lambda ] = [ r2 ]
/// ```
///
/// with A a sum of matrices on patterns of their own, by LU with partial pivoting (faer). Rows of G are scaled to the
/// size of A, so that the pivots are chosen between like and like. 2/3 (n + m)^3 operations.
pub struct Unsymmetric {
    n: usize,
    size: usize,
    /// Column by column.
    values: Vec<f64>,
    /// Factor on the rows and columns of G.
    scale: f64,
    row_order: Vec<usize>,
    row_places: Vec<usize>,
    right: Vec<f64>,
    memory: MemBuffer,
    is_factored: bool,
}

/// A pivot below this part of the largest means dependent rows.
const DEPENDENT: f64 = 1e-14;

impl Unsymmetric {
    /// For n coordinates and m constraints; none where there is not enough memory.
    pub fn new(n: usize, m: usize) -> Option<Self> {
        let size = n + m;
        let memory = StackReq::any_of(&[
            factor::lu_in_place_scratch::<usize, f64>(size, size, Par::Seq, Spec::default()),
            solve::solve_in_place_scratch::<usize, f64>(size, 1, Par::Seq),
        ]);
        Some(Unsymmetric {
            n,
            size,
            values: vec![0.0; size * size],
            scale: 1.0,
            row_order: vec![0; size],
            row_places: vec![0; size],
            right: vec![0.0; size],
            memory: MemBuffer::try_new(memory).ok()?,
            is_factored: false,
        })
    }

    /// Starts a new matrix.
    pub fn clear(&mut self) {
        self.values.fill(0.0);
        self.is_factored = false;
    }

    /// A += factor B, with both triangles of a symmetric B given by one.
    pub fn add(&mut self, pattern: &Pattern, values: &[f64], factor: f64, is_symmetric: bool) {
        for (&(i, j), value) in pattern.entries.iter().zip(values) {
            self.values[j * self.size + i] += factor * value;
            if is_symmetric && i != j {
                self.values[i * self.size + j] += factor * value;
            }
        }
    }

    /// Puts G in and factors.
    ///
    /// # Errors
    /// Values that are not finite, and dependent rows of G.
    pub fn factor(&mut self, g: &Pattern, values: &[f64]) -> Result<(), Singular> {
        let largest = |x: &[f64]| x.iter().fold(0.0, |largest: f64, x| largest.max(x.abs()));
        let (a, rows) = (largest(&self.values), largest(values));
        self.scale = if a > 0.0 && rows > 0.0 { a / rows } else { 1.0 };
        for (&(i, j), value) in g.entries.iter().zip(values) {
            self.values[j * self.size + self.n + i] += self.scale * value;
            self.values[(self.n + i) * self.size + j] += self.scale * value;
        }
        if self.values.iter().any(|x| !x.is_finite()) {
            return Err(Singular::NotFinite);
        }
        let matrix = MatMut::from_column_major_slice_mut(&mut self.values, self.size, self.size);
        let stack = MemStack::new(&mut self.memory);
        factor::lu_in_place(matrix, &mut self.row_order, &mut self.row_places, Par::Seq, stack, Spec::default());
        let pivot = |i: usize| self.values[i * self.size + i].abs();
        let largest = (0..self.size).map(pivot).fold(0.0, f64::max);
        self.is_factored = (0..self.size).all(|i| pivot(i) > DEPENDENT * largest);
        if self.is_factored { Ok(()) } else { Err(Singular::NotFactored) }
    }

    /// Solves in place.
    pub fn solve(&mut self, top: &mut [f64], bottom: &mut [f64]) -> Result<(), Singular> {
        if !self.is_factored || top.len() != self.n || top.len() + bottom.len() != self.size {
            return Err(Singular::NotFactored);
        }
        let (first, second) = self.right.split_at_mut(self.n);
        first.copy_from_slice(top);
        second.iter_mut().zip(&*bottom).for_each(|(place, row)| *place = self.scale * row);
        let factors = MatRef::from_column_major_slice(&self.values, self.size, self.size);
        let order = faer::perm::PermRef::new_checked(&self.row_order, &self.row_places, self.size);
        let right = MatMut::from_column_major_slice_mut(&mut self.right, self.size, 1);
        let stack = MemStack::new(&mut self.memory);
        solve::solve_in_place(factors, factors, order, right, Par::Seq, stack);
        top.copy_from_slice(&self.right[..self.n]);
        bottom.iter_mut().zip(&self.right[self.n..]).for_each(|(row, place)| *row = self.scale * place);
        match self.right.iter().all(|x| x.is_finite()) {
            true => Ok(()),
            false => Err(Singular::NotFinite),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn solves_what_it_multiplied() {
        let (n, m) = (4, 2);
        let a: Vec<f64> = (0..16).map(|k| (1.0 + 3.7 * k as f64).sin() + if k % 5 == 0 { 4.0 } else { 0.0 }).collect();
        let g: Vec<f64> = (0..8).map(|k| 1e3 * (2.0 + 1.3 * k as f64).cos()).collect();
        let (dense, rows) = (Pattern::dense(n, n), Pattern::dense(m, n));
        let (x, lambda) = ([1.0, -2.0, 3.0, 0.5], [2.0, -1.0]);
        let (mut top, mut bottom) = ([0.0; 4], [0.0; 2]);
        dense.multiply(&a, &x, &mut top);
        rows.multiply_transposed(&g, &lambda, &mut top);
        rows.multiply(&g, &x, &mut bottom);
        let mut system = Unsymmetric::new(n, m).unwrap();
        system.clear();
        system.add(&dense, &a, 1.0, false);
        system.factor(&rows, &g).unwrap();
        system.solve(&mut top, &mut bottom).unwrap();
        let close = |found: &[f64], exact: &[f64]| found.iter().zip(exact).all(|(f, e)| (f - e).abs() < 1e-12);
        assert!(close(&top, &x) && close(&bottom, &lambda), "{top:?} {bottom:?}");
        // A row that repeats another one has no pivot.
        let twice: Vec<f64> = [&g[..4], &g[..4]].concat();
        system.clear();
        system.add(&dense, &a, 1.0, false);
        assert!(system.factor(&rows, &twice).is_err());
        assert!(system.solve(&mut top, &mut bottom).is_err());
    }
}
