//! Groups of unknowns that are eliminated together, as one block.
//!
//! A body's coordinates enter the same rows of G, a joint's rows have the same coordinates: their entries fill whole
//! blocks, whose products need no index for each number. Any partition is right; this one has the fewest zeros.

use super::super::Pattern;
use std::collections::BTreeMap;

/// The most unknowns in a group.
pub const LARGEST: usize = 8;

/// Groups of coordinates and of rows of G, each a list of unknowns in increasing order, with the patterns of M and G
/// over the groups.
pub struct Groups {
    pub coordinates: Vec<Vec<usize>>,
    pub rows: Vec<Vec<usize>>,
    pub late: Vec<bool>,
    pub mass: Pattern,
    pub g: Pattern,
}

impl Groups {
    pub fn new(mass: &Pattern, g: &Pattern, late: &[bool]) -> Self {
        let coordinates = coordinates(mass, g, late);
        let columns = neighbours(g.rows, g.entries.iter().copied());
        let rows = alike((0..g.rows).collect(), |row| &columns[row]);
        Self::of(mass, g, coordinates, rows, late)
    }

    /// With a partition of the coordinates and of the rows that is given.
    pub fn of(mass: &Pattern, g: &Pattern, coordinates: Vec<Vec<usize>>, rows: Vec<Vec<usize>>, late: &[bool]) -> Self {
        let of_coordinate = numbers(&coordinates, g.cols);
        let of_row = numbers(&rows, g.rows);
        let pattern = |rows: usize, entries: Vec<(usize, usize)>| Pattern {
            rows,
            cols: coordinates.len(),
            entries: sorted(entries),
        };
        let order = |(a, b): (usize, usize)| (a.max(b), a.min(b));
        let coupled = mass.entries.iter().map(|&(i, j)| order((of_coordinate[i], of_coordinate[j])));
        let entered = g.entries.iter().map(|&(row, i)| (of_row[row], of_coordinate[i]));
        Groups {
            late: coordinates.iter().map(|group| late[group[0]]).collect(),
            mass: pattern(coordinates.len(), coupled.collect()),
            g: pattern(rows.len(), entered.collect()),
            coordinates,
            rows,
        }
    }
    /// The groups (those of coordinates first) in an order of elimination of single unknowns: where their first unknown
    /// is, but those of late coordinates where their last is, behind all their multipliers.
    pub fn in_order(&self, nodes: &[usize]) -> Vec<usize> {
        let (of_coordinate, of_row) = self.numbers();
        let count = self.coordinates.len();
        let n = of_coordinate.len();
        let mut members = vec![0; count + self.rows.len()];
        let mut order = Vec::with_capacity(members.len());
        for &node in nodes {
            let group = if node < n { of_coordinate[node] } else { count + of_row[node - n] };
            members[group] += 1;
            let is_late = group < count && self.late[group];
            if members[group] == if is_late { self.coordinates[group].len() } else { 1 } {
                order.push(group);
            }
        }
        order
    }

    /// The group of each coordinate and of each row of G.
    pub fn numbers(&self) -> (Vec<usize>, Vec<usize>) {
        let count = |groups: &[Vec<usize>]| groups.iter().map(Vec::len).sum();
        (numbers(&self.coordinates, count(&self.coordinates)), numbers(&self.rows, count(&self.rows)))
    }
}

/// Coordinates in the same rows of G, coupled by M to the same others outside their group; large groups, such as the
/// inner nodes of a mesh, only where they are coupled to the same among themselves, too.
fn coordinates(mass: &Pattern, g: &Pattern, late: &[bool]) -> Vec<Vec<usize>> {
    let rows = neighbours(g.cols, g.entries.iter().map(|&(row, i)| (i, row)));
    let coupled = neighbours(g.cols, mass.entries.iter().flat_map(|&(i, j)| [(i, j), (j, i), (i, i), (j, j)]));
    let entered = by_key((0..g.cols).collect(), |i| (late[i], &rows[i]));
    let class = numbers(&entered, g.cols);
    let outside: Vec<Vec<usize>> =
        (0..g.cols).map(|i| coupled[i].iter().copied().filter(|&j| class[j] != class[i]).collect()).collect();
    let parts = entered.into_iter().flat_map(|members| by_key(members, |i| &outside[i]));
    let mut groups: Vec<Vec<usize>> =
        parts.flat_map(|part| if part.len() > LARGEST { alike(part, |i| &coupled[i]) } else { vec![part] }).collect();
    groups.sort_unstable();
    groups
}

/// Members with equal keys, at most [`LARGEST`] together, by their first members.
fn alike<K: Ord>(members: Vec<usize>, key: impl Fn(usize) -> K) -> Vec<Vec<usize>> {
    let groups = by_key(members, key).into_iter();
    let mut parts: Vec<Vec<usize>> =
        groups.flat_map(|group| group.chunks(LARGEST).map(<[usize]>::to_vec).collect::<Vec<_>>()).collect();
    parts.sort_unstable();
    parts
}

fn by_key<K: Ord>(members: Vec<usize>, key: impl Fn(usize) -> K) -> Vec<Vec<usize>> {
    let mut groups: BTreeMap<K, Vec<usize>> = BTreeMap::new();
    members.into_iter().for_each(|member| groups.entry(key(member)).or_default().push(member));
    groups.into_values().collect()
}

/// The sorted second numbers of the pairs with each first one.
fn neighbours(count: usize, pairs: impl Iterator<Item = (usize, usize)>) -> Vec<Vec<usize>> {
    let mut lists = vec![Vec::new(); count];
    pairs.for_each(|(a, b)| lists[a].push(b));
    lists.into_iter().map(sorted).collect()
}

fn sorted<T: Ord>(mut list: Vec<T>) -> Vec<T> {
    list.sort_unstable();
    list.dedup();
    list
}

/// The group of each member.
fn numbers(groups: &[Vec<usize>], count: usize) -> Vec<usize> {
    let mut numbers = vec![0; count];
    for (k, group) in groups.iter().enumerate() {
        group.iter().for_each(|&member| numbers[member] = k);
    }
    numbers
}
