//! Bodies: groups of coordinates that M couples to nothing, not even to each other, eliminated without places of their
//! own. Their blocks of G are read where they stand.

use super::super::Pattern;
use super::groups::Groups;
use std::collections::BTreeMap;
use std::ops::Range;

/// Coordinates in sequence with a diagonal mass matrix.
pub struct Body {
    /// Its first coordinate.
    pub first: u32,
    /// Number of the blocks of G that it enters.
    pub sides: u32,
}

/// A block of G, row by row.
pub struct Side {
    /// Place of its first entry among the values of G.
    pub entries: u32,
    /// Position of its first row among the unknowns that are left, and the number of its rows.
    pub position: u32,
    pub rows: u32,
    /// Sign of the identity that a lever begins with, see [`Lever`](super::super::Lever).
    pub sign: f64,
}

/// Bodies in sequence that are alike.
pub struct Run {
    pub bodies: Range<usize>,
    /// Their blocks in [`Bodies::sides`], those of a body in the order of elimination of their rows.
    pub sides: Range<usize>,
    /// For each pair of blocks (l, k >= l) of a body the place where the product of k and l goes, in
    /// [`Bodies::targets`].
    pub targets: Range<usize>,
    /// Number of coordinates of a body, and of the rows of each of its blocks, 0 if these differ.
    pub width: usize,
    pub partner_width: usize,
    /// True if all blocks are levers.
    pub are_levers: bool,
}

#[derive(Default)]
pub struct Bodies {
    pub all: Vec<Body>,
    pub sides: Vec<Side>,
    pub targets: Vec<u32>,
    pub runs: Vec<Run>,
    /// Entries of M on the diagonal of bodies, with their coordinates.
    pub masses: Vec<(usize, usize)>,
}

/// The blocks of G of a body: groups of rows with the places of their first entries.
pub type Sides = Vec<(usize, usize)>;

/// The blocks of the groups of coordinates that are bodies, none for the others.
pub fn find(mass: &Pattern, g: &Pattern, groups: &Groups) -> Vec<Option<Sides>> {
    let (of_coordinate, of_row) = groups.numbers();
    let mut are_bodies: Vec<bool> = groups.late.iter().map(|late| !late).collect();
    let mut diagonals = vec![0; g.cols];
    for &(i, j) in &mass.entries {
        diagonals[i] += usize::from(i == j);
        are_bodies[of_coordinate[i]] &= i == j;
        are_bodies[of_coordinate[j]] &= i == j;
    }
    for (group, is_body) in groups.coordinates.iter().zip(&mut are_bodies) {
        *is_body &= is_sequence(group) && group.iter().all(|&i| diagonals[i] == 1);
    }
    let mut blocks: BTreeMap<(usize, usize), Vec<usize>> = BTreeMap::new();
    for (entry, &(row, i)) in g.entries.iter().enumerate() {
        blocks.entry((of_coordinate[i], of_row[row])).or_default().push(entry);
    }
    let mut sides: Vec<Sides> = vec![Vec::new(); groups.coordinates.len()];
    for ((group, rows), entries) in blocks {
        let (coordinates, rows_of) = (&groups.coordinates[group], &groups.rows[rows]);
        let places = rows_of.iter().flat_map(|&row| coordinates.iter().map(move |&i| (row, i)));
        are_bodies[group] &= is_sequence(&entries)
            && is_sequence(rows_of)
            && entries.len() == coordinates.len() * rows_of.len()
            && entries.iter().zip(places).all(|(&entry, place)| g.entries[entry] == place);
        sides[group].push((rows, entries[0]));
    }
    sides.into_iter().zip(are_bodies).map(|(sides, is_body)| is_body.then_some(sides)).collect()
}

fn is_sequence(numbers: &[usize]) -> bool {
    numbers.windows(2).all(|pair| pair[1] == pair[0] + 1)
}

impl Bodies {
    /// Adds a body with its blocks, and the place of each of their products.
    pub fn push(&mut self, first: usize, width: usize, sides: Vec<Side>, target: impl Fn(u32, u32) -> usize) {
        let starts = (self.all.len(), self.sides.len(), self.targets.len());
        for l in 0..sides.len() {
            self.targets.extend((l..sides.len()).map(|k| target(sides[k].position, sides[l].position) as u32));
        }
        let alike = sides.first().filter(|side| sides.iter().all(|other| other.rows == side.rows));
        let partner_width = alike.map_or(0, |side| side.rows as usize);
        let are_levers = partner_width > 0 && sides.iter().all(|side| side.sign != 0.0);
        self.all.push(Body { first: first as u32, sides: sides.len() as u32 });
        self.sides.extend(sides);
        let kind = |run: &Run| (run.width, run.partner_width, run.are_levers);
        if self.runs.last().is_none_or(|run| kind(run) != (width, partner_width, are_levers)) {
            let (bodies, sides, targets) = (starts.0..0, starts.1..0, starts.2..0);
            self.runs.push(Run { bodies, sides, targets, width, partner_width, are_levers });
        }
        if let Some(run) = self.runs.last_mut() {
            (run.bodies.end, run.sides.end, run.targets.end) = (self.all.len(), self.sides.len(), self.targets.len());
        }
    }

    /// Multiplications of the elimination.
    pub fn operations(&self) -> usize {
        let mut first = 0;
        let products = |run: &Run| {
            let bodies = self.all[run.bodies.clone()].iter();
            let rows = |body: &Body| {
                let sides = &self.sides[first..first + body.sides as usize];
                first += body.sides as usize;
                sides.iter().map(|side| side.rows as usize).sum::<usize>()
            };
            bodies.map(rows).map(|rows| run.width * rows * (rows + 1) / 2).sum::<usize>()
        };
        self.runs.iter().map(products).sum()
    }
}
