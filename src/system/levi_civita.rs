//! The mass metric along a motion.

use super::terms::OperatingPoint;
use crate::body::{cross, dot};
use crate::math::array::from_fn;
use crate::scene::Part;
use nalgebra::DMatrix;

/// The Levi-Civita connection of the kinetic energy along a motion, dense n_v x n_v: the covariant derivative of a
/// field of directions x is x' + M^-1 W x, where in coordinates (N = I)
///
/// ```text
/// W_ij = 1/2 (v^k d_k M_ij + v^k d_j M_ik - v^k d_i M_jk)
/// ```
///
/// and in general W = 1/2 dh/dv + 1/2 M [v, .] with h(q, v) the inertia forces at v' = 0.
#[derive(Clone, Debug, PartialEq)]
pub struct LeviCivita {
    /// W, n_v x n_v.
    pub w: DMatrix<f64>,
    /// dW/dt along the motion.
    pub w_dot: DMatrix<f64>,
    /// dM/dt along the motion.
    pub mass_dot: DMatrix<f64>,
}

impl LeviCivita {
    /// All zero, for n velocities.
    pub fn new(n: usize) -> Self {
        let zero = DMatrix::zeros(n, n);
        LeviCivita { w: zero.clone(), w_dot: zero.clone(), mass_dot: zero }
    }

    /// Sets all matrices to zero.
    pub fn clear(&mut self) {
        [&mut self.w, &mut self.w_dot, &mut self.mass_dot]
            .into_iter()
            .for_each(|matrix| matrix.as_mut_slice().fill(0.0));
    }

    /// A body with constant M. Where N = I nothing changes along the motion; else h = w x J w of the angular velocity w
    /// in the body's axes, and W x = (x x J w + w x J x + J (w x x))/2.
    pub(super) fn add_constant_mass<const D: usize>(&mut self, part: &Part<D>, at: &OperatingPoint) {
        let Some(first) = part.facts.turning else { return };
        let inertia = inertia(part, part.coordinates(at.q), first);
        let momentum = |w: &[f64; 3]| -> [f64; 3] { from_fn(|i| dot(&inertia[i], w)) };
        for (target, v) in [(&mut self.w, at.v), (&mut self.w_dot, at.vdot)] {
            let w: [f64; 3] = from_fn(|i| v[part.first_v + first + i]);
            for j in 0..3 {
                let unit = from_fn(|i| f64::from(u8::from(i == j)));
                let turned = cross(&unit, &momentum(&w));
                let changed = cross(&w, &momentum(&unit));
                let back = momentum(&cross(&w, &unit));
                let place = part.first_v + first;
                (0..3).for_each(|i| target[(place + i, place + j)] += 0.5 * (turned[i] + changed[i] + back[i]));
            }
        }
    }
}

/// The block of M that belongs to the angular velocity, whose first component has this index.
fn inertia<const D: usize>(part: &Part<D>, q: &[f64], first: usize) -> [[f64; 3]; 3] {
    let places = &part.facts.mass_pattern;
    let mut values = vec![0.0; places.len()];
    part.body.mass(q, &mut values);
    let mut inertia = [[0.0; 3]; 3];
    for (&(i, j), value) in places.iter().zip(values).filter(|((i, j), _)| *i >= first && *j >= first) {
        (inertia[i - first][j - first], inertia[j - first][i - first]) = (value, value);
    }
    inertia
}
