//! Sparsity patterns, and products of matrices with vectors.

use nalgebra::DMatrix;

/// The places of the entries of a `rows` x `cols` matrix. Its values are a slice in the order of `entries`; values at
/// the same place add. Every entry must lie inside the matrix.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Pattern {
    /// Number of rows.
    pub rows: usize,
    /// Number of columns.
    pub cols: usize,
    /// (row, column) of each entry, in the order of the values.
    pub entries: Vec<(usize, usize)>,
}

/// A block of G in the rows of a point that all translations of its body move, and that turns about the body's origin:
/// [s I | a], with s = 1 or -1 and its entries row by row.
#[derive(Clone, Copy, Debug)]
pub struct Lever {
    /// Index of its first entry in G.
    pub first_entry: usize,
    /// The sign s.
    pub sign: f64,
}

impl Pattern {
    /// All places, row after row.
    pub fn dense(rows: usize, cols: usize) -> Self {
        Pattern { rows, cols, entries: (0..rows).flat_map(|i| (0..cols).map(move |j| (i, j))).collect() }
    }

    /// The full lower triangle of an n x n matrix, row after row: (0,0), (1,0), (1,1), (2,0) ...
    pub fn lower(n: usize) -> Self {
        Pattern { rows: n, cols: n, entries: (0..n).flat_map(|i| (0..=i).map(move |j| (i, j))).collect() }
    }

    /// The diagonal of an n x n matrix.
    pub fn diagonal(n: usize) -> Self {
        Pattern { rows: n, cols: n, entries: (0..n).map(|i| (i, i)).collect() }
    }

    /// The matrix with these values.
    pub fn matrix(&self, values: &[f64]) -> DMatrix<f64> {
        let mut matrix = DMatrix::zeros(self.rows, self.cols);
        self.entries.iter().zip(values).for_each(|(&place, value)| matrix[place] += value);
        matrix
    }

    /// y += A x. `x` has `cols` entries, `y` has `rows`.
    pub fn multiply(&self, values: &[f64], x: &[f64], y: &mut [f64]) {
        for (&(i, j), value) in self.entries.iter().zip(values) {
            y[i] += value * x[j];
        }
    }

    /// y += A^T x. `x` has `rows` entries, `y` has `cols`.
    pub fn multiply_transposed(&self, values: &[f64], x: &[f64], y: &mut [f64]) {
        for (&(i, j), value) in self.entries.iter().zip(values) {
            y[j] += value * x[i];
        }
    }

    /// y += A x for a symmetric A given by one triangle.
    pub fn multiply_symmetric(&self, values: &[f64], x: &[f64], y: &mut [f64]) {
        for (&(i, j), value) in self.entries.iter().zip(values) {
            y[i] += value * x[j];
            if i != j {
                y[j] += value * x[i];
            }
        }
    }

    /// y -= A x.
    pub(super) fn subtract(&self, values: &[f64], x: &[f64], y: &mut [f64]) {
        for (&(i, j), value) in self.entries.iter().zip(values) {
            y[i] -= value * x[j];
        }
    }

    /// y -= A^T x.
    pub(super) fn subtract_transposed(&self, values: &[f64], x: &[f64], y: &mut [f64]) {
        for (&(i, j), value) in self.entries.iter().zip(values) {
            y[j] -= value * x[i];
        }
    }

    /// y -= A x for a symmetric A given by one triangle.
    pub(super) fn subtract_symmetric(&self, values: &[f64], x: &[f64], y: &mut [f64]) {
        for (&(i, j), value) in self.entries.iter().zip(values) {
            y[i] -= value * x[j];
            if i != j {
                y[j] -= value * x[i];
            }
        }
    }

    /// Adds the diagonal of the matrix to `diagonal`.
    pub(crate) fn add_diagonal(&self, values: &[f64], diagonal: &mut [f64]) {
        for (&(i, j), value) in self.entries.iter().zip(values) {
            if i == j {
                diagonal[i] += value;
            }
        }
    }

    pub(super) fn is_inside(&self) -> bool {
        self.entries.iter().all(|&(i, j)| i < self.rows && j < self.cols)
    }
}
