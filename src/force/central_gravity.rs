//! Gravity towards a fixed point.

use super::{Action, ForceKernel, Instant, Motion};
use crate::body::{Wrench, cross, dot, in_space, turned};
use crate::math::Scalar;
use crate::math::array::{Each, from_fn};

/// -mu m r/|r|^3 at the centre of mass of a body, r from the attracting point; its potential is -mu m/|r|. Gravity is
/// taken as uniform over the body: there is no gravity-gradient torque. Its marker is the body's own frame.
pub struct CentralGravity<const D: usize> {
    /// mu m, N m^2.
    strength: f64,
    centre: [f64; D],
    /// From the body's origin to its centre of mass, in its axes, m.
    to_mass: [f64; 3],
}

impl<const D: usize> CentralGravity<D> {
    /// Gravity of a body of mass `mass`, kg, whose origin is at `origin` from its centre of mass, towards `centre`.
    pub fn new(mu: f64, mass: f64, centre: [f64; D], origin: &[f64; D]) -> Self {
        CentralGravity { strength: mu * mass, centre, to_mass: in_space(origin).each(|x| -x) }
    }
}

impl<const D: usize> ForceKernel<D> for CentralGravity<D> {
    fn act<S: Scalar>(&self, frames: &Motion<S, D>, _: Instant<S>, out: &mut [Wrench<S, D>]) -> Action<S> {
        let arm = turned(&frames[0].axes, &self.to_mass);
        let gap: [_; D] = from_fn(|i| frames[0].r[i] + arm[i] - self.centre[i]);
        let square = dot(&gap, &gap);
        let potential = -(square.sqrt().recip() * self.strength);
        let magnitude = square.x.recip() * self.strength;
        let factor = potential.x / square.x;
        out[0].force = gap.each(|x| x.x * factor);
        out[0].torque = cross(&arm.each(|x| x.x), &out[0].force);
        Action { potential, magnitude }
    }
}
