//! The matrix before it is factored.

use super::super::Pattern;
use super::Field;
use faer::sparse::{Pair, SymbolicSparseColMat};

/// Values at frozen places, column by column.
pub(super) struct Matrix<T> {
    pub places: SymbolicSparseColMat<usize>,
    pub values: Vec<T>,
    is_full: bool,
}

impl<T: Field> Matrix<T> {
    /// Entries of A, G, G^T, and the diagonal behind A, where rows of G that are left out get a one. None where there is
    /// not enough memory.
    pub fn new(symmetric: &Pattern, tangent: &Pattern, g: &Pattern, is_full: bool) -> Option<Self> {
        let (n, size) = (g.cols, g.cols + g.rows);
        let both = |(row, col): (usize, usize)| [Pair { row, col }, Pair { row: col, col: row }];
        let mut pairs: Vec<Pair<usize, usize>> = match is_full {
            true => (0..size).flat_map(|col| (0..size).map(move |row| Pair { row, col })).collect(),
            false => tangent.entries.iter().map(|&(row, col)| Pair { row, col }).collect(),
        };
        if !is_full {
            pairs.extend(symmetric.entries.iter().flat_map(|&entry| both(entry)));
            pairs.extend(g.entries.iter().flat_map(|&(i, j)| both((n + i, j))));
            pairs.extend((n..size).map(|k| Pair { row: k, col: k }));
        }
        let (places, _) = SymbolicSparseColMat::try_new_from_indices(size, size, &pairs).ok()?;
        let values = vec![T::ZERO; places.compute_nnz()];
        Some(Matrix { places, values, is_full })
    }

    pub fn size(&self) -> usize {
        self.places.nrows()
    }

    /// Where an entry stands among the values.
    pub fn place(&self, row: usize, col: usize) -> Option<usize> {
        let size = self.size();
        if self.is_full {
            return (row < size && col < size).then_some(col * size + row);
        }
        let start = *self.places.col_ptr().get(col)?;
        let rows = self.places.row_idx_of_col_raw(col);
        rows.binary_search(&row).ok().map(|k| start + k)
    }

    /// (row, column, place) of all entries.
    pub fn entries(&self) -> impl Iterator<Item = (usize, usize, usize)> {
        let starts = self.places.col_ptr();
        (0..self.size()).flat_map(move |col| {
            let rows = self.places.row_idx_of_col_raw(col).iter();
            rows.zip(starts[col]..).map(move |(&row, place)| (row, col, place))
        })
    }
}
