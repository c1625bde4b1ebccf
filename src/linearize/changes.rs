//! Small changes of a state, and the names of their directions.

use super::Matrix;
use crate::system::MechanicalSystem;

/// Changes of the state, a column each.
#[derive(Clone, Debug)]
pub struct Changes {
    /// LociVariable the velocity directions.
    pub q: Matrix,
    pub v: Matrix,
}

impl Changes {
    /// Of no column.
    pub fn none(n: usize) -> Self {
        Changes { q: Matrix::zeros(n, 0), v: Matrix::zeros(n, 0) }
    }

    /// Each direction of q, then each of v.
    pub fn all(n: usize) -> Self {
        let (unit, none) = (Matrix::identity(n, n), Matrix::zeros(n, n));
        Changes { q: beside([&unit, &none]), v: beside([&none, &unit]) }
    }
}

/// [left right]
pub(super) fn beside([left, right]: [&Matrix; 2]) -> Matrix {
    let mut both = left.clone().resize_horizontally(left.ncols() + right.ncols(), 0.0);
    both.columns_mut(left.ncols(), right.ncols()).copy_from(right);
    both
}

/// Names of changes of q along each velocity direction, and of changes of v.
pub(super) struct Directions {
    pub q: Vec<String>,
    pub v: Vec<String>,
}

/// A direction is a coordinate where q' is that velocity; a turn about an axis of the body, such as `rotor.rx`, where the
/// velocity is an angular one, `rotor.wx`.
pub(super) fn directions(system: &dyn MechanicalSystem, q: &[f64]) -> Directions {
    let names = system.names();
    let (mut unit, mut rate) = (vec![0.0; names.v.len()], vec![0.0; names.q.len()]);
    let own = names.v.iter().enumerate().map(|(direction, name)| {
        unit[direction] = 1.0;
        system.rate(q, &unit, &mut rate);
        unit[direction] = 0.0;
        let mut moved = (0..rate.len() - system.turning_angles()).filter(|&i| rate[i] != 0.0);
        match (moved.next(), moved.next()) {
            (Some(i), None) if rate[i] == 1.0 => names.q[i].clone(),
            _ => turn(name),
        }
    });
    Directions { q: own.collect(), v: names.v }
}

/// `rotor.wx` -> `rotor.rx`
fn turn(velocity: &str) -> String {
    match velocity.rsplit_once(".w") {
        Some((body, axis)) => format!("{body}.r{axis}"),
        None => format!("{velocity} dt"),
    }
}

impl Directions {
    /// Those of q, then those of v.
    pub fn states(self) -> Vec<String> {
        self.q.into_iter().chain(self.v).collect()
    }
}
