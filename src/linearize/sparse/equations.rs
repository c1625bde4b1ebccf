//! The frozen equations of a variation as one of second order.

use crate::formulation::degrees_of_freedom;
use crate::linearize::Variation;
use crate::math::kkt::Pattern;
use crate::modes::{Quadratic, Sparse};

/// The frozen index-3 pencil with dv = s p + [v, p] eliminated, in p = dq alone:
///
/// ```text
/// (s^2 M + s C + K) p + G^T dlambda = 0        C = C + M W
/// G p = 0                                      K = K + C W,   W = [v, .]
/// ```
///
/// with the K and C of a [`Variation`] on the right. W is exact; it is zero without rotations in space, and at rest.
/// Of a state xi p is dxi itself, of which the equations have no second derivative: its column of C is one of K, and
/// its 1 in M is one in C. So 2 (n - m) eigenvalues are finite, less one for each state xi, with m independent rows of
/// G.
///
/// Cost: linear in the entries of the matrices, and with moving rotations in space a bracket for each direction.
pub fn equations(variation: &Variation, turn: &Sparse) -> Quadratic {
    let structure = &variation.dynamics.structure;
    let terms = &variation.dynamics.terms;
    let part = |values: &[f64]| Sparse { pattern: Pattern::clone(&structure.tangent), values: values.to_vec() };
    let mut mass = Sparse::symmetric(&structure.mass, &terms.mass);
    let n = variation.system().dimensions();
    let k = part(&variation.tangent.k);
    let c = part(&variation.tangent.c);
    let mut stiffness = k.plus(c.times(turn));
    let mut damping = c.plus(mass.times(turn));
    damping.give(&mut stiffness, |_, j| j >= n.moving());
    mass.give(&mut damping, |_, j| j >= n.moving());
    Quadratic {
        stiffness,
        damping,
        g: Sparse { pattern: Pattern::clone(&structure.g), values: terms.g.clone() },
        finite: 2 * degrees_of_freedom(&variation.dynamics) - n.states,
        mass,
    }
}

/// Returns W, column by column, where the velocity of the state rotates anything.
pub fn turn(variation: &Variation) -> Sparse {
    let n = variation.velocities();
    let system = variation.system();
    let v = &variation.point.v;
    let mut turn = Sparse { pattern: Pattern { rows: n, cols: n, entries: Vec::new() }, values: Vec::new() };
    // Along no axis, so that every rotation shows.
    let any: Vec<f64> = (0..n).map(|i| (i as f64 + 1.0).sqrt()).collect();
    let mut out = vec![0.0; n];
    system.bracket(v, &any, &mut out);
    if out.iter().all(|x| *x == 0.0) {
        return turn;
    }
    let mut unit = vec![0.0; n];
    for j in 0..n {
        unit[j] = 1.0;
        system.bracket(v, &unit, &mut out);
        unit[j] = 0.0;
        for (i, value) in out.iter().enumerate().filter(|(_, value)| **value != 0.0) {
            turn.pattern.entries.push((i, j));
            turn.values.push(*value);
        }
    }
    turn
}
