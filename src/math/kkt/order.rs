//! The elimination order of the saddle-point matrix.
//!
//! The *early* coordinates come first, so that they are eliminated with pivots of the mass matrix alone; the remaining
//! matrix is -G M^-1 G^T on the multipliers, semidefinite, and needs no pivoting either: a pivot vanishes there if and
//! only if its row of G depends on the rows before it. *Late* coordinates come each behind all its multipliers: those
//! without mass, which have no pivot before, and hubs, whose early elimination would couple all their multipliers.

use super::Pattern;
use faer::dyn_stack::{MemBuffer, MemStack};
use faer::sparse::linalg::amd;
use faer::sparse::{Pair, SymbolicSparseColMat};

/// The order of elimination for M (n x n) and G (m x n), where node i < n is coordinate i and n + j is multiplier j;
/// coordinates with `late[i]` come after their multipliers.
/// Fill-reducing (approximate minimum degree) among the early coordinates, and then in the remaining graph.
pub(super) fn order(mass: &Pattern, g: &Pattern, late: &[bool]) -> Vec<usize> {
    order_before(mass, g, late, &[])
}

/// The same for all nodes but the `last`, which come after them and couple each other all.
pub(super) fn order_before(mass: &Pattern, g: &Pattern, late: &[bool], last: &[usize]) -> Vec<usize> {
    let left = Left::new(mass, g, late);
    let n = mass.rows;
    let total = mass.rows + g.rows;
    let mut edges = left.edges(mass, g);
    // Coupled to so many nodes that are not there, the last are not taken before the others.
    let weights = if last.is_empty() { 0..0 } else { total..total + WEIGHTS };
    let heavy: Vec<usize> = last.iter().copied().chain(weights.clone()).collect();
    edges.extend(pairs(&heavy));
    let nodes: Vec<usize> = left.rest().iter().copied().chain(weights.clone()).collect();
    let mut rest = ordered(&nodes, weights.end.max(total), edges.into_iter());
    let mut is_last = vec![false; weights.end.max(total)];
    heavy.iter().for_each(|&node| is_last[node] = true);
    rest.retain(|&node| !is_last[node]);
    let mut nodes = left.all[..left.early].to_vec();
    let behind = g.entries.iter().filter(|(_, i)| late[*i]).map(|&(row, i)| (i, n + row));
    nodes.extend(delayed(&rest, total, behind));
    nodes
}

/// Number of nodes that the last ones are coupled to beside the matrix.
const WEIGHTS: usize = 32;

/// What the elimination of the early coordinates leaves.
pub(super) struct Left {
    /// Early coordinates in their order, then the other nodes.
    pub all: Vec<usize>,
    pub early: usize,
    /// The patterns below the diagonal of the early columns of L, by positions in `all`.
    pub columns: Vec<Vec<u32>>,
}

impl Left {
    pub fn new(mass: &Pattern, g: &Pattern, late: &[bool]) -> Self {
        let n = mass.rows;
        let m = g.rows;
        let nodes: Vec<usize> = (0..n).filter(|&i| !late[i]).collect();
        let early = nodes.len();
        let mut all = ordered(&nodes, n + m, mass.entries.iter().copied());
        all.extend((0..n).filter(|&i| late[i]).chain(n..n + m));
        let columns = columns(&lower_adjacency(mass, g, &all), early);
        Left { all, early, columns }
    }

    /// The other nodes.
    pub fn rest(&self) -> &[usize] {
        &self.all[self.early..]
    }

    /// Pairs of nodes that are coupled, all those among the other nodes.
    pub fn edges(&self, mass: &Pattern, g: &Pattern) -> Vec<(usize, usize)> {
        // Coordinates of a body mostly have one clique.
        let cliques = self.columns.chunk_by(|a, b| a == b).map(|alike| &alike[0]);
        let cliques = cliques.filter(|c| c.first().is_some_and(|&parent| parent as usize >= self.early));
        let cliques = cliques.map(|c| c.iter().map(|&a| self.all[a as usize]).collect::<Vec<_>>());
        cliques.flat_map(|c| pairs(&c)).chain(edges_of(mass, g)).collect()
    }
}

/// All pairs of a clique.
fn pairs(clique: &[usize]) -> Vec<(usize, usize)> {
    clique.iter().enumerate().flat_map(|(k, &a)| clique[..k].iter().map(move |&b| (b, a))).collect()
}

