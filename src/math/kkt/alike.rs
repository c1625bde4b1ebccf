//! Rows of G over the same coordinates: copies of one joint, or more joints between two bodies than these can move.

use super::Pattern;
use super::orthonormal::orthogonalize;
use crate::math::norm;
use std::collections::HashMap;

/// Groups of rows over the same coordinates. Finding dependent rows in a group costs rows x coordinates^2 without fill,
/// while a sparse factorization would couple all rows of a group.
pub struct Alike {
    groups: Vec<RowGroup>,
    /// Scratch: orthonormal rows, one after the other, and a row.
    basis: Vec<f64>,
    row: Vec<f64>,
    dependent: Vec<usize>,
}

struct RowGroup {
    columns: usize,
    rows: Vec<GroupRow>,
}

struct GroupRow {
    number: usize,
    /// Entries of G, each with its column within the group.
    entries: Vec<(usize, usize)>,
}

impl Alike {
    pub fn new(g: &Pattern) -> Self {
        let mut rows = vec![Vec::new(); g.rows];
        g.entries.iter().enumerate().for_each(|(entry, (row, column))| rows[*row].push((entry, *column)));
        let mut places = HashMap::new();
        let mut groups: Vec<RowGroup> = Vec::new();
        for (number, mut entries) in rows.into_iter().enumerate() {
            let mut columns: Vec<usize> = entries.iter().map(|(_, column)| *column).collect();
            columns.sort_unstable();
            columns.dedup();
            entries.iter_mut().for_each(|(_, column)| *column = columns.partition_point(|known| known < column));
            let width = columns.len();
            let place = *places.entry(columns).or_insert(groups.len());
            if place == groups.len() {
                groups.push(RowGroup { columns: width, rows: Vec::new() });
            }
            groups[place].rows.push(GroupRow { number, entries });
        }
        groups.retain(|group| group.rows.len() > 1);
        let most = |size: fn(&RowGroup) -> usize| groups.iter().map(size).max().unwrap_or(0);
        Alike {
            basis: Vec::with_capacity(most(|group| group.columns * group.columns.min(group.rows.len()))),
            row: Vec::with_capacity(most(|group| group.columns)),
            dependent: Vec::with_capacity(groups.iter().map(|group| group.rows.len()).sum()),
            groups,
        }
    }

    /// True if a group has more rows than coordinates, so that some always depend on others.
    pub fn is_crowded(&self) -> bool {
        self.groups.iter().any(|group| group.rows.len() > group.columns)
    }

    /// Rows, in order, whose part orthogonal to earlier rows of their group is below `tolerance` after scaling to
    /// unit length.
    pub fn dependent(&mut self, values: &[f64], tolerance: f64) -> &[usize] {
        self.dependent.clear();
        for group in &self.groups {
            self.basis.clear();
            for row in &group.rows {
                self.row.clear();
                self.row.resize(group.columns, 0.0);
                row.entries.iter().for_each(|&(entry, column)| self.row[column] += values[entry]);
                let length = norm(&self.row);
                self.row.iter_mut().for_each(|x| *x /= length);
                let left = orthogonalize(&self.basis, &mut self.row);
                // Written so that the NaN of a row of zeros is dependent.
                if left > tolerance && self.basis.len() < group.columns * group.columns {
                    self.basis.extend(self.row.iter().map(|x| x / left));
                } else {
                    self.dependent.push(row.number);
                }
            }
        }
        self.dependent.sort_unstable();
        &self.dependent
    }
}
