//! The mass metric along a motion.

use super::mechanism::of;
use super::tangent::OperatingPoint;
use crate::body::{BodyState, cross};
use crate::scene::Part;
use nalgebra::DMatrix;
use std::array::from_fn;

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
        [&mut self.w, &mut self.w_dot, &mut self.mass_dot].into_iter().for_each(|matrix| matrix.fill(0.0));
    }

    /// A body with constant M: h depends on v alone, and dh/dv is linear in it.
    pub(super) fn add_constant_mass<const D: usize>(&mut self, part: &Part<D>, at: &OperatingPoint) {
        let q = of(at.q, part, true);
        let mass = own_mass(part, q);
        for (target, v) in [(&mut self.w, at.v), (&mut self.w_dot, at.vdot)] {
            let v = of(v, part, false);
            let slope = velocity_slope(part, q, v) - velocity_slope(part, q, &vec![0.0; v.len()]);
            let half = (slope + &mass * bracket(part, v)) * 0.5;
            let mut block = target.view_mut((part.first_v, part.first_v), half.shape());
            block += half;
        }
    }
}

fn own_mass<const D: usize>(part: &Part<D>, q: &[f64]) -> DMatrix<f64> {
    let places = part.body.mass_pattern();
    let mut values = vec![0.0; places.len()];
    part.body.mass(q, &mut values);
    let mut mass = DMatrix::zeros(part.nv, part.nv);
    for (&(i, j), value) in places.iter().zip(values) {
        (mass[(i, j)], mass[(j, i)]) = (value, value);
    }
    mass
}

/// -df/dv of the body's own forces.
fn velocity_slope<const D: usize>(part: &Part<D>, q: &[f64], v: &[f64]) -> DMatrix<f64> {
    let places = part.body.tangent_pattern();
    let (mut k, mut c) = (vec![0.0; places.len()], vec![0.0; places.len()]);
    let rest = vec![0.0; v.len()];
    part.body.tangent(BodyState { q, v, vdot: &rest, gravity: &[0.0; D] }, &mut k, &mut c);
    let mut slope = DMatrix::zeros(part.nv, part.nv);
    places.iter().zip(c).for_each(|(&place, value)| slope[place] += value);
    slope
}

/// The matrix of [v, .].
fn bracket<const D: usize>(part: &Part<D>, v: &[f64]) -> DMatrix<f64> {
    let mut matrix = DMatrix::zeros(part.nv, part.nv);
    if let Some(first) = part.body.turning() {
        let w: [f64; 3] = from_fn(|i| v[first + i]);
        for j in 0..3 {
            let unit: [f64; 3] = from_fn(|i| f64::from(u8::from(i == j)));
            let column = cross(&w, &unit);
            (0..3).for_each(|i| matrix[(first + i, first + j)] = column[i]);
        }
    }
    matrix
}
