//! The frozen structure of a factor L D L^T of the saddle-point matrix.

use super::Pattern;
use super::order::{columns, lower_adjacency, order};

/// Positions 0..n+m are places in the order of elimination.
pub(super) struct Symbolic {
    /// Coordinate i, or n + row of G, in the order of elimination.
    pub order: Vec<usize>,
    /// Number of coordinates.
    pub n: usize,
    /// The pattern of L below the diagonal, by columns.
    pub starts: Vec<usize>,
    pub rows: Vec<u32>,
    /// For each entry of M and of G its place: p < n + m is the diagonal at p, n + m + k is entry k of `rows`.
    pub mass_slots: Vec<u32>,
    pub g_slots: Vec<u32>,
}

impl Symbolic {
    pub fn new(mass: &Pattern, g: &Pattern, late: &[bool]) -> Self {
        let order = order(mass, g, late);
        let columns = columns(&lower_adjacency(mass, g, &order), order.len());
        let mut starts = vec![0];
        let mut rows = Vec::with_capacity(columns.iter().map(Vec::len).sum());
        for column in &columns {
            rows.extend_from_slice(column);
            starts.push(rows.len());
        }
        let mut symbolic = Symbolic { order, n: mass.rows, starts, rows, mass_slots: vec![], g_slots: vec![] };
        let mut position = vec![0; columns.len()];
        for (k, &node) in symbolic.order.iter().enumerate() {
            position[node] = k;
        }
        symbolic.mass_slots = mass.entries.iter().map(|&(i, j)| symbolic.slot(position[i], position[j])).collect();
        let n = symbolic.n;
        symbolic.g_slots = g.entries.iter().map(|&(j, i)| symbolic.slot(position[n + j], position[i])).collect();
        symbolic
    }

    pub fn size(&self) -> usize {
        self.order.len()
    }

    /// +1 for the coordinates, -1 for the multipliers, by position: the signs of the pivots.
    pub fn signs(&self) -> impl Iterator<Item = i8> {
        self.order.iter().map(|&node| if node < self.n { 1 } else { -1 })
    }

    fn slot(&self, a: usize, b: usize) -> u32 {
        let (row, col) = (a.max(b), a.min(b));
        if row == col {
            return row as u32;
        }
        let column = &self.rows[self.starts[col]..self.starts[col + 1]];
        (self.size() + self.starts[col] + column.partition_point(|&r| (r as usize) < row)) as u32
    }
}
