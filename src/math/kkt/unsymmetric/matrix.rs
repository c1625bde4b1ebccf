//! The unsymmetric matrix before it is factored.

use super::super::Pattern;
use super::Field;
use faer::sparse::{Pair, SymbolicSparseColMat};

/// Values at frozen places, column by column.
pub(super) struct SparseMatrix<T> {
    pub places: SymbolicSparseColMat<usize>,
    pub values: Vec<T>,
    is_full: bool,
}

/// Entries of A, G, G^T, and the diagonal of the multipliers, where dropped rows of G get a one. `None` if there is not
/// enough memory.
pub(super) fn places(mass: &Pattern, tangent: &Pattern, g: &Pattern) -> Option<SymbolicSparseColMat<usize>> {
    let n = g.cols;
    let size = g.cols + g.rows;
    let both = |(row, col): (usize, usize)| [Pair { row, col }, Pair { row: col, col: row }];
    let mut pairs: Vec<_> = tangent.entries.iter().map(|&(row, col)| Pair { row, col }).collect();
    pairs.extend(mass.entries.iter().flat_map(|&entry| both(entry)));
    pairs.extend(g.entries.iter().flat_map(|&(i, j)| both((n + i, j))));
    pairs.extend((n..size).map(|k| Pair { row: k, col: k }));
    Some(SymbolicSparseColMat::try_new_from_indices(size, size, &pairs).ok()?.0)
}

/// The pattern of a full matrix.
fn full(size: usize) -> Option<SymbolicSparseColMat<usize>> {
    let pairs: Vec<_> = (0..size).flat_map(|col| (0..size).map(move |row| Pair { row, col })).collect();
    Some(SymbolicSparseColMat::try_new_from_indices(size, size, &pairs).ok()?.0)
}

impl<T: Field> SparseMatrix<T> {
    /// A zero matrix; `None` if there is not enough memory.
    pub fn new(places: SymbolicSparseColMat<usize>, is_full: bool) -> Option<Self> {
        let places = if is_full { full(places.nrows())? } else { places };
        Some(SparseMatrix { values: vec![T::ZERO; places.compute_nnz()], places, is_full })
    }

    pub fn size(&self) -> usize {
        self.places.nrows()
    }

    /// Index of an entry among the values.
    pub fn place(&self, row: usize, col: usize) -> Option<usize> {
        let size = self.size();
        if self.is_full {
            return (row < size && col < size).then_some(col * size + row);
        }
        let start = *self.places.col_ptr().get(col)?;
        let rows = self.places.row_idx_of_col_raw(col);
        rows.binary_search(&row).ok().map(|k| start + k)
    }

    /// Column, rows of its entries (ascending) and their values, in the order of the places.
    pub fn columns(&self) -> impl Iterator<Item = (usize, &[usize], &[T])> {
        let values = self.places.col_ptr().windows(2).map(|ends| &self.values[ends[0]..ends[1]]);
        values.enumerate().map(|(col, values)| (col, self.places.row_idx_of_col_raw(col), values))
    }

    /// (row, column) of all entries.
    pub fn entries(&self) -> impl Iterator<Item = (usize, usize)> {
        self.columns().flat_map(|(col, rows, _)| rows.iter().map(move |&row| (row, col)))
    }
}
