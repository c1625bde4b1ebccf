//! Which unknowns and entries belong to which part.

use super::super::blocks::{Groups, Layout};
use super::super::order::{Left, order_before};
use super::super::{Lever, Pattern};
use super::division::{SEPARATOR, divide};
use crate::tolerances;
use std::sync::Arc;

/// The structure of the factors of a saddle-point matrix.
pub enum FactorPlan {
    Whole(Arc<Layout>),
    Parts(Arc<Division>),
}

/// A saddle-point matrix in parts.
pub struct Division {
    /// Number of coordinates.
    pub n: usize,
    pub parts: Vec<PartPlan>,
    /// Coordinates and rows, as the solution is put together from those of the parts.
    pub coordinates: Vec<PartRange>,
    pub rows: Vec<PartRange>,
}

/// One part: a saddle-point matrix of its own unknowns and, behind them, of those of the separator.
pub struct PartPlan {
    pub layout: Arc<Layout>,
    /// Its numbers among those of the whole matrix.
    pub mass: Places,
    pub g: Places,
    pub coordinates: Places,
    pub rows: Places,
}

/// Numbers that are copied from a long list to a short one.
pub struct Places {
    /// Place in the long list of each of the short one.
    pub of: Vec<usize>,
    /// First places in the long and in the short list, and number.
    pieces: Vec<(usize, usize, usize)>,
    /// Places in the short list of what is not copied.
    others: Vec<usize>,
}

impl Places {
    /// Those for which `is_copied` is true are copied.
    fn new(of: Vec<usize>, is_copied: impl Fn(usize) -> bool) -> Self {
        let mut pieces: Vec<(usize, usize, usize)> = Vec::new();
        for (to, &from) in of.iter().enumerate().filter(|(_, from)| is_copied(**from)) {
            match pieces.last_mut().filter(|(first, its, len)| (first + len, its + len) == (from, to)) {
                Some(last) => last.2 += 1,
                None => pieces.push((from, to, 1)),
            }
        }
        let others = (0..of.len()).filter(|&place| !is_copied(of[place])).collect();
        Places { of, pieces, others }
    }

    /// Copies from the long list to the short one, with zeros for what is not copied.
    pub fn read(&self, all: &[f64], own: &mut [f64]) {
        self.pieces.iter().for_each(|&(from, to, len)| own[to..][..len].copy_from_slice(&all[from..][..len]));
        self.others.iter().for_each(|&place| own[place] = 0.0);
    }
}

/// Numbers in sequence that one part has.
pub struct PartRange {
    /// First place in the whole list, and number.
    pub first: usize,
    pub len: usize,
    /// The part, and the first place in its list.
    pub part: usize,
    pub place: usize,
}

/// The pieces of a list that the parts have copies of.
fn pieces<'a>(parts: impl Iterator<Item = &'a Places>) -> Vec<PartRange> {
    let of_part = |(part, places): (usize, &'a Places)| {
        places.pieces.iter().map(move |&(first, place, len)| PartRange { first, len, part, place })
    };
    let mut pieces: Vec<PartRange> = parts.enumerate().flat_map(of_part).collect();
    pieces.sort_unstable_by_key(|piece| piece.first);
    pieces
}

impl FactorPlan {
    /// For M and G with these late coordinates; `levers` are blocks of G. Large systems are divided where that pays, by
    /// their structure alone.
    pub fn new(mass: &Pattern, g: &Pattern, late: &[bool], levers: &[Lever]) -> Self {
        let parts = (g.cols + g.rows) / tolerances::UNKNOWNS_OF_A_PART;
        let count = parts.min(tolerances::MOST_PARTS);
        let division = if count > 1 { Division::new(mass, g, late, levers, count) } else { None };
        match division {
            Some(division) => FactorPlan::Parts(Arc::new(division)),
            None => FactorPlan::Whole(Arc::new(Layout::new(mass, g, late, levers))),
        }
    }

    /// Number of entries of L, of multiplications of a factorization, and of products of blocks.
    pub fn sizes(&self) -> [usize; 3] {
        let layouts: Vec<&Layout> = match self {
            FactorPlan::Whole(layout) => vec![layout],
            FactorPlan::Parts(division) => division.parts.iter().map(|part| &*part.layout).collect(),
        };
        let sum = |size: fn(&Layout) -> usize| layouts.iter().map(|layout| size(layout)).sum();
        [sum(|layout| layout.len), sum(Layout::operations), sum(|layout| layout.targets.len())]
    }
}

