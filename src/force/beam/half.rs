//! Weight and inertia of a beam's mass, added to the forces of its massless elements.

use crate::body::{Frame, cross};
use crate::math::array::{Each, from_fn};
use crate::math::screw::Vector;
use crate::math::{Scalar, Taylor};

/// Mass of half an element, as part of the rigid node at its end; zero for a massless beam.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Half {
    /// Mass, kg.
    pub mass: f64,
    /// Distance of its centre of mass from the node along the beam, m.
    pub arm: f64,
    /// Its part of the mass of the node, times the square of the shift of the node's centre of mass, kg m^2.
    pub shifted: f64,
    /// Its part of the node's moments int rho y^2 and int rho z^2, kg m^2.
    pub moments: [f64; 2],
    /// Mass per length at the node, kg/m.
    pub mass_per_length: f64,
    /// int rho y^2 and int rho z^2 per length at the node, kg m.
    pub moments_per_length: [f64; 2],
}

/// Weight minus inertia forces of a half element, in world axes: their sum about the node, and per length at the node.
#[derive(Clone, Copy, Debug)]
pub struct Load<S> {
    /// Force, N.
    pub force: Vector<S>,
    /// Torque about the node, N m.
    pub torque: Vector<S>,
    /// Force per length at the node, N/m.
    pub force_per_length: Vector<S>,
    /// Torque per length at the node, N.
    pub torque_per_length: Vector<S>,
}

impl<S: Scalar> Load<S> {
    /// No load.
    pub fn none() -> Self {
        let zero = [S::zero(); 3];
        Load { force: zero, torque: zero, force_per_length: zero, torque_per_length: zero }
    }

    /// The load with `change` applied to each of its four vectors.
    pub fn map(&self, change: impl Fn(&Vector<S>) -> Vector<S>) -> Self {
        let Load { force, torque, force_per_length, torque_per_length } = self;
        let [force, torque] = [change(force), change(torque)];
        Load { force, torque, force_per_length: change(force_per_length), torque_per_length: change(torque_per_length) }
    }
}

impl Half {
    /// Load of the half element for the motion of its node. A point of the beam's axis at x has the acceleration
    /// r'' + x e''. The loads of both halves of a node add up to those of the rigid node.
    pub fn load<S: Scalar, const D: usize>(&self, node: &Frame<Taylor<S>, D>, gravity: &[f64; D]) -> Load<S> {
        let lift: [S; D] = from_fn(|k| -node.r[k].dd + gravity[k]);
        let along = node.axes[0];
        let [axis, bent] = [along.each(|e| e.x), along.each(|e| e.dd)];
        let hanging = cross(&axis, &lift);
        let whirling = cross(&axis, &bent);
        let turning = |moments: [f64; 2]| -> Vector<S> {
            let mut torque = [S::zero(); 3];
            for (axis, moment) in node.axes[1..].iter().zip(moments) {
                let rate = cross(&axis.each(|e| e.x), &axis.each(|e| e.dd));
                (0..3).for_each(|k| torque[k] -= rate[k] * moment);
            }
            torque
        };
        let turned = turning(self.moments);
        let of = |k: usize| if k < D { lift[k] * self.mass - bent[k] * (self.mass * self.arm) } else { S::zero() };
        Load {
            force: from_fn(of),
            torque: from_fn(|k| hanging[k] * (self.mass * self.arm) - whirling[k] * self.shifted + turned[k]),
            force_per_length: from_fn(|k| if k < D { lift[k] * self.mass_per_length } else { S::zero() }),
            torque_per_length: turning(self.moments_per_length),
        }
    }
}
