//! LU without pivoting on a frozen pattern, of the first unknowns of a matrix or of all.

use super::Field;
use crate::math::kkt::order::columns;
use std::ops::Range;

/// A diagonal pivot of the matrix of an implicit method up to which partial pivoting takes its place. Unit: `[1]` of
/// the largest number that it is the difference of. Why: ten digits of a correction are left, and rows that could be
/// dependent, whose pivots are round-off, stay the matter of partial pivoting. Test:
/// `a_small_pivot_leads_to_partial_pivoting`.
const UNPIVOTED: f64 = 1e-6;

/// A matrix A with a symmetric pattern, whose first unknowns are eliminated column by column. L has the pattern of U^T,
/// found once. What that leaves of the others, A_22 - L_21 U_12, is in the place of A_22.
pub(super) struct Columns<T> {
    /// Number of unknowns that are eliminated.
    own: usize,
    /// Columns of L below the diagonal, which are the rows of U.
    starts: Vec<u32>,
    rows: Vec<u32>,
    /// For each unknown the entries of L in its row, of columns that are eliminated: column and index.
    row_starts: Vec<u32>,
    row_entries: Vec<(u32, u32)>,
    /// Entries (L, U), and the diagonal, of unknowns that are eliminated the inverse pivots.
    entries: Vec<[T; 2]>,
    diagonal: Vec<T>,
    /// The largest of the numbers whose sum is on the diagonal.
    largest: Vec<f64>,
    /// A column of L and a row of U on the way; and a right side, then the solution.
    work: Vec<[T; 2]>,
    pub x: Vec<T>,
}

impl<T: Field> Columns<T> {
    /// For a matrix with these pairs of unknowns coupled, of which the first `own` are eliminated; `None` if its factors
    /// are too long.
    pub fn new(size: usize, own: usize, pairs: impl Iterator<Item = (usize, usize)>) -> Option<Self> {
        let mut adjacency: Vec<Vec<u32>> = vec![Vec::new(); size];
        pairs.filter(|(a, b)| a != b).for_each(|(a, b)| adjacency[a.min(b)].push(a.max(b) as u32));
        adjacency.iter_mut().for_each(|column| {
            column.sort_unstable();
            column.dedup();
        });
        let columns = columns(&adjacency, size);
        let mut starts = vec![0];
        let mut rows = Vec::with_capacity(columns.iter().map(Vec::len).sum());
        for column in &columns {
            rows.extend_from_slice(column);
            starts.push(rows.len() as u32);
        }
        u32::try_from(size + 2 * rows.len()).ok()?;
        let (row_starts, row_entries) = by_rows(&starts[..=own], &rows, size);
        Some(Columns {
            own,
            entries: vec![[T::ZERO; 2]; rows.len()],
            diagonal: vec![T::ZERO; size],
            largest: vec![0.0; size],
            work: vec![[T::ZERO; 2]; size],
            x: vec![T::ZERO; size],
            starts,
            rows,
            row_starts,
            row_entries,
        })
    }

    fn column(&self, j: usize) -> Range<usize> {
        self.starts[j] as usize..self.starts[j + 1] as usize
    }

    /// Place of the entry in a row and column: p < size is the diagonal; size + 2 k is entry k of L, size + 2 k + 1 of
    /// U.
    pub fn slot(&self, row: usize, col: usize) -> u32 {
        let column = self.column(row.min(col));
        let entry = column.start + self.rows[column].partition_point(|&other| (other as usize) < row.max(col));
        if row == col { row as u32 } else { (self.diagonal.len() + 2 * entry + usize::from(row < col)) as u32 }
    }

    /// Sets the matrix to these values at their slots.
    pub fn load(&mut self, values: impl Iterator<Item = (u32, T)>) {
        let size = self.diagonal.len();
        self.entries.fill([T::ZERO; 2]);
        self.diagonal.fill(T::ZERO);
        for (slot, value) in values {
            match (slot as usize).checked_sub(size) {
                Some(entry) => self.entries[entry / 2][entry % 2] += value,
                None => self.diagonal[slot as usize] += value,
            }
        }
        self.largest.iter_mut().zip(&self.diagonal).for_each(|(largest, x)| *largest = x.size());
    }

