//! Places of all blocks of L D L^T in one array, in the order of elimination. Bodies have none: they come first.

use super::super::order::{columns, lower_adjacency, order};
use super::super::{Lever, Pattern};
use super::bodies::{BlockSide, Bodies, Entries, find};
use super::groups::Groups;
use std::collections::BTreeMap;
use std::ops::Range;

/// One group: its diagonal block, then the blocks below it, row by row.
#[derive(Default)]
struct BlockColumn {
    /// Number of its unknowns, and the first of them in the order of elimination.
    width: usize,
    first: usize,
    /// Place of the diagonal block.
    diagonal: usize,
    /// The groups below it in [`Layout::widths`], and their unknowns in [`Layout::below`].
    partners: Range<usize>,
    rows: Range<usize>,
    /// Where its products begin in [`Layout::targets`].
    targets: usize,
    /// True if the diagonal block has no entry off its diagonal.
    is_diagonal: bool,
    is_coordinate: bool,
}

/// Columns in sequence that are alike; all that belongs to them stands in their order.
pub struct ColumnRun {
    pub columns: Range<usize>,
    pub partners: Range<usize>,
    pub rows: Range<usize>,
    pub targets: Range<usize>,
    /// Position of the first unknown.
    pub first: usize,
    /// Where their blocks begin and end.
    pub place: usize,
    pub end: usize,
    /// Number of unknowns of each, and of each of their partners, 0 if these differ.
    pub width: usize,
    pub partner_width: usize,
    pub is_early: bool,
    pub is_diagonal: bool,
    /// 1 for coordinates, -1 for rows of G: the sign of the pivots.
    pub sign: f64,
}

/// The frozen structure of the factors.
#[derive(Default)]
pub struct Layout {
    pub bodies: Bodies,
    columns: Vec<BlockColumn>,
    pub runs: Vec<ColumnRun>,
    /// Number of unknowns below each column, and their positions.
    pub heights: Vec<u32>,
    pub below: Vec<u32>,
    /// Widths of the groups below each column.
    pub widths: Vec<u8>,
    /// For each pair of partners (l, k >= l) of a column the place of block (k, l), from the end of the column.
    pub targets: Vec<u32>,
    /// Coordinate i, or n + row of G, by position in the order of elimination.
    pub nodes: Vec<usize>,
    /// Number of columns, and of unknowns, of the early coordinates.
    pub early: usize,
    pub early_unknowns: usize,
    /// Entries of M and of G that are not of bodies, with their places.
    pub mass_slots: Vec<(u32, u32)>,
    pub g_slots: Vec<(u32, u32)>,
    /// Coordinates that are not of bodies, with their positions, the positions of the late ones among them, and of each
    /// row of G.
    pub coordinates: Vec<(u32, u32)>,
    pub late: Vec<u32>,
    pub g_rows: Vec<u32>,
    /// Place of each unknown's diagonal entry.
    pub diagonals: Vec<u32>,
    /// Length of the array.
    pub len: usize,
    /// Number of runs before the last columns, and where these begin: position and place.
    pub own_runs: usize,
    pub last: (usize, usize),
}

impl Layout {
    /// For M and G with these late coordinates; `levers` are blocks of G.
    pub fn new(mass: &Pattern, g: &Pattern, late: &[bool], levers: &[Lever]) -> Self {
        let groups = Groups::new(mass, g, late);
        let order = groups.in_order(&order(mass, g, late));
        Self::of(mass, g, &groups, order, &[], levers)
    }