impl Division {
    /// Into this number of parts at most; `None` if even two have too much in common.
    pub fn new(mass: &Pattern, g: &Pattern, late: &[bool], levers: &[Lever], most: usize) -> Option<Self> {
        let whole = Whole::new(mass, g, late, most)?;
        let parts: Vec<_> = (0..whole.parts as u32).map(|part| whole.part(mass, g, late, levers, part)).collect();
        Some(Division {
            n: g.cols,
            coordinates: pieces(parts.iter().map(|part| &part.coordinates)),
            rows: pieces(parts.iter().map(|part| &part.rows)),
            parts,
        })
    }

    /// Coordinate i, or n + row, that is this node of a part.
    pub fn node(&self, part: usize, own: usize) -> usize {
        let PartPlan { coordinates, rows, .. } = &self.parts[part];
        let count = coordinates.of.len();
        if own < count { coordinates.of[own] } else { self.n + rows.of[own - count] }
    }
}

/// The groups of unknowns of the whole matrix.
struct Whole {
    groups: Groups,
    /// Part of each group of coordinates, and then of rows.
    of_group: Vec<u32>,
    /// Part of each coordinate, and of each row.
    of_coordinate: Vec<u32>,
    of_row: Vec<u32>,
    /// Groups of the separator in the order of their elimination.
    separator: Vec<usize>,
    /// Number of parts.
    parts: usize,
}

impl Whole {
    fn new(mass: &Pattern, g: &Pattern, late: &[bool], most: usize) -> Option<Self> {
        let groups = Groups::new(mass, g, late);
        let (of_group, parts) = of_groups(&groups, most)?;
        let count = groups.coordinates.len();
        let spread = |groups: &[Vec<usize>], of: &[u32], len: usize| {
            let mut of_member = vec![0; len];
            groups.iter().zip(of).for_each(|(group, part)| group.iter().for_each(|&member| of_member[member] = *part));
            of_member
        };
        let (of_coordinate, of_row) =
            (spread(&groups.coordinates, &of_group[..count], g.cols), spread(&groups.rows, &of_group[count..], g.rows));
        // Coordinates of the separator are late: behind their multipliers.
        let order = (count..of_group.len()).chain(0..count);
        let separator = order.filter(|&group| of_group[group] == SEPARATOR).collect();
        Some(Whole { groups, of_group, of_coordinate, of_row, separator, parts })
    }

    fn part(&self, mass: &Pattern, g: &Pattern, late: &[bool], levers: &[Lever], part: u32) -> PartPlan {
        let members = |of: &[u32]| (0..of.len()).filter(|&k| [part, SEPARATOR].contains(&of[k])).collect::<Vec<_>>();
        let coordinates = members(&self.of_coordinate);
        let rows = members(&self.of_row);
        let place_of_coordinate = places(&coordinates, g.cols);
        let place_of_row = places(&rows, g.rows);
        // What belongs to the separator alone is in the first part.
        let is_own = |a: u32, b: u32| a.min(b) == part || part == 0 && a.min(b) == SEPARATOR;
        let entries = |pattern: &Pattern, of: &[u32]| -> Vec<usize> {
            let entries = pattern.entries.iter().enumerate();
            entries.filter(|(_, (a, b))| is_own(of[*a], self.of_coordinate[*b])).map(|(k, _)| k).collect()
        };
        let of_mass = entries(mass, &self.of_coordinate);
        let of_g = entries(g, &self.of_row);
        let pattern = |all: &Pattern, own: &[usize], place: &[usize], rows: usize| Pattern {
            rows,
            cols: coordinates.len(),
            entries: own.iter().map(|&k| all.entries[k]).map(|(a, b)| (place[a], place_of_coordinate[b])).collect(),
        };
        let own_mass = pattern(mass, &of_mass, &place_of_coordinate, coordinates.len());
        let own_g = pattern(g, &of_g, &place_of_row, rows.len());
        let own_late: Vec<bool> = coordinates.iter().map(|&i| late[i]).collect();
        let place_of_entry = places(&of_g, g.entries.len());
        let own_levers = levers.iter().filter(|lever| place_of_entry[lever.first_entry] != usize::MAX);
        let own_levers: Vec<Lever> =
            own_levers.map(|lever| Lever { first_entry: place_of_entry[lever.first_entry], ..*lever }).collect();
        let coordinate_groups = self.members(&self.groups.coordinates, 0, &place_of_coordinate, part);
        let row_groups = self.members(&self.groups.rows, self.groups.coordinates.len(), &place_of_row, part);
        let groups = Groups::of(&own_mass, &own_g, coordinate_groups, row_groups, &own_late);
        let layout = self.layout(&own_mass, &own_g, &groups, &own_late, &own_levers, part);
        let is_known = |of: &[u32], k: usize| of[k] == part || part == 0;
        PartPlan {
            layout: Arc::new(layout),
            mass: Places::new(of_mass, |_| true),
            g: Places::new(of_g, |_| true),
            coordinates: Places::new(coordinates, |i| is_known(&self.of_coordinate, i)),
            rows: Places::new(rows, |row| is_known(&self.of_row, row)),
        }
    }

