//! Small changes of a state, and the names of their directions.

use super::Matrix;
use crate::system::MechanicalSystem;

/// Small changes of the state, one per column.
#[derive(Clone, Debug)]
pub struct Changes {
    /// Changes dq along the velocity directions, n_v x columns.
    pub q: Matrix,
    /// Changes dv of the velocities, n_v x columns.
    pub v: Matrix,
}

impl Changes {
    /// Changes without columns, for n velocities.
    pub fn none(n: usize) -> Self {
        Changes { q: Matrix::zeros(n, 0), v: Matrix::zeros(n, 0) }
    }

    /// A unit change of each direction of q, then of each of n of v; `moving` of them, the first, move q.
    pub fn all(n: usize, moving: usize) -> Self {
        let unit = Matrix::identity(n, n);
        let none = Matrix::zeros(n, n);
        let first = |matrix: &Matrix| matrix.columns(0, moving).clone_owned();
        Changes { q: beside(&first(&unit), &none), v: beside(&first(&none), &unit) }
    }
}

/// Returns [left right].
pub fn beside(left: &Matrix, right: &Matrix) -> Matrix {
    let mut both = left.clone().resize_horizontally(left.ncols() + right.ncols(), 0.0);
    both.columns_mut(left.ncols(), right.ncols()).copy_from(right);
    both
}

/// Returns dq along the velocity directions of a unit of each coordinate, n_v x n_q, by least squares: N dq = q - q0.
/// For quaternions this is right to first order.
pub fn directions_of(system: &dyn MechanicalSystem, q: &[f64]) -> Matrix {
    let n = system.dimensions();
    let mut all = Matrix::zeros(n.v, n.q);
    let mut unit = vec![0.0; n.v];
    let mut rate = vec![0.0; n.q];
    let own = n.q_without_turns();
    for j in 0..n.moving() {
        unit[j] = 1.0;
        system.rate(q, &unit, &mut rate);
        unit[j] = 0.0;
        // Columns of N are orthogonal to each other, but for angles that are counted over revolutions.
        let size: f64 = rate[..own].iter().map(|x| x * x).sum();
        rate[..own].iter().enumerate().for_each(|(k, x)| all[(j, k)] = x / size);
    }
    all
}

/// Names of the changes of q along each velocity direction that moves it, and of those of v.
pub(super) struct Directions {
    pub q: Vec<String>,
    pub v: Vec<String>,
}

/// Names the directions of a state. The change of q along a velocity is named after the coordinate whose rate it is;
/// where the velocity is an angular one, `rotor.wx`, after the rotation about that axis of the body, `rotor.rx`.
pub(super) fn directions(system: &dyn MechanicalSystem, q: &[f64]) -> Directions {
    let names = system.facts().names.clone();
    let mut unit = vec![0.0; names.v.len()];
    let mut rate = vec![0.0; names.q.len()];
    let moving = &names.v[..system.dimensions().moving()];
    let own = moving.iter().enumerate().map(|(direction, name)| {
        unit[direction] = 1.0;
        system.rate(q, &unit, &mut rate);
        unit[direction] = 0.0;
        let mut moved = (0..system.dimensions().q_without_turns()).filter(|&i| rate[i] != 0.0);
        match (moved.next(), moved.next()) {
            (Some(i), None) if rate[i] == 1.0 => names.q[i].clone(),
            _ => turn(name),
        }
    });
    Directions { q: own.collect(), v: names.v }
}

/// Returns the name of a rotation: `rotor.wx` -> `rotor.rx`; of another velocity: `NAME dt`.
fn turn(velocity: &str) -> String {
    match velocity.rsplit_once(".w") {
        Some((body, axis)) => format!("{body}.r{axis}"),
        None => format!("{velocity} dt"),
    }
}

impl Directions {
    /// Returns the names of q, then those of v.
    pub fn states(self) -> Vec<String> {
        self.q.into_iter().chain(self.v).collect()
    }
}
