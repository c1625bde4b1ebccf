//! LU without pivoting on a frozen pattern.

use super::super::order::{columns, ordered};
use super::Field;
use crate::tolerances::math as tolerances;
use faer::sparse::SymbolicSparseColMat;

/// L U with pivots on the diagonal, in an order that has each multiplier behind all its coordinates: with A symmetric
/// and positive definite on the null space of G no pivot vanishes then, unless its row of G depends on rows before it;
/// h^2 K and h C change that little. Where a pivot is small beside the numbers whose difference it is, the matrix is not
/// factored. L has the pattern of U^T, found once.
pub(super) struct Unpivoted<T> {
    /// Node (coordinate, or n + row of G) at each place of the order.
    order: Vec<u32>,
    /// Columns of L below the diagonal, which are the rows of U.
    starts: Vec<u32>,
    rows: Vec<u32>,
    /// For each place the entries of L in its row: column and index.
    row_starts: Vec<u32>,
    row_entries: Vec<(u32, u32)>,
    /// Place of each value of the matrix: p < size is the diagonal; size + 2 k is entry k of L, size + 2 k + 1 of U.
    slots: Vec<u32>,
    /// Entries (L, U), and the inverse pivots.
    entries: Vec<[T; 2]>,
    inverses: Vec<T>,
    /// A column of L and a row of U on the way; and a solution in the order.
    work: Vec<[T; 2]>,
    right: Vec<T>,
}

/// Approximate minimum degree, with multipliers (nodes from `n` on) moved behind their coordinates.
fn order(places: &SymbolicSparseColMat<usize>, n: usize) -> Vec<usize> {
    let size = places.nrows();
    let nodes: Vec<usize> = (0..size).collect();
    let edges = (0..size).flat_map(|col| places.row_idx_of_col_raw(col).iter().map(move |&row| (row, col)));
    let mut waiting: Vec<usize> = nodes.iter().map(|&k| coordinates(places, n, k).count()).collect();
    let mut reached = vec![false; size];
    let mut order = Vec::with_capacity(size);
    for node in ordered(&nodes, size, edges) {
        reached[node] = true;
        if node >= n {
            order.extend((waiting[node] == 0).then_some(node));
            continue;
        }
        order.push(node);
        for &row in places.row_idx_of_col_raw(node).iter().filter(|row| **row >= n) {
            waiting[row] -= 1;
            order.extend((waiting[row] == 0 && reached[row]).then_some(row));
        }
    }
    order
}

/// The coordinates that a multiplier acts on; none for a coordinate.
fn coordinates(places: &SymbolicSparseColMat<usize>, n: usize, node: usize) -> impl Iterator<Item = usize> {
    places.row_idx_of_col_raw(node).iter().copied().filter(move |&row| node >= n && row < n)
}

impl<T: Field> Unpivoted<T> {
    /// For a matrix with entries at these places, of which the first `n` rows and columns are coordinates; `None` if its
    /// factors are too long.
    pub fn new(places: &SymbolicSparseColMat<usize>, n: usize) -> Option<Self> {
        let (size, order) = (places.nrows(), order(places, n));
        let mut position = vec![0; size];
        order.iter().enumerate().for_each(|(place, &node)| position[node] = place);
        let pairs = || (0..size).flat_map(|col| places.row_idx_of_col_raw(col).iter().map(move |&row| (row, col)));
        let mut adjacency = vec![Vec::new(); size];
        for (a, b) in pairs().map(|(row, col)| (position[row], position[col])).filter(|(a, b)| a != b) {
            adjacency[a.min(b)].push(a.max(b) as u32);
        }
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
        let slot = |(row, col): (usize, usize)| {
            let (a, b) = (position[row], position[col]);
            let column = &columns[a.min(b)];
            let entry = starts[a.min(b)] as usize + column.partition_point(|&other| (other as usize) < a.max(b));
            if a == b { a as u32 } else { (size + 2 * entry + usize::from(a < b)) as u32 }
        };
        let slots = pairs().map(slot).collect();
        let (row_starts, row_entries) = by_rows(&starts, &rows);
        Some(Unpivoted {
            entries: vec![[T::ZERO; 2]; rows.len()],
            inverses: vec![T::ZERO; size],
            work: vec![[T::ZERO; 2]; size],
            right: vec![T::ZERO; size],
            order: order.into_iter().map(|node| node as u32).collect(),
            starts,
            rows,
            row_starts,
            row_entries,
            slots,
        })
    }