/// The entries of the saddle-point matrix as pairs of nodes.
fn edges_of(mass: &Pattern, g: &Pattern) -> impl Iterator<Item = (usize, usize)> {
    let n = mass.rows;
    mass.entries.iter().copied().chain(g.entries.iter().map(move |&(j, i)| (n + j, i)))
}

/// `nodes` in approximate-minimum-degree order of their subgraph; `total` bounds the node numbers.
pub(super) fn ordered(nodes: &[usize], total: usize, edges: impl Iterator<Item = (usize, usize)>) -> Vec<usize> {
    let mut local = vec![usize::MAX; total];
    for (k, &node) in nodes.iter().enumerate() {
        local[node] = k;
    }
    let mut upper: Vec<(usize, usize)> = edges
        .map(|(a, b)| (local[a], local[b]))
        .filter(|&(a, b)| a != usize::MAX && b != usize::MAX && a != b)
        .map(|(a, b)| (a.max(b), a.min(b)))
        .collect();
    if upper.is_empty() {
        return nodes.to_vec();
    }
    upper.sort_unstable();
    upper.dedup();
    let upper: Vec<_> = upper.into_iter().map(|(col, row)| Pair { row, col }).collect();
    // If there is no memory for a good order, any order is valid.
    minimum_degree(nodes.len(), &upper).map_or(nodes.to_vec(), |order| order.iter().map(|&k| nodes[k]).collect())
}

fn minimum_degree(size: usize, upper: &[Pair<usize, usize>]) -> Option<Vec<usize>> {
    let (graph, _) = SymbolicSparseColMat::<usize>::try_new_from_indices(size, size, upper).ok()?;
    let mut order = vec![0; size];
    let mut inverse = vec![0; size];
    let mut memory = MemBuffer::try_new(amd::order_scratch::<usize>(size, upper.len())).ok()?;
    let stack = MemStack::new(&mut memory);
    amd::order(&mut order, &mut inverse, graph.as_ref(), amd::Control::default(), stack).ok()?;
    Some(order)
}

/// An order with nodes delayed: each pair is one of them and a node that it has to come behind, itself not delayed.
pub(super) fn delayed(order: &[usize], total: usize, pairs: impl Iterator<Item = (usize, usize)>) -> Vec<usize> {
    let mut waiting = vec![0_usize; total];
    let mut waited_for = vec![Vec::new(); total];
    for (late, early) in pairs {
        waiting[late] += 1;
        waited_for[early].push(late);
    }
    let mut is_reached = vec![false; total];
    let mut nodes = Vec::with_capacity(order.len());
    for &node in order {
        is_reached[node] = true;
        if waiting[node] > 0 {
            continue;
        }
        nodes.push(node);
        for &late in &waited_for[node] {
            waiting[late] -= 1;
            nodes.extend((waiting[late] == 0 && is_reached[late]).then_some(late));
        }
    }
    nodes
}

/// For each position in the order `nodes`, the later positions that the matrix couples it to, sorted.
pub(super) fn lower_adjacency(mass: &Pattern, g: &Pattern, nodes: &[usize]) -> Vec<Vec<u32>> {
    let mut position = vec![0; nodes.len()];
    for (k, &node) in nodes.iter().enumerate() {
        position[node] = k;
    }
    let mut adjacency = vec![Vec::new(); nodes.len()];
    for (a, b) in edges_of(mass, g).map(|(a, b)| (position[a], position[b])).filter(|(a, b)| a != b) {
        adjacency[a.min(b)].push(a.max(b) as u32);
    }
    for column in &mut adjacency {
        column.sort_unstable();
        column.dedup();
    }
    adjacency
}

/// The patterns below the diagonal of the first `count` columns of L, sorted: column j has its own entries and those
/// that its children in the elimination tree have beyond j.
pub(super) fn columns(adjacency: &[Vec<u32>], count: usize) -> Vec<Vec<u32>> {
    let mut children = vec![Vec::new(); adjacency.len()];
    let mut seen = vec![usize::MAX; adjacency.len()];
    let mut columns: Vec<Vec<u32>> = Vec::with_capacity(count);
    for (j, own) in adjacency.iter().enumerate().take(count) {
        let mut column = own.clone();
        seen[j] = j;
        column.iter().for_each(|&i| seen[i as usize] = j);
        for &child in &children[j] {
            let fill: &Vec<u32> = &columns[child];
            for &i in fill {
                if seen[i as usize] != j {
                    seen[i as usize] = j;
                    column.push(i);
                }
            }
        }
        column.sort_unstable();
        if let Some(&parent) = column.first() {
            children[parent as usize].push(j);
        }
        columns.push(column);
    }
    columns
}
