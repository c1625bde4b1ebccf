//! N of q' = N(q) v, entry by entry.

use crate::system::{Dimensions, MechanicalSystem, Rotation};
use nalgebra::DMatrix;

/// The coordinates that each velocity moves: one coordinate at the same rate, or the four of a unit quaternion
/// p = [w, x, y, z] about an axis of the body:
///
/// ```text
/// p' = 1/2 p o (0, omega) = N(p) omega,   N^+ = 4 N^T/|p|^2
/// ```
///
/// Angles that count full turns follow from the others and have no entries. Of own equations with another N, whose
/// derivative is not known, N itself is evaluated: Newton's method takes an iteration more.
pub struct Directions {
    of: Vec<Direction>,
    /// N and N^+ of other kinds.
    other: Option<[DMatrix<f64>; 2]>,
}

enum Direction {
    Coordinate(usize),
    Axis {
        /// First place of the quaternion.
        q: usize,
        axis: usize,
    },
    /// A state of a controller, which moves nothing.
    None,
}

/// Entries (sign, component of p) of the rows of 2 N(p).
const TWICE_N: [[(f64, usize); 3]; 4] = [
    [(-1.0, 1), (-1.0, 2), (-1.0, 3)],
    [(1.0, 0), (-1.0, 3), (1.0, 2)],
    [(1.0, 3), (1.0, 0), (-1.0, 1)],
    [(-1.0, 2), (1.0, 1), (1.0, 0)],
];

impl Directions {
    /// The directions of a system.
    pub fn new(system: &dyn MechanicalSystem) -> Self {
        let n = system.dimensions();
        let rotations = system.facts().rotations.clone();
        match of_bodies(n, n.q_without_turns(), &rotations) {
            Some(of) => Directions { of, other: None },
            None => {
                let rows = n.q;
                let columns = n.moving();
                let other = Some([DMatrix::zeros(rows, columns), DMatrix::zeros(columns, rows)]);
                Directions { of: Vec::new(), other }
            }
        }
    }

    /// Evaluates N of other kinds.
    pub fn update(&mut self, system: &dyn MechanicalSystem, q: &[f64]) {
        let Some([rate, inverse]) = &mut self.other else { return };
        let mut v = vec![0.0; system.dimensions().v];
        for (j, mut column) in rate.column_iter_mut().enumerate() {
            v[j] = 1.0;
            system.rate(q, &v, column.as_mut_slice());
            v[j] = 0.0;
        }
        *inverse =
            (rate.transpose() * &*rate).try_inverse().map_or(inverse.clone(), |square| square * rate.transpose());
    }

    /// Passes the entries of N(q) to `put`: coordinate, direction, value.
    pub fn rate(&self, q: &[f64], mut put: impl FnMut(usize, usize, f64)) {
        if let Some([rate, _]) = &self.other {
            let places = (0..rate.ncols()).flat_map(|j| (0..rate.nrows()).map(move |row| (row, j)));
            places.for_each(|(row, j)| put(row, j, rate[(row, j)]));
        }
        for (j, direction) in self.of.iter().enumerate() {
            match *direction {
                Direction::Coordinate(place) => put(place, j, 1.0),
                Direction::Axis { q: first, axis } => {
                    for (row, entries) in TWICE_N.iter().enumerate() {
                        let (sign, component) = entries[axis];
                        put(first + row, j, 0.5 * sign * q[first + component]);
                    }
                }
                Direction::None => {}
            }
        }
    }

    /// Passes the entries of d(N(q) v)/dq at fixed v to `put`: coordinate, coordinate, value.
    pub fn rate_gradient(&self, v: &[f64], mut put: impl FnMut(usize, usize, f64)) {
        for (j, direction) in self.of.iter().enumerate() {
            let Direction::Axis { q, axis } = *direction else { continue };
            for (row, entries) in TWICE_N.iter().enumerate() {
                let (sign, component) = entries[axis];
                put(q + row, q + component, 0.5 * sign * v[j]);
            }
        }
    }

    /// Passes a derivative along the direction `j` of v to `put` as derivatives with respect to coordinates, by N^+.
    pub fn along(&self, q: &[f64], j: usize, value: f64, mut put: impl FnMut(usize, f64)) {
        if let Some([_, inverse]) = &self.other {
            let row = (j < inverse.nrows()).then(|| inverse.row(j));
            row.iter().flat_map(|row| row.iter()).enumerate().for_each(|(col, part)| put(col, part * value));
            return;
        }
        match self.of[j] {
            Direction::Coordinate(place) => put(place, value),
            Direction::Axis { q: first, axis } => {
                let square: f64 = q[first..first + 4].iter().map(|p| p * p).sum();
                for (row, entries) in TWICE_N.iter().enumerate() {
                    let (sign, component) = entries[axis];
                    put(first + row, 2.0 * sign * q[first + component] / square * value);
                }
            }
            Direction::None => {}
        }
    }
}

/// The directions of coordinates whose rates are velocities, and of unit quaternions; `None` where there are others.
fn of_bodies(n: Dimensions, own: usize, rotations: &[Rotation]) -> Option<Vec<Direction>> {
    let is_turned = |place: usize| rotations.iter().any(|rotation| (rotation.q..rotation.q + 4).contains(&place));
    let axis_of = |j: usize| rotations.iter().find(|Rotation { v, .. }| (*v..*v + 3).contains(&j));
    let mut coordinates = (0..own).filter(|place| !is_turned(*place));
    let mut directions = Vec::with_capacity(n.v);
    for j in 0..n.moving() {
        directions.push(match axis_of(j) {
            Some(rotation) => Direction::Axis { q: rotation.q, axis: j - rotation.v },
            None => Direction::Coordinate(coordinates.next()?),
        });
    }
    directions.resize_with(n.v, || Direction::None);
    coordinates.next().is_none().then_some(directions)
}
