//! A spatial body that may move along some world axes and turn about at most one: coordinates only for those.

use super::{BodyFacts, BodyKernel, Energy, Frame, Freedom, Marker, Wrench, cross, sub};
use crate::error::{Error, Result};
use crate::math::Scalar;
use crate::math::array::{Each, from_fn};
use crate::math::rotation::Matrix3;

/// r = rest + the free translations, R = Rot(axis, angle) R_0. The moment of inertia about a fixed axis is constant, so
/// M is constant and diagonal and no velocity-dependent force does work.
pub struct Guided<const D: usize> {
    mass: f64,
    /// Moment about the axis of rotation, kg m^2.
    moment: f64,
    slots: [Option<usize>; 3],
    turn: Option<Turn>,
    rest: [f64; 3],
    /// Columns of R_0: the body's axes in the world at angle zero.
    axes: Matrix3,
    markers: Vec<Marker<D>>,
}

#[derive(Clone, Copy)]
struct Turn {
    slot: usize,
    axis: usize,
}

const NAMES: [&str; 6] = ["x", "y", "z", "rx", "ry", "rz"];
const RATES: [&str; 6] = ["x'", "y'", "z'", "rx'", "ry'", "rz'"];

impl<const D: usize> Guided<D> {
    /// `moment` about the axis of rotation, kg m^2; `rotation[i][j]`: world component i of body axis j; `free`: indices into x, y, z, rx, ry, rz.
    pub fn new(
        mass: f64,
        moment: f64,
        rest: [f64; 3],
        rotation: Matrix3,
        free: &[usize],
        markers: Vec<Marker<D>>,
    ) -> Result<Self> {
        let mut slots = [None; 3];
        let mut turn = None;
        for (slot, &i) in free.iter().enumerate() {
            match (i < 3, turn) {
                (true, _) => slots[i] = Some(slot),
                (false, None) => turn = Some(Turn { slot, axis: i - 3 }),
                (false, Some(_)) => {
                    return Err(Error::input("a body may turn about one axis or about all")
                        .under("free")
                        .hint("keep one of rx, ry, rz, or leave \"free\" out and use joints"));
                }
            }
        }
        let axes = from_fn(|j| from_fn(|i| rotation[i][j]));
        Ok(Guided { mass, moment, slots, turn, rest, axes, markers })
    }

    fn free(&self) -> Vec<usize> {
        let along = (0..3).filter(|&i| self.slots[i].is_some());
        along.chain(self.turn.map(|turn| turn.axis + 3)).collect()
    }

    fn position<S: Scalar>(&self, q: &[S]) -> [S; D] {
        from_fn(|i| self.slots[i].map_or(S::constant(self.rest[i]), |slot| q[slot]))
    }
}

impl<const D: usize> BodyKernel<D> for Guided<D> {
    /// The angular acceleration is zero at v' = 0: the axis is fixed in the world.
    fn facts(&self) -> BodyFacts {
        let translations = (0..3).filter(|&i| self.slots[i].is_some()).collect();
        let rotations = self.turn.iter().map(|turn| self.axes.each(|own| own[turn.axis])).collect();
        let free = self.free();
        BodyFacts {
            freedom: Some(Freedom { translations, rotations }),
            has_constant_forces: true,
            ..BodyFacts::new(free.iter().map(|&i| NAMES[i]), free.iter().map(|&i| RATES[i]))
        }
    }
    fn markers(&self) -> &[Marker<D>] {
        &self.markers
    }

    fn frame<S: Scalar>(&self, q: &[S]) -> Frame<S, D> {
        let mut body = Frame::world();
        body.r = self.position(q);
        for (axis, start) in body.axes.iter_mut().zip(&self.axes) {
            axis.iter_mut().zip(start).for_each(|(a, &s)| *a = S::constant(s));
            if let Some(turn) = self.turn {
                let (s, c) = q[turn.slot].sin_cos();
                let i = (turn.axis + 1) % 3;
                let j = (turn.axis + 2) % 3;
                axis[i] = c * start[i] - s * start[j];
                axis[j] = s * start[i] + c * start[j];
            }
        }
        body
    }

    fn pull_back<S: Scalar>(&self, q: &[S], frame: &Frame<S, D>, wrench: &Wrench<S, D>, f: &mut [S]) {
        for (slot, force) in self.slots.iter().zip(wrench.force) {
            if let Some(slot) = slot {
                f[*slot] += force;
            }
        }
        if let Some(turn) = self.turn {
            let arm = cross(&sub(&frame.r, &self.position(q)), &wrench.force);
            f[turn.slot] += wrench.torque[turn.axis] + arm[turn.axis];
        }
    }

    fn mass(&self, values: &mut [f64]) {
        values.fill(self.mass);
        if let Some(turn) = self.turn {
            values[turn.slot] = self.moment;
        }
    }
    fn own_forces<S: Scalar>(&self, _q: &[S], _v: &[S], gravity: &[f64; D], f: &mut [S]) {
        for (slot, g) in self.slots.iter().zip(gravity) {
            if let Some(slot) = slot {
                f[*slot] += S::constant(self.mass * g);
            }
        }
    }
    fn energy<S: Scalar>(&self, q: &[S], v: &[S], gravity: &[f64; D]) -> Energy<S> {
        let moving = self.slots.iter().flatten().fold(S::zero(), |sum, &slot| sum + v[slot] * v[slot] * self.mass);
        let turning = self.turn.map_or(S::zero(), |turn| v[turn.slot] * v[turn.slot] * self.moment);
        let height = self.position(q).iter().zip(gravity).fold(S::zero(), |sum, (&q, g)| sum - q * *g);
        Energy { kinetic: (moving + turning) * 0.5, potential: height * self.mass }
    }
}