    /// For groups in an order, the `last` behind the others: these have all blocks between each other.
    pub fn of(
        mass: &Pattern,
        g: &Pattern,
        groups: &Groups,
        order: Vec<usize>,
        last: &[usize],
        levers: &[Lever],
    ) -> Self {
        let entries = find(mass, g, groups);
        let (first, mut others): (Vec<usize>, Vec<usize>) =
            order.into_iter().partition(|&group| entries.get(group).is_some_and(Option::is_some));
        let own = others.len();
        others.extend(last);
        let nodes = [first.as_slice(), &others].concat();
        // Bodies fill the others' columns.
        let below = columns(&lower_adjacency(&groups.mass, &groups.g, &nodes), first.len() + own);
        let below = below[first.len()..].iter().map(|column| column.iter().map(|&k| k - first.len() as u32).collect());
        let full = (own..others.len()).map(|k| (k as u32 + 1..others.len() as u32).collect());
        let below: Vec<Vec<u32>> = below.chain(full).collect();
        let count = groups.coordinates.len();
        let n = g.cols;
        let mut layout = Layout {
            columns: Vec::with_capacity(others.len()),
            early: others.iter().filter(|&&group| group < count && !groups.late[group]).count(),
            g_rows: vec![0; g.rows],
            ..Layout::default()
        };
        for &group in &others {
            let first = layout.nodes.len();
            if group < count {
                layout.nodes.extend(&groups.coordinates[group])
            } else {
                layout.nodes.extend(groups.rows[group - count].iter().map(|row| n + row))
            }
            layout.push(first, group < count, group < count && !groups.late[group]);
        }
        layout.early_unknowns = layout.columns.get(layout.early).map_or(layout.nodes.len(), |column| column.first);
        layout.place(&below);
        for (j, below) in below.iter().enumerate() {
            layout.aim(j, below);
        }
        for (p, &node) in layout.nodes.iter().enumerate() {
            if node < n { layout.coordinates.push((node as u32, p as u32)) } else { layout.g_rows[node - n] = p as u32 }
        }
        let positions = layout.coordinates.iter().map(|&(_, p)| p);
        layout.late = positions.filter(|&p| p as usize >= layout.early_unknowns).collect();
        layout.slots(mass, g);
        layout.add_bodies(mass, &first, groups, entries, levers);
        layout.runs = layout.runs(own);
        layout.own_runs = layout.runs.partition_point(|run| run.columns.start < own);
        let begin = layout.columns.get(own).map(|column| (column.first, column.diagonal));
        layout.last = begin.unwrap_or((layout.nodes.len(), layout.len));
        layout
    }

    fn add_bodies(
        &mut self,
        mass: &Pattern,
        first: &[usize],
        groups: &Groups,
        mut entries: Vec<Option<Entries>>,
        levers: &[Lever],
    ) {
        let signs: BTreeMap<usize, f64> = levers.iter().map(|lever| (lever.first_entry, lever.sign)).collect();
        let mut bodies = Bodies::default();
        for &group in first {
            let coordinates = &groups.coordinates[group];
            let entries = entries[group].take().unwrap_or_default();
            let masses: Vec<_> = entries.mass.iter().map(|&entry| (entry, mass.entries[entry])).collect();
            let blocks = entries.sides.into_iter();
            let mut blocks: Vec<BlockSide> = blocks
                .map(|(rows, entries)| {
                    let rows = &groups.rows[rows];
                    BlockSide {
                        entries: entries as u32,
                        position: self.g_rows[rows[0]],
                        rows: rows.len() as u32,
                        sign: signs.get(&entries).copied().unwrap_or(0.0),
                    }
                })
                .collect();
            blocks.sort_by_key(|side| side.position);
            bodies.push(coordinates[0], coordinates.len(), &masses, blocks, |row, column| self.product(row, column));
        }
        self.bodies = bodies;
    }

    /// Place of the block of the columns that begin at these positions, the second at or before the first.
    fn product(&self, row: u32, column: u32) -> usize {
        let of = |position: u32| self.columns.partition_point(|column| column.first <= position as usize) - 1;
        if row == column { self.columns[of(column)].diagonal } else { self.block(of(row), of(column)) }
    }

    fn push(&mut self, first: usize, is_coordinate: bool, is_diagonal: bool) {
        let width = self.nodes.len() - first;
        self.columns.push(BlockColumn { width, first, is_diagonal, is_coordinate, ..BlockColumn::default() });
    }

    /// Gives every block its place.
    fn place(&mut self, below: &[Vec<u32>]) {
        for (j, below) in below.iter().enumerate() {
            let partners = self.widths.len();
            let rows = self.below.len();
            for &k in below {
                let BlockColumn { width, first, .. } = self.columns[k as usize];
                self.widths.push(width as u8);
                self.below.extend((first..first + width).map(|position| position as u32));
            }
            let len = self.len;
            let column = &mut self.columns[j];
            column.diagonal = len;
            column.partners = partners..self.widths.len();
            column.rows = rows..self.below.len();
            self.heights.push(column.rows.len() as u32);
            self.diagonals.extend((0..column.width).map(|p| (len + p * column.width + p) as u32));
            self.len = column.end();
        }
    }

    /// Lists where the products of a column with itself go.
    fn aim(&mut self, j: usize, below: &[u32]) {
        let end = self.columns[j].end();
        self.columns[j].targets = self.targets.len();
        for (l, &column) in below.iter().enumerate() {
            let own = &mut self.columns[column as usize];
            own.is_diagonal &= own.width == 1;
            self.targets.push((own.diagonal - end) as u32);
            for &row in &below[l + 1..] {
                let place = self.block(row as usize, column as usize);
                self.targets.push((place - end) as u32);
            }
        }
    }