    fn column(&self, j: usize) -> std::ops::Range<usize> {
        self.starts[j] as usize..self.starts[j + 1] as usize
    }

    /// Factors the matrix with these values at its places; returns false where a pivot is too small.
    pub fn factor(&mut self, values: &[T]) -> bool {
        let size = self.order.len();
        self.entries.fill([T::ZERO; 2]);
        self.inverses.fill(T::ZERO);
        for (&slot, &value) in self.slots.iter().zip(values) {
            match (slot as usize).checked_sub(size) {
                Some(entry) => self.entries[entry / 2][entry % 2] += value,
                None => self.inverses[slot as usize] += value,
            }
        }
        (0..size).all(|j| self.eliminate(j))
    }

    /// Computes column j of L, row j of U and their pivot.
    fn eliminate(&mut self, j: usize) -> bool {
        let own = self.column(j);
        let Unpivoted { starts, rows, row_starts, row_entries, entries, inverses, work, .. } = self;
        for (row, entry) in rows[own.clone()].iter().zip(&entries[own.clone()]) {
            work[*row as usize] = *entry;
        }
        let mut pivot = inverses[j];
        let mut largest = pivot.size();
        for &(column, entry) in &row_entries[row_starts[j] as usize..row_starts[j + 1] as usize] {
            let (entry, end) = (entry as usize, starts[column as usize + 1] as usize);
            let [left, above] = entries[entry];
            let product = left * above;
            pivot -= product;
            largest = largest.max(product.size());
            for (row, [l, u]) in rows[entry + 1..end].iter().zip(&entries[entry + 1..end]) {
                let [of_l, of_u] = &mut work[*row as usize];
                *of_l -= *l * above;
                *of_u -= left * *u;
            }
        }
        let inverse = T::real(1.0) / pivot;
        inverses[j] = inverse;
        for (row, entry) in rows[own.clone()].iter().zip(&mut entries[own]) {
            let [l, u] = work[*row as usize];
            *entry = [l * inverse, u];
        }
        // Written so that a NaN is refused.
        pivot.size() > tolerances::UNPIVOTED * largest
    }

    /// Solves in place.
    pub fn solve(&mut self, x: &mut [T]) {
        let Unpivoted { order, starts, rows, entries, inverses, right, .. } = self;
        right.iter_mut().zip(order.iter()).for_each(|(right, &node)| *right = x[node as usize]);
        let column = |j: usize| starts[j] as usize..starts[j + 1] as usize;
        for j in 0..order.len() {
            let value = right[j];
            let below = rows[column(j)].iter().zip(&entries[column(j)]);
            below.for_each(|(&row, [l, _])| right[row as usize] -= *l * value);
        }
        for j in (0..order.len()).rev() {
            let beside = rows[column(j)].iter().zip(&entries[column(j)]);
            let rest = beside.fold(right[j], |rest, (&row, [_, u])| rest - *u * right[row as usize]);
            right[j] = rest * inverses[j];
            x[order[j] as usize] = right[j];
        }
    }
}

/// The entries of a lower triangle, given by columns, row by row: column and index of each.
fn by_rows(starts: &[u32], rows: &[u32]) -> (Vec<u32>, Vec<(u32, u32)>) {
    let size = starts.len() - 1;
    let mut row_starts = vec![0_u32; size + 1];
    rows.iter().for_each(|&row| row_starts[row as usize + 1] += 1);
    (0..size).for_each(|row| row_starts[row + 1] += row_starts[row]);
    let (mut next, mut entries) = (row_starts.clone(), vec![(0, 0); rows.len()]);
    for column in 0..size {
        for entry in starts[column]..starts[column + 1] {
            let row = rows[entry as usize] as usize;
            entries[next[row] as usize] = (column as u32, entry);
            next[row] += 1;
        }
    }
    (row_starts, entries)
}
