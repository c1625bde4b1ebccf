//! L D L^T by faer, which works on dense blocks: for factors with much fill.

use super::Pattern;
use super::order::order;
use super::pivot::{Judge, Quality, Rule};
use faer::dyn_stack::{MemBuffer, MemStack, StackReq};
use faer::linalg::cholesky::ldlt::factor::LdltRegularization;
use faer::sparse::linalg::cholesky::{
    CholeskySymbolicParams, LdltRef, SymbolicCholesky, SymbolicCholeskyRaw, SymmetricOrdering,
    factorize_symbolic_cholesky,
};
use faer::sparse::{Pair, SparseColMatRef, SymbolicSparseColMat};
use faer::{MatMut, Par, Side, Spec};

/// What the dense factorization puts in the place of a collapsed pivot: beyond, the multiplier is dropped. Unit: `[1]`.
/// Why: its row and column of L vanish, and its square is still a number.
const PLACE_OF_A_VANISHED_ROW: f64 = 1e200;

/// Supernodal factors of S K S, where S scales the coordinates to unit mass and the rows of G to (G diag(M)^-1 G^T)_jj
/// = 1, so that the thresholds of the pivots, which faer takes absolute, are relative ones.
pub(super) struct Supernodal {
    n: usize,
    /// Coordinate i, or n + row of G, in the order of elimination.
    order: Vec<usize>,
    /// The upper triangle of S K S in the order of elimination.
    matrix: SymbolicSparseColMat<usize>,
    entries: Vec<f64>,
    /// For each entry of M and of G its place in `entries`.
    slots: Vec<u32>,
    mass: Pattern,
    g: Pattern,
    cholesky: SymbolicCholesky<usize>,
    factor: Vec<f64>,
    memory: MemBuffer,
    signs: Vec<i8>,
    /// S by node, and by position.
    scale: Vec<f64>,
    late: Vec<bool>,
    diagonal: Vec<f64>,
    x: Vec<f64>,
}

impl Supernodal {
    /// `None` if faer cannot allocate.
    pub fn new(mass: &Pattern, g: &Pattern, late: &[bool]) -> Option<Self> {
        let n = mass.rows;
        let order = order(mass, g, late);
        let size = order.len();
        let places = places(&order, mass, g);
        let mut pairs = places.clone();
        pairs.sort_unstable();
        pairs.dedup();
        let slots = places.iter().map(|p| pairs.partition_point(|q| q < p) as u32).collect();
        let entries: Vec<_> = pairs.iter().map(|&(col, row)| Pair { row, col }).collect();
        let (matrix, _) = SymbolicSparseColMat::try_new_from_indices(size, size, &entries).ok()?;
        let parameters = CholeskySymbolicParams::default();
        let identity = SymmetricOrdering::Identity;
        let cholesky = factorize_symbolic_cholesky(matrix.as_ref(), Side::Upper, identity, parameters).ok()?;
        let request = StackReq::or(
            cholesky.factorize_numeric_ldlt_scratch::<f64>(Par::Seq, Spec::default()),
            cholesky.solve_in_place_scratch::<f64>(1, Par::Seq),
        );
        Some(Supernodal {
            signs: order.iter().map(|&node| if node < n { 1 } else { -1 }).collect(),
            matrix,
            entries: vec![0.0; entries.len()],
            slots,
            mass: mass.clone(),
            g: g.clone(),
            factor: vec![0.0; cholesky.len_val()],
            memory: MemBuffer::try_new(request).ok()?,
            cholesky,
            scale: vec![1.0; size],
            late: late.to_vec(),
            diagonal: vec![0.0; size],
            x: vec![0.0; size],
            n,
            order,
        })
    }

    pub fn factor(&mut self, mass: &[f64], g: &[f64], rule: Rule, skipped: &mut Vec<usize>) -> Result<Quality, usize> {
        balance(&self.mass, mass, &self.g, g, Some(&self.late), &mut self.scale);
        let replaced = self.assemble(mass, g, rule);
        let regularization = LdltRegularization {
            dynamic_regularization_signs: Some(&self.signs),
            dynamic_regularization_delta: PLACE_OF_A_VANISHED_ROW,
            dynamic_regularization_epsilon: rule.collapsed,
        };
        let matrix = SparseColMatRef::new(self.matrix.as_ref(), &self.entries);
        let stack = MemStack::new(&mut self.memory);
        let result = self.cholesky.factorize_numeric_ldlt(
            &mut self.factor,
            matrix,
            Side::Upper,
            regularization,
            Par::Seq,
            stack,
            Spec::default(),
        );
        if let Err(faer::linalg::cholesky::ldlt::factor::LdltError::ZeroPivot { index }) = result {
            return Err(self.order.get(index.saturating_sub(1)).copied().unwrap_or(0));
        }
        read_diagonal(&self.cholesky, &self.factor, &mut self.diagonal);
        self.judge(rule, skipped, replaced)
    }

    /// Writes the scaled matrix; returns true if a coordinate without mass was given some (under a rule that allows
    /// it).
    fn assemble(&mut self, mass: &[f64], g: &[f64], rule: Rule) -> bool {
        let n = self.n;
        let scale = &self.scale;
        self.entries.fill(0.0);
        let (mass_slots, g_slots) = self.slots.split_at(self.mass.entries.len());
        for ((&(i, j), value), &slot) in self.mass.entries.iter().zip(mass).zip(mass_slots) {
            self.entries[slot as usize] += value * scale[i] * scale[j];
        }
        for ((&(j, i), value), &slot) in self.g.entries.iter().zip(g).zip(g_slots) {
            self.entries[slot as usize] += value * scale[i] * scale[n + j];
        }
        let Some(floor) = rule.floor else { return false };
        let mut replaced = false;
        let columns = self.matrix.col_ptr().windows(2);
        for (columns, &node) in columns.zip(&self.order).filter(|(_, node)| **node < n) {
            // The diagonal is the last entry of its column in the upper triangle.
            let own = &mut self.entries[columns[1] - 1];
            if *own <= 0.0 {
                *own = floor * scale[node] * scale[node];
                replaced = true;
            }
        }
        replaced
    }

