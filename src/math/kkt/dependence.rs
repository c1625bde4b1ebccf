//! Linearly dependent rows of a matrix.

use super::Pattern;
use crate::math::{add_scaled, dot, norm};
use crate::tolerances;

/// The rank of a matrix, and its dependent rows.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Dependence {
    /// Number of independent rows.
    pub rank: usize,
    /// Dependent rows, in increasing order.
    pub rows: Vec<DependentRow>,
}

/// A dependent row as a sum of coefficient times row over `combination`, all of them earlier and independent rows.
/// The combination is empty for a row of zeros.
#[derive(Clone, Debug, PartialEq)]
pub struct DependentRow {
    /// Index of the dependent row.
    pub row: usize,
    /// Pairs (row, coefficient).
    pub combination: Vec<(usize, f64)>,
}

/// Finds rows whose part orthogonal to the rows before them is below `tolerance` after scaling to unit length.
/// By Gram-Schmidt, repeated where it cancels; columns that two rows do not share cost nothing. At most 2 m^2 n
/// operations. A row with a value that is not finite counts as independent and is not used.
pub fn dependent_rows(g: &Pattern, values: &[f64], tolerance: f64) -> Dependence {
    let mut rows = vec![vec![0.0; g.cols]; g.rows];
    for (&(i, j), value) in g.entries.iter().zip(values) {
        rows[i][j] += value;
    }
    let mut basis = Basis { members: Vec::new() };
    let mut result = Dependence::default();
    for (row, v) in rows.into_iter().enumerate() {
        let length = norm(&v);
        if length == 0.0 {
            result.rows.push(DependentRow { row, combination: vec![] });
        } else if !length.is_finite() {
            result.rank += 1;
        } else if let Some(combination) = basis.take(row, v, length, tolerance) {
            result.rows.push(DependentRow { row, combination });
        } else {
            result.rank += 1;
        }
    }
    result
}

/// The independent rows so far, as an orthonormal basis with the triangular factor: row_k / length_k = R^T q.
struct Basis {
    members: Vec<Member>,
}

struct Member {
    row: usize,
    length: f64,
    /// Unit direction, from its first to its last nonzero.
    direction: Vec<f64>,
    first: usize,
    /// Components of the unit row along earlier directions; `left` is that along its own.
    along: Vec<f64>,
    left: f64,
}

impl Basis {
    /// Adds an independent row to the basis, or returns the combination of a dependent one.
    fn take(&mut self, row: usize, mut v: Vec<f64>, length: f64, tolerance: f64) -> Option<Vec<(usize, f64)>> {
        v.iter_mut().for_each(|x| *x /= length);
        let mut along = vec![0.0; self.members.len()];
        let mut left = 1.0;
        for _ in 0..3 {
            let before = left;
            self.subtract(&mut v, &mut along);
            left = norm(&v);
            if left > 0.5 * before {
                break;
            }
        }
        if left < tolerance {
            return Some(self.combination(along, length));
        }
        let first = v.iter().position(|x| *x != 0.0).unwrap_or(0);
        let end = v.iter().rposition(|x| *x != 0.0).map_or(0, |last| last + 1);
        let direction = v[first.min(end)..end].iter().map(|x| x / left).collect();
        self.members.push(Member { row, length, direction, first, along, left });
        None
    }

    fn subtract(&self, v: &mut [f64], along: &mut [f64]) {
        for (member, along) in self.members.iter().zip(along) {
            let part = &mut v[member.first..][..member.direction.len()];
            let h = dot(&member.direction, part);
            if h != 0.0 {
                add_scaled(-h, &member.direction, part);
                *along += h;
            }
        }
    }

    /// Solves R c = along.
    fn combination(&self, mut along: Vec<f64>, length: f64) -> Vec<(usize, f64)> {
        let mut combination = Vec::new();
        for (k, member) in self.members.iter().enumerate().rev() {
            let c = along[k] / member.left;
            if c != 0.0 {
                add_scaled(-c, &member.along, &mut along[..k]);
            }
            if c.abs() > tolerances::ROOT_OF_ROUND_OFF {
                combination.push((member.row, c * length / member.length));
            }
        }
        combination.reverse();
        combination
    }
}