    /// Adds what elimination in `other` left of its last unknowns, which are all those of this matrix.
    pub fn add_left(&mut self, other: &Columns<T>) {
        let left = other.starts[other.own] as usize..;
        for (entry, [l, u]) in self.entries.iter_mut().zip(&other.entries[left]) {
            entry[0] += *l;
            entry[1] += *u;
        }
        self.diagonal.iter_mut().zip(&other.diagonal[other.own..]).for_each(|(sum, x)| *sum += *x);
        let largest = self.largest.iter_mut().zip(&other.largest[other.own..]);
        largest.for_each(|(largest, other)| *largest = largest.max(*other));
    }

    /// Eliminates; returns false where a pivot is small beside the numbers whose sum it is.
    pub fn factor(&mut self) -> bool {
        let is_stable = (0..self.own).all(|j| self.eliminate(j));
        (self.own..self.diagonal.len()).for_each(|j| self.reduce(j));
        is_stable
    }

    /// Computes column j of L, row j of U and their pivot.
    fn eliminate(&mut self, j: usize) -> bool {
        self.reduce(j);
        let pivot = self.diagonal[j];
        let own = self.column(j);
        let inverse = T::real(1.0) / pivot;
        self.diagonal[j] = inverse;
        self.entries[own].iter_mut().for_each(|[l, _]| *l *= inverse);
        // Written so that a NaN is refused.
        pivot.size() > UNPIVOTED * self.largest[j]
    }

    /// Subtracts from column j, row j and their diagonal what the elimination of the columns before takes away.
    fn reduce(&mut self, j: usize) {
        let own = self.column(j);
        let Columns { starts, rows, row_starts, row_entries, entries, diagonal, largest, work, .. } = self;
        for (row, entry) in rows[own.clone()].iter().zip(&entries[own.clone()]) {
            work[*row as usize] = *entry;
        }
        for &(column, entry) in &row_entries[row_starts[j] as usize..row_starts[j + 1] as usize] {
            let entry = entry as usize;
            let end = starts[column as usize + 1] as usize;
            let [left, above] = entries[entry];
            let product = left * above;
            diagonal[j] -= product;
            largest[j] = largest[j].max(product.size());
            for (row, [l, u]) in rows[entry + 1..end].iter().zip(&entries[entry + 1..end]) {
                let [of_l, of_u] = &mut work[*row as usize];
                *of_l -= *l * above;
                *of_u -= left * *u;
            }
        }
        for (row, entry) in rows[own.clone()].iter().zip(&mut entries[own]) {
            *entry = work[*row as usize];
        }
    }

    /// x := L^-1 x
    pub fn forward(&mut self) {
        let Columns { own, starts, rows, entries, x, .. } = self;
        for j in 0..*own {
            let column = starts[j] as usize..starts[j + 1] as usize;
            let value = x[j];
            let below = rows[column.clone()].iter().zip(&entries[column]);
            below.for_each(|(&row, [l, _])| x[row as usize] -= *l * value);
        }
    }

    /// x := U^-1 x, with the solution of the last unknowns in place.
    pub fn backward(&mut self) {
        let Columns { own, starts, rows, entries, diagonal, x, .. } = self;
        for j in (0..*own).rev() {
            let column = starts[j] as usize..starts[j + 1] as usize;
            let beside = rows[column.clone()].iter().zip(&entries[column]);
            x[j] = beside.fold(x[j], |rest, (&row, [_, u])| rest - *u * x[row as usize]) * diagonal[j];
        }
    }
}

/// The entries of the first columns of a lower triangle with `size` rows, row by row: column and index of each.
fn by_rows(starts: &[u32], rows: &[u32], size: usize) -> (Vec<u32>, Vec<(u32, u32)>) {
    let columns = starts.len() - 1;
    let first = &rows[..starts[columns] as usize];
    let mut row_starts = vec![0_u32; size + 1];
    first.iter().for_each(|&row| row_starts[row as usize + 1] += 1);
    (0..size).for_each(|row| row_starts[row + 1] += row_starts[row]);
    let mut next = row_starts.clone();
    let mut entries = vec![(0, 0); first.len()];
    for column in 0..columns {
        for entry in starts[column]..starts[column + 1] {
            let row = rows[entry as usize] as usize;
            entries[next[row] as usize] = (column as u32, entry);
            next[row] += 1;
        }
    }
    (row_starts, entries)
}