    fn judge(&self, rule: Rule, skipped: &mut Vec<usize>, replaced: bool) -> Result<Quality, usize> {
        let mut judge = Judge { n: self.n, rule, skipped, quality: Quality { replaced, ..Quality::GOOD } };
        for ((&d, &node), &sign) in self.diagonal.iter().zip(&self.order).zip(&self.signs) {
            let pivot = d * f64::from(sign);
            let left_out = pivot.abs() >= 1e-3 * PLACE_OF_A_VANISHED_ROW || pivot.is_nan();
            if left_out || pivot <= rule.weak {
                judge.judge(node, if left_out { 0.0 } else { pivot }, 1.0)?;
            }
        }
        Ok(judge.quality)
    }

    /// Solves in place; dropped multipliers are zero.
    pub fn solve(&mut self, top: &mut [f64], bottom: &mut [f64]) {
        let n = self.n;
        let nodes = &self.order;
        for (x, &node) in self.x.iter_mut().zip(nodes) {
            *x = self.scale[node] * if node < n { top[node] } else { bottom[node - n] };
        }
        let size = self.x.len();
        let x = MatMut::from_column_major_slice_mut(&mut self.x, size, 1);
        let factor = LdltRef::new(&self.cholesky, &self.factor);
        factor.solve_in_place_with_conj(faer::Conj::No, x, Par::Seq, MemStack::new(&mut self.memory));
        for (x, &node) in self.x.iter().zip(nodes) {
            let value = x * self.scale[node];
            if node < n { top[node] = value } else { bottom[node - n] = value }
        }
    }

    /// The smallest pivot of the scaled matrix above `collapsed`, and the number of multipliers not above it.
    pub fn smallest_ratio(&self, collapsed: f64) -> (f64, usize) {
        let mut found = (1.0, 0);
        for (d, &sign) in self.diagonal.iter().zip(&self.signs) {
            let pivot: f64 = d * f64::from(sign);
            if pivot > collapsed && pivot < 1e-3 * PLACE_OF_A_VANISHED_ROW {
                found.0 = pivot.min(found.0)
            } else {
                found.1 += usize::from(sign < 0)
            }
        }
        found
    }
}

/// For each entry of M and G its (column, row) in the upper triangle, by position; and the diagonal behind them.
fn places(order: &[usize], mass: &Pattern, g: &Pattern) -> Vec<(usize, usize)> {
    let mut position = vec![0; order.len()];
    for (k, &node) in order.iter().enumerate() {
        position[node] = k;
    }
    let place = |a: usize, b: usize| (position[a].max(position[b]), position[a].min(position[b]));
    let m = mass.entries.iter().map(|&(i, j)| place(i, j));
    let g = g.entries.iter().map(|&(j, i)| place(mass.rows + j, i));
    m.chain(g).chain((0..order.len()).map(|k| (k, k))).collect()
}

/// The pivots D, which faer keeps on the diagonal of L.
fn read_diagonal(cholesky: &SymbolicCholesky<usize>, factor: &[f64], diagonal: &mut [f64]) {
    match cholesky.raw() {
        SymbolicCholeskyRaw::Simplicial(symbolic) => {
            for (d, &start) in diagonal.iter_mut().zip(symbolic.col_ptr()) {
                *d = factor[start];
            }
        }
        SymbolicCholeskyRaw::Supernodal(symbolic) => {
            let (begins, ends, places) =
                (symbolic.supernode_begin(), symbolic.supernode_end(), symbolic.col_ptr_for_val());
            for (s, (&begin, &end)) in begins.iter().zip(ends).enumerate() {
                let rows = (places[s + 1] - places[s]) / (end - begin).max(1);
                for k in 0..end - begin {
                    diagonal[begin + k] = factor[places[s] + k * rows + k];
                }
            }
        }
    }
}

/// Scales that make the masses one and the rows of G of unit norm in the mass metric, (G diag(M)^-1 G^T)_jj = 1, by
/// node. Late coordinates (by default those without mass) are scaled by the entries of the scaled rows.
pub(super) fn balance(
    mass: &Pattern,
    mass_values: &[f64],
    g: &Pattern,
    g_values: &[f64],
    late: Option<&[bool]>,
    scale: &mut [f64],
) {
    scale.fill(0.0);
    let (coordinates, rows) = scale.split_at_mut(mass.rows);
    mass.add_diagonal(mass_values, coordinates);
    for (i, s) in coordinates.iter_mut().enumerate() {
        let is_late = late.map_or(*s <= 0.0, |late| late[i]);
        *s = if is_late { 0.0 } else { inverse_root(*s) };
    }
    for (&(j, i), value) in g.entries.iter().zip(g_values) {
        rows[j] += (value * coordinates[i]).powi(2);
    }
    rows.iter_mut().for_each(|s| *s = inverse_root(*s));
    // Squares of late coordinates are summed with negative sign, which tells them from scales.
    for (&(j, i), value) in g.entries.iter().zip(g_values) {
        if coordinates[i] <= 0.0 {
            coordinates[i] -= (value * rows[j]).powi(2);
        }
    }
    coordinates.iter_mut().filter(|s| **s <= 0.0).for_each(|s| *s = inverse_root(-*s));
}

fn inverse_root(square: f64) -> f64 {
    if square > 0.0 { square.sqrt().recip() } else { 1.0 }
}
