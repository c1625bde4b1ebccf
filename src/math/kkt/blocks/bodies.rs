//! Bodies: groups of coordinates that M couples to no others, eliminated without places of their own. Their blocks of G
//! are read where they stand.

use super::super::Pattern;
use super::dense::DenseBody;
use super::groups::Groups;
use std::collections::BTreeMap;
use std::ops::Range;

/// Coordinates in sequence with a mass matrix of their own.
pub struct Body {
    /// Its first coordinate.
    pub first: u32,
    /// Number of the blocks of G that it enters.
    pub sides: u32,
}

/// A block of G, row by row.
pub struct BlockSide {
    /// Place of its first entry among the values of G.
    pub entries: u32,
    /// Position of its first row among the unknowns that are left, and the number of its rows.
    pub position: u32,
    pub rows: u32,
    /// Sign of the identity that a lever begins with, see [`Lever`](super::super::Lever).
    pub sign: f64,
}

/// Bodies in sequence that are alike.
pub struct BodyRun {
    pub bodies: Range<usize>,
    /// Their blocks in [`Bodies::sides`], those of a body in the order of elimination of their rows.
    pub sides: Range<usize>,
    /// For each pair of blocks (l, k >= l) of a body the place where the product of k and l goes, in
    /// [`Bodies::targets`].
    pub targets: Range<usize>,
    /// Number of coordinates of a body.
    pub width: usize,
    /// True if all blocks are levers.
    pub are_levers: bool,
}

#[derive(Default)]
pub struct Bodies {
    pub all: Vec<Body>,
    pub sides: Vec<BlockSide>,
    pub targets: Vec<u32>,
    pub runs: Vec<BodyRun>,
    /// Entries of M of bodies where it is diagonal, with their coordinates, and the bodies where it is not.
    pub masses: Vec<(usize, usize)>,
    pub dense: Vec<DenseBody>,
}

/// The entries of a body.
#[derive(Clone, Default)]
pub struct Entries {
    /// Those of M.
    pub mass: Vec<usize>,
    /// Blocks of G: groups of rows with the places of their first entries.
    pub sides: Vec<(usize, usize)>,
}

/// The entries of the groups of coordinates that are bodies, none for the others.
pub fn find(mass: &Pattern, g: &Pattern, groups: &Groups) -> Vec<Option<Entries>> {
    let (of_coordinate, of_row) = groups.numbers();
    let mut are_bodies: Vec<bool> = groups.late.iter().map(|late| !late).collect();
    let mut diagonals = vec![0; g.cols];
    let mut found = vec![Entries::default(); groups.coordinates.len()];
    for (entry, &(i, j)) in mass.entries.iter().enumerate() {
        found[of_coordinate[i]].mass.push(entry);
        diagonals[i] += usize::from(i == j);
        let is_inside = of_coordinate[i] == of_coordinate[j];
        are_bodies[of_coordinate[i]] &= is_inside;
        are_bodies[of_coordinate[j]] &= is_inside;
    }
    for ((group, found), is_body) in groups.coordinates.iter().zip(&found).zip(&mut are_bodies) {
        // A mass matrix that is full, of flexible bodies, costs less as a column.
        *is_body &= is_sequence(group) && found.mass.len() <= 2 * group.len();
        *is_body &= group.iter().all(|&i| diagonals[i] == 1);
    }
    let mut blocks: BTreeMap<(usize, usize), Vec<usize>> = BTreeMap::new();
    for (entry, &(row, i)) in g.entries.iter().enumerate() {
        blocks.entry((of_coordinate[i], of_row[row])).or_default().push(entry);
    }
    for ((group, rows), entries) in blocks {
        let coordinates = &groups.coordinates[group];
        let rows_of = &groups.rows[rows];
        let places = rows_of.iter().flat_map(|&row| coordinates.iter().map(move |&i| (row, i)));
        are_bodies[group] &= is_sequence(&entries)
            && is_sequence(rows_of)
            && entries.len() == coordinates.len() * rows_of.len()
            && entries.iter().zip(places).all(|(&entry, place)| g.entries[entry] == place);
        found[group].sides.push((rows, entries[0]));
    }
    found.into_iter().zip(are_bodies).map(|(found, is_body)| is_body.then_some(found)).collect()
}

fn is_sequence(numbers: &[usize]) -> bool {
    numbers.windows(2).all(|pair| pair[1] == pair[0] + 1)
}

impl Bodies {
    /// Adds a body of `width` coordinates from `first` on with its entries of M, its blocks, and the place of each of
    /// their products.
    pub fn push(
        &mut self,
        first: usize,
        width: usize,
        mass: &[(usize, (usize, usize))],
        sides: Vec<BlockSide>,
        target: impl Fn(u32, u32) -> usize,
    ) {
        let starts = (self.all.len(), self.sides.len(), self.targets.len());
        for l in 0..sides.len() {
            self.targets.extend((l..sides.len()).map(|k| target(sides[k].position, sides[l].position) as u32));
        }
        let blocks = sides.iter().map(|side| side.entries as usize..(side.entries + side.rows * width as u32) as usize);
        let dense = DenseBody::new(first, width, mass, blocks.collect(), self.dense.last().map_or(0, DenseBody::end));
        // A point's rows, one for each translation: 2 of 3 coordinates in the plane, 3 of 6 in space.
        let translations = match width {
            3 => 2,
            6 => 3,
            _ => 0,
        };
        let are_levers = !sides.is_empty()
            && sides.iter().all(|side| side.sign != 0.0 && side.rows == translations)
            && dense.as_ref().is_none_or(|dense| dense.leaves_alone(translations as usize));
        match dense {
            Some(dense) => self.dense.push(dense),
            None => self.masses.extend(mass.iter().map(|&(entry, (i, _))| (entry, i))),
        }
        self.all.push(Body { first: first as u32, sides: sides.len() as u32 });
        self.sides.extend(sides);
        if self.runs.last().is_none_or(|run| (run.width, run.are_levers) != (width, are_levers)) {
            let bodies = starts.0..0;
            let sides = starts.1..0;
            let targets = starts.2..0;
            self.runs.push(BodyRun { bodies, sides, targets, width, are_levers });
        }
        if let Some(run) = self.runs.last_mut() {
            (run.bodies.end, run.sides.end, run.targets.end) = (self.all.len(), self.sides.len(), self.targets.len());
        }
    }

    /// Multiplications of the elimination.
    pub fn operations(&self) -> usize {
        let mut first = 0;
        let products = |run: &BodyRun| {
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