    /// True if a group is one of the part, or of the separator.
    fn is_in(&self, group: usize, part: u32) -> bool {
        [part, SEPARATOR].contains(&self.of_group[group])
    }

    /// Those of `groups`, of which the first has the number `first`, that are in a part, by their places in it.
    fn members(&self, groups: &[Vec<usize>], first: usize, place: &[usize], part: u32) -> Vec<Vec<usize>> {
        let own = groups.iter().enumerate().filter(|(k, _)| self.is_in(first + k, part));
        own.map(|(_, group)| group.iter().map(|&member| place[member]).collect()).collect()
    }

    /// The layout of a part with its groups, the separator behind.
    fn layout(
        &self,
        mass: &Pattern,
        g: &Pattern,
        groups: &Groups,
        late: &[bool],
        levers: &[Lever],
        part: u32,
    ) -> Layout {
        let of_coordinates = groups.coordinates.len();
        let members: Vec<usize> = (0..self.of_group.len()).filter(|&group| self.is_in(group, part)).collect();
        let place_of_group = places(&members, self.of_group.len());
        let last: Vec<usize> = self.separator.iter().map(|&group| place_of_group[group]).collect();
        let nodes = last.iter().flat_map(|&group| {
            if group < of_coordinates {
                groups.coordinates[group].clone()
            } else {
                groups.rows[group - of_coordinates].iter().map(|row| g.cols + row).collect()
            }
        });
        let nodes: Vec<usize> = nodes.collect();
        let mut order = groups.in_order(&order_before(mass, g, late, &nodes));
        order.retain(|group| !last.contains(group));
        Layout::of(mass, g, groups, order, &last, levers)
    }
}

/// The place of each of `len` numbers in a list, `usize::MAX` if it is not there.
fn places(list: &[usize], len: usize) -> Vec<usize> {
    let mut places = vec![usize::MAX; len];
    list.iter().enumerate().for_each(|(place, &number)| places[number] = place);
    places
}

/// The part of each group of coordinates and then of rows, and the number of parts; `None` if the separator is too
/// large even of two.
fn of_groups(groups: &Groups, most: usize) -> Option<(Vec<u32>, usize)> {
    let left = Left::new(&groups.mass, &groups.g, &groups.late);
    let count = groups.coordinates.len();
    let rest = left.rest();
    let total = count + groups.rows.len();
    let place = places(rest, total);
    let mut neighbours = vec![Vec::new(); rest.len()];
    for (a, b) in left.edges(&groups.mass, &groups.g) {
        let a = place[a];
        let b = place[b];
        if a != usize::MAX && b != usize::MAX && a != b {
            neighbours[a].push(b as u32);
            neighbours[b].push(a as u32);
        }
    }
    neighbours.iter_mut().for_each(|list| {
        list.sort_unstable();
        list.dedup();
    });
    let (division, parts) = divide(&neighbours, most, tolerances::LARGEST_SEPARATOR)?;
    let mut of_group = vec![SEPARATOR; total];
    rest.iter().zip(division).for_each(|(&group, part)| of_group[group] = part);
    // A late coordinate comes behind all its multipliers.
    for &(row, i) in groups.g.entries.iter().filter(|(_, i)| groups.late[*i]) {
        if of_group[count + row] == SEPARATOR {
            of_group[i] = SEPARATOR;
        }
    }
    // Early coordinates go with all that their elimination couples, in one part and the separator.
    for (k, column) in left.columns.iter().enumerate().rev() {
        let coupled = column.iter().map(|&position| of_group[left.all[position as usize]]).min();
        let anywhere = (k * parts / left.early) as u32;
        of_group[left.all[k]] = coupled.filter(|part| *part != SEPARATOR).unwrap_or(anywhere);
    }
    Some((of_group, parts))
}
