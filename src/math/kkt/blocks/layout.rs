//! Places of all blocks of L D L^T in one array, in the order of elimination.

use super::super::Pattern;
use super::super::order::{columns, lower_adjacency, order};
use super::groups::Groups;
use std::ops::Range;

/// One group: its diagonal block, then the blocks below it, row by row.
#[derive(Default)]
pub struct Column {
    /// Number of its unknowns.
    pub width: usize,
    /// Its unknowns among all in the order of elimination.
    pub first: usize,
    /// Place of the diagonal block.
    pub diagonal: usize,
    /// Places of the blocks below it.
    pub below: Range<usize>,
    /// The groups below it, in [`Layout::partners`], and their unknowns, in [`Layout::rows`].
    pub partners: Range<usize>,
    pub rows: Range<usize>,
    /// The width of all of its partners, 0 if they differ.
    pub partner_width: usize,
    /// Where its list in [`Layout::targets`] begins.
    pub targets: usize,
    /// True if the diagonal block has no entry off its diagonal.
    pub is_diagonal: bool,
    /// 1 for coordinates, -1 for rows of G: the sign of its pivots.
    pub sign: f64,
}

/// Columns in sequence that are alike.
pub struct Run {
    pub columns: Range<usize>,
    /// Number of unknowns of each, and of each of their partners, 0 if these differ.
    pub width: usize,
    pub partner_width: usize,
    pub is_early: bool,
}

/// The frozen structure of the factors.
pub struct Layout {
    pub columns: Vec<Column>,
    pub runs: Vec<Run>,
    /// Widths of the groups below each column, and the rows before each of them.
    pub partners: Vec<u8>,
    before: Vec<u32>,
    /// Positions of the unknowns below each column.
    pub rows: Vec<u32>,
    /// For each pair of partners (l, k >= l) of a column the place of block (k, l), from the end of the column.
    pub targets: Vec<u32>,
    /// Coordinate i, or n + row of G, by position in the order of elimination.
    pub nodes: Vec<usize>,
    /// Number of columns, and of unknowns, of the early coordinates.
    pub early: usize,
    pub early_unknowns: usize,
    /// For each entry of M and of G its place.
    pub slots: Vec<u32>,
    /// Position of each coordinate and row of G.
    pub positions: Vec<u32>,
    /// Place of each unknown's diagonal entry.
    pub diagonals: Vec<u32>,
    /// Length of the array.
    pub len: usize,
}

impl Layout {
    pub fn new(mass: &Pattern, g: &Pattern, late: &[bool]) -> Self {
        let groups = Groups::new(mass, g, late);
        let (members, nodes) = groups.in_order(&order(mass, g, late));
        let below = columns(&lower_adjacency(&groups.mass, &groups.g, &nodes), nodes.len());
        let (count, n) = (groups.coordinates.len(), g.cols);
        let mut layout = Layout {
            columns: Vec::with_capacity(nodes.len()),
            runs: Vec::new(),
            partners: Vec::new(),
            before: Vec::new(),
            rows: Vec::new(),
            targets: Vec::new(),
            nodes: Vec::with_capacity(n + g.rows),
            early: groups.late.iter().filter(|late| !**late).count(),
            early_unknowns: 0,
            slots: Vec::new(),
            positions: vec![0; n + g.rows],
            diagonals: Vec::with_capacity(n + g.rows),
            len: 0,
        };
        for &group in &nodes {
            let first = layout.nodes.len();
            layout.nodes.extend(&members[group]);
            layout.push(first, group < count, group < count && !groups.late[group]);
        }
        layout.early_unknowns = layout.columns.get(layout.early).map_or(layout.nodes.len(), |column| column.first);
        layout.place(&below);
        for (j, below) in below.iter().enumerate() {
            layout.aim(j, below);
        }
        layout.nodes.iter().enumerate().for_each(|(p, &node)| layout.positions[node] = p as u32);
        layout.slots = layout.slots(mass, g);
        layout.runs = layout.runs();
        layout
    }