    /// Place of the block of column `row` below that of an earlier column.
    fn block(&self, row: usize, column: usize) -> usize {
        let first = self.columns[row].first as u32;
        let column = &self.columns[column];
        let before = self.below[column.rows.clone()].partition_point(|&position| position < first);
        column.diagonal + column.width * (column.width + before)
    }

    /// Places of the entries of M and G that are not of bodies; marks the blocks that are not diagonal.
    fn slots(&mut self, mass: &Pattern, g: &Pattern) {
        let n = g.cols;
        let mut places = vec![None; n + g.rows];
        for (k, column) in self.columns.iter().enumerate() {
            (0..column.width).for_each(|p| places[self.nodes[column.first + p]] = Some((k, p)));
        }
        let mut slots = |entries: &mut dyn Iterator<Item = (usize, usize)>| {
            let mut slots = Vec::new();
            for (entry, (a, b)) in entries.enumerate() {
                if let (Some(a), Some(b)) = (places[a], places[b]) {
                    let (row, p) = a.max(b);
                    let (column, q) = a.min(b);
                    slots.push((entry as u32, self.slot(row, p, column, q) as u32));
                }
            }
            slots
        };
        let of_mass = slots(&mut mass.entries.iter().copied());
        let of_g = slots(&mut g.entries.iter().map(|&(row, i)| (n + row, i)));
        (self.mass_slots, self.g_slots) = (of_mass, of_g);
    }

    fn slot(&mut self, row: usize, p: usize, column: usize, q: usize) -> usize {
        let width = self.columns[column].width;
        let block = if row == column { self.columns[column].diagonal } else { self.block(row, column) };
        self.columns[column].is_diagonal &= row != column || p == q;
        block + p * width + q
    }

    /// Splits the columns where their kinds change, and behind the first `own`.
    fn runs(&self, own: usize) -> Vec<ColumnRun> {
        let mut runs: Vec<ColumnRun> = Vec::new();
        for (k, column) in self.columns.iter().enumerate() {
            let widths = &self.widths[column.partners.clone()];
            let alike = widths.first().filter(|first| widths.iter().all(|width| width == *first));
            let run = ColumnRun {
                columns: k..k + 1,
                partners: column.partners.clone(),
                rows: column.rows.clone(),
                targets: column.targets..self.columns.get(k + 1).map_or(self.targets.len(), |next| next.targets),
                first: column.first,
                place: column.diagonal,
                end: column.end(),
                width: column.width,
                partner_width: alike.map_or(0, |&width| usize::from(width)),
                is_early: k < self.early,
                is_diagonal: column.is_diagonal,
                sign: if column.is_coordinate { 1.0 } else { -1.0 },
            };
            match runs.last_mut().filter(|last| k != own && last.takes(&run)) {
                Some(last) => last.extend(run),
                None => runs.push(run),
            }
        }
        runs
    }

    /// Place of the diagonal entry of the unknown at a position.
    pub fn diagonal(&self, position: u32) -> usize {
        self.diagonals[position as usize] as usize
    }

    /// Number of runs of early columns.
    pub fn early_runs(&self) -> usize {
        self.runs.partition_point(|run| run.is_early)
    }

    /// Multiplications of a factorization.
    pub fn operations(&self) -> usize {
        let products = |column: &BlockColumn| column.width * column.rows.len() * (column.rows.len() + 1) / 2;
        self.columns.iter().map(products).sum::<usize>() + self.bodies.operations()
    }
}

impl BlockColumn {
    fn end(&self) -> usize {
        self.diagonal + self.width * (self.width + self.rows.len())
    }
}

impl ColumnRun {
    /// True if the next columns are alike; any partners suit where there are none.
    fn takes(&self, next: &ColumnRun) -> bool {
        let kind = |run: &ColumnRun| (run.width, run.is_early, run.is_diagonal, run.sign > 0.0);
        let own = self.partner_width;
        let other = next.partner_width;
        kind(self) == kind(next) && (own == other || self.partners.is_empty() || next.partners.is_empty())
    }

    /// Position of the first unknown of each column.
    pub fn firsts(&self) -> impl DoubleEndedIterator<Item = usize> + use<> {
        let first = self.first;
        let width = self.width;
        (0..self.columns.len()).map(move |j| first + j * width)
    }

    fn extend(&mut self, next: ColumnRun) {
        if self.partners.is_empty() {
            self.partner_width = next.partner_width;
        }
        self.columns.end = next.columns.end;
        self.partners.end = next.partners.end;
        self.rows.end = next.rows.end;
        self.targets.end = next.targets.end;
        self.end = next.end;
    }
}
