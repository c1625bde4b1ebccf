//! N of q' = N(q) v, entry by entry.

use crate::system::{MechanicalSystem, Rotation};

/// The coordinates that each velocity moves: one coordinate at the same rate, or the four of a unit quaternion
/// p = [w, x, y, z] about an axis of the body:
///
/// ```text
/// p' = 1/2 p o (0, omega) = N(p) omega,   N^+ = 4 N^T/|p|^2
/// ```
///
/// Angles that count full turns follow from the others and have no entries.
pub struct Directions(Vec<Direction>);

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
    /// The directions of a system; `None` where coordinates are neither integrals of velocities nor unit quaternions.
    pub fn new(system: &dyn MechanicalSystem) -> Option<Self> {
        let (n, rotations) = (system.dimensions(), system.rotations());
        let own = n.q - system.turning_angles();
        let is_turned = |place: usize| rotations.iter().any(|rotation| (rotation.q..rotation.q + 4).contains(&place));
        let mut coordinates = (0..own).filter(|place| !is_turned(*place));
        let axis_of = |j: usize| rotations.iter().find(|Rotation { v, .. }| (*v..*v + 3).contains(&j));
        let mut directions = Vec::with_capacity(n.v);
        for j in 0..n.moving() {
            directions.push(match axis_of(j) {
                Some(rotation) => Direction::Axis { q: rotation.q, axis: j - rotation.v },
                None => Direction::Coordinate(coordinates.next()?),
            });
        }
        directions.resize_with(n.v, || Direction::None);
        coordinates.next().is_none().then_some(Directions(directions))
    }

    /// Sets the quaternions of `q` to one at which no entry of N^+ is infinite.
    pub fn unit(&self, q: &mut [f64]) {
        self.axes().for_each(|place| q[place] = 1.0);
    }

    /// First places of the quaternions.
    fn axes(&self) -> impl Iterator<Item = usize> {
        self.0.iter().filter_map(|direction| match direction {
            Direction::Axis { q, axis: 0 } => Some(*q),
            _ => None,
        })
    }

    /// Passes the entries of N(q) to `put`: coordinate, direction, value.
    pub fn rate(&self, q: &[f64], mut put: impl FnMut(usize, usize, f64)) {
        for (j, direction) in self.0.iter().enumerate() {
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
        for (j, direction) in self.0.iter().enumerate() {
            let Direction::Axis { q, axis } = *direction else { continue };
            for (row, entries) in TWICE_N.iter().enumerate() {
                let (sign, component) = entries[axis];
                put(q + row, q + component, 0.5 * sign * v[j]);
            }
        }
    }

    /// Passes a derivative along the direction `j` of v to `put` as derivatives with respect to coordinates, by N^+.
    pub fn along(&self, q: &[f64], j: usize, value: f64, mut put: impl FnMut(usize, f64)) {
        match self.0[j] {
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