    fn push(&mut self, first: usize, is_coordinate: bool, is_diagonal: bool) {
        let sign = if is_coordinate { 1.0 } else { -1.0 };
        let width = self.nodes.len() - first;
        self.columns.push(Column { width, first, sign, is_diagonal, ..Column::default() });
    }

    /// Gives every block its place.
    fn place(&mut self, below: &[Vec<u32>]) {
        for (j, below) in below.iter().enumerate() {
            let starts = (self.partners.len(), self.rows.len());
            for &k in below {
                let Column { width, first, .. } = self.columns[k as usize];
                self.before.push((self.rows.len() - starts.1) as u32);
                self.partners.push(width as u8);
                self.rows.extend((first..first + width).map(|position| position as u32));
            }
            let column = &mut self.columns[j];
            (column.partners, column.rows) = (starts.0..self.partners.len(), starts.1..self.rows.len());
            let (len, end) = (self.len, self.len + column.width * column.width);
            column.diagonal = len;
            let widths = &self.partners[column.partners.clone()];
            let alike = widths.first().filter(|first| widths.iter().all(|width| width == *first));
            column.partner_width = alike.map_or(0, |&width| usize::from(width));
            column.below = end..end + column.rows.len() * column.width;
            self.diagonals.extend((0..column.width).map(|p| (len + p * column.width + p) as u32));
            self.len = column.below.end;
        }
    }

    /// Lists where the products of a column with itself go.
    fn aim(&mut self, j: usize, below: &[u32]) {
        self.columns[j].targets = self.targets.len();
        let end = self.columns[j].below.end;
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
        let (first, column) = (self.columns[row].first, &self.columns[column]);
        let before = &self.before[column.partners.clone()];
        let rows = &self.rows[column.rows.clone()];
        let partner = before.partition_point(|&before| (rows[before as usize] as usize) < first);
        column.below.start + column.width * before.get(partner).map_or(0, |&before| before as usize)
    }

    /// Places of the entries of M and G; marks the blocks that are not diagonal.
    fn slots(&mut self, mass: &Pattern, g: &Pattern) -> Vec<u32> {
        let mut places = vec![(0, 0); self.nodes.len()];
        for (k, column) in self.columns.iter().enumerate() {
            (0..column.width).for_each(|p| places[self.nodes[column.first + p]] = (k, p));
        }
        let entries = g.entries.iter().map(|&(row, i)| (g.cols + row, i));
        let pairs = mass.entries.iter().copied().chain(entries);
        pairs.map(|(a, b)| self.slot(places[a].max(places[b]), places[a].min(places[b])) as u32).collect()
    }

    fn slot(&mut self, (row, p): (usize, usize), (column, q): (usize, usize)) -> usize {
        let width = self.columns[column].width;
        let block = match row == column {
            true => self.columns[column].diagonal,
            false => self.block(row, column),
        };
        self.columns[column].is_diagonal &= row != column || p == q;
        block + p * width + q
    }

    /// Splits the columns where their widths change, and where the late ones begin.
    fn runs(&self) -> Vec<Run> {
        let mut runs: Vec<Run> = Vec::new();
        for (k, column) in self.columns.iter().enumerate() {
            let (width, is_early) = (column.width, k < self.early);
            let partner_width = if column.below.is_empty() { None } else { Some(column.partner_width) };
            match runs.last_mut().filter(|run| run.width == width && run.is_early == is_early) {
                Some(run) if partner_width.is_none_or(|width| width == run.partner_width) => run.columns.end = k + 1,
                _ => {
                    let partner_width = partner_width.unwrap_or(0);
                    runs.push(Run { columns: k..k + 1, width, partner_width, is_early });
                }
            }
        }
        runs
    }

    /// Multiplications of a factorization.
    pub fn operations(&self) -> usize {
        let products = |column: &Column| {
            let rows = column.below.len() / column.width;
            column.width * rows * (rows + 1) / 2
        };
        self.columns.iter().map(products).sum()
    }
}
