//! The inner products of null vectors, which conjugate gradients over them are preconditioned by.

use super::reflect::Squared;
use super::system::dot;

/// Of more null vectors no products are formed: there the gradients take their steps without.
const MOST: usize = 500;
/// A projection of more steps is slow: forming the products anew would pay.
const SLOW: usize = 12;

/// N^T N = L L^T at some factorization: close to that of later ones until the state has moved far.
pub(super) struct Gram {
    /// The left-out rows whose null vectors these are.
    rows: Vec<usize>,
    /// N, one column after the other.
    columns: Vec<f64>,
    factor: Squared,
    scratch: Vec<f64>,
    is_formed: bool,
}

impl Gram {
    pub fn new() -> Self {
        let (rows, columns, scratch) = (Vec::new(), Vec::new(), Vec::new());
        Gram { rows, columns, factor: Squared::new(0), scratch, is_formed: false }
    }

    /// Whether products must be formed before [`solve`](Self::solve): of other rows, or since they no longer help.
    pub fn is_stale(&self, rows: &[usize]) -> bool {
        rows.len() <= MOST && !(self.is_formed && self.rows == rows)
    }

    /// Starts anew, for null vectors that [`push`](Self::push) gives in the order of `rows`.
    pub fn clear(&mut self, rows: &[usize]) {
        self.rows.clear();
        self.rows.extend_from_slice(rows);
        self.columns.clear();
    }

    pub fn push(&mut self, null: &[f64]) {
        self.columns.extend_from_slice(null);
    }

    pub fn factor(&mut self) {
        let (size, length) = (self.rows.len(), self.columns.len() / self.rows.len().max(1));
        if self.factor.size != size {
            self.factor = Squared::new(size);
            self.factor.size = size;
            self.scratch.resize(size, 0.0);
        }
        let column = |k: usize| &self.columns[k * length..(k + 1) * length];
        for j in 0..size {
            for i in j..size {
                self.factor.values[j * size + i] = dot(column(i), column(j));
            }
        }
        self.is_formed = self.factor.factor(0.0, &mut self.scratch).is_ok();
    }

    /// (N^T N)^-1 x of the numbers of `x` on `rows`, in place; unchanged where there are no products.
    pub fn solve(&mut self, rows: &[usize], x: &mut [f64]) {
        if self.is_formed && self.rows == rows {
            self.scratch.iter_mut().zip(rows).for_each(|(part, row)| *part = x[*row]);
            self.factor.solve(&mut self.scratch);
            self.scratch.iter().zip(rows).for_each(|(part, row)| x[*row] = *part);
        }
    }

    /// Tells of a projection that took so many steps.
    pub fn took(&mut self, steps: usize) {
        self.is_formed &= steps <= SLOW;
    }
}
