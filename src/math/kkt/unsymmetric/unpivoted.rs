//! LU without pivoting, in parts that are factored at once.

use super::Field;
use super::columns::Columns;
use crate::math::kkt::order::{delayed, ordered};
use crate::math::kkt::parts::{SEPARATOR, divide};
use crate::math::threads::each_of;
use crate::tolerances;
use faer::sparse::SymbolicSparseColMat;

/// L U with pivots on the diagonal, in an order that has each multiplier behind all its coordinates: with A symmetric
/// and positive definite on the null space of G no pivot vanishes then, unless its row of G depends on rows before it;
/// h^2 K and h C change that little. Where a pivot is small beside the numbers whose difference it is, the matrix is not
/// factored. Large matrices are divided as in [`parts`](super::super::parts), by their structure alone.
pub(super) struct Unpivoted<T> {
    pub parts: Vec<UnpivotedPart<T>>,
    /// The separator, with what the elimination of all parts leaves of it.
    last: UnpivotedPart<T>,
}

/// Unknowns that are eliminated together, and behind them those of the separator.
pub(super) struct UnpivotedPart<T> {
    /// Node (coordinate, or n + row of G) of each unknown that is eliminated.
    nodes: Vec<usize>,
    /// Values of the matrix that it has, with their slots.
    slots: Vec<(u32, u32)>,
    columns: Columns<T>,
    is_stable: bool,
}

impl<T: Field> Unpivoted<T> {
    /// For a matrix with entries at these places, of which the first `n` rows and columns are coordinates; `None` if its
    /// factors are too long.
    pub fn new(places: &SymbolicSparseColMat<usize>, n: usize) -> Option<Self> {
        let (of_node, count) = division(places, n);
        let nodes = |part: u32| order(places, n, (0..of_node.len()).filter(|&node| of_node[node] == part).collect());
        let separator = nodes(SEPARATOR);
        let part = |part: u32| UnpivotedPart::new(places, &of_node, part, nodes(part), &separator);
        let parts = (0..count as u32).map(part).collect::<Option<_>>()?;
        Some(Unpivoted { parts, last: UnpivotedPart::new(places, &of_node, SEPARATOR, separator, &[])? })
    }

    /// Factors the matrix with these values at its places; returns false where a pivot is too small.
    pub fn factor(&mut self, values: &[T]) -> bool {
        let Unpivoted { parts, last } = self;
        each_of(parts, |part| part.factor(values));
        last.load(values);
        parts.iter().for_each(|part| last.columns.add_left(&part.columns));
        parts.iter().all(|part| part.is_stable) && last.columns.factor()
    }

    /// Solves in place.
    pub fn solve(&mut self, x: &mut [T]) {
        let Unpivoted { parts, last } = self;
        let given: &[T] = x;
        each_of(parts, |part| part.forward(given));
        last.read(given);
        for part in &*parts {
            let moved = &part.columns.x[part.nodes.len()..];
            last.columns.x.iter_mut().zip(moved).for_each(|(sum, x)| *sum += *x);
        }
        last.columns.forward();
        last.columns.backward();
        let of_separator = &last.columns.x;
        each_of(parts, |part| part.backward(of_separator));
        for UnpivotedPart { nodes, columns, .. } in parts.iter().chain([&*last]) {
            nodes.iter().zip(&columns.x).for_each(|(&node, solution)| x[node] = *solution);
        }
    }
}

impl<T: Field> UnpivotedPart<T> {
    fn new(
        places: &SymbolicSparseColMat<usize>,
        of_node: &[u32],
        part: u32,
        nodes: Vec<usize>,
        separator: &[usize],
    ) -> Option<Self> {
        let own = nodes.len();
        let size = nodes.len() + separator.len();
        let mut place = vec![usize::MAX; of_node.len()];
        nodes.iter().chain(separator).enumerate().for_each(|(k, &node)| place[node] = k);
        // What belongs to the separator alone is added there.
        let is_own = |(_, (row, col)): &(usize, (usize, usize))| of_node[*row].min(of_node[*col]) == part;
        let values: Vec<_> = entries(places).enumerate().filter(is_own).collect();
        let coupled = values.iter().map(|&(_, (row, col))| (place[row], place[col]));
        let full = if part == SEPARATOR { 0 } else { own };
        let columns =
            Columns::new(size, own, coupled.chain((full..size).flat_map(|j| (j..size).map(move |i| (i, j)))))?;
        let slots = values.iter().map(|&(value, (row, col))| (value as u32, columns.slot(place[row], place[col])));
        Some(UnpivotedPart { slots: slots.collect(), nodes, columns, is_stable: true })
    }

    fn load(&mut self, values: &[T]) {
        self.columns.load(self.slots.iter().map(|&(value, slot)| (slot, values[value as usize])));
    }

    fn factor(&mut self, values: &[T]) {
        self.load(values);
        self.is_stable = self.columns.factor();
    }

    /// Takes its right sides from those of all nodes, with zeros for the separator.
    fn read(&mut self, all: &[T]) {
        self.columns.x.fill(T::ZERO);
        self.columns.x.iter_mut().zip(&self.nodes).for_each(|(x, &node)| *x = all[node]);
    }

    fn forward(&mut self, all: &[T]) {
        self.read(all);
        self.columns.forward();
    }

    fn backward(&mut self, of_separator: &[T]) {
        self.columns.x[self.nodes.len()..].copy_from_slice(of_separator);
        self.columns.backward();
    }
}

/// Rows and columns of all entries.
fn entries(places: &SymbolicSparseColMat<usize>) -> impl Iterator<Item = (usize, usize)> {
    (0..places.ncols()).flat_map(|col| places.row_idx_of_col_raw(col).iter().map(move |&row| (row, col)))
}

/// The coordinates that a multiplier acts on; none for a coordinate.
fn coordinates(places: &SymbolicSparseColMat<usize>, n: usize, node: usize) -> impl Iterator<Item = usize> {
    places.row_idx_of_col_raw(node).iter().copied().filter(move |&row| node >= n && row < n)
}

/// The part of each node, and the number of parts.
fn division(places: &SymbolicSparseColMat<usize>, n: usize) -> (Vec<u32>, usize) {
    let size = places.nrows();
    let neighbours = (0..size).map(|col| places.row_idx_of_col_raw(col).iter().map(|&row| row as u32).collect());
    let most = (size / tolerances::UNKNOWNS_OF_A_PART).min(tolerances::MOST_PARTS);
    let divided =
        if most > 1 { divide(&neighbours.collect::<Vec<_>>(), most, 8 * tolerances::LARGEST_SEPARATOR) } else { None };
    let (mut of_node, count) = divided.unwrap_or_else(|| (vec![0; size], 1));
    // A multiplier comes behind all its coordinates.
    for node in n..size {
        if coordinates(places, n, node).any(|i| of_node[i] == SEPARATOR) {
            of_node[node] = SEPARATOR;
        }
    }
    (of_node, count)
}

/// These nodes in approximate minimum degree, with multipliers (from `n` on) moved behind their coordinates.
fn order(places: &SymbolicSparseColMat<usize>, n: usize, nodes: Vec<usize>) -> Vec<usize> {
    let total = places.nrows();
    let mut is_here = vec![false; total];
    nodes.iter().for_each(|&node| is_here[node] = true);
    let behind = nodes.iter().flat_map(|&row| coordinates(places, n, row).map(move |i| (row, i)));
    delayed(&ordered(&nodes, total, entries(places)), total, behind.filter(|(_, i)| is_here[*i]))
}
