//! Rigid body in the plane: x, y of the centre of mass and the angle, or those of them that are free.

use super::{BodyFacts, BodyKernel, Energy, Frame, Freedom, Marker, Pose, Wrench, cross, sub};
use crate::math::Scalar;
use crate::math::array::{Each, from_fn};

/// M = diag(m, m, I): constant, so there are no velocity-dependent forces.
pub struct RigidPlanar<const D: usize> {
    inertia: [f64; 3],
    /// Index of x, y and angle among the coordinates; `None` is fixed at its value in `rest`.
    slots: [Option<usize>; 3],
    rest: [f64; 3],
    markers: Vec<Marker<D>>,
}

const NAMES: [&str; 3] = ["x", "y", "angle"];
const RATES: [&str; 3] = ["x'", "y'", "angle'"];

impl<const D: usize> RigidPlanar<D> {
    pub fn new(mass: f64, inertia: f64, rest: [f64; 3], free: &[usize], markers: Vec<Marker<D>>) -> Self {
        let mut slots = [None; 3];
        free.iter().enumerate().for_each(|(slot, &i)| slots[i] = Some(slot));
        RigidPlanar { inertia: [mass, mass, inertia], slots, rest, markers }
    }

    #[inline]
    fn coordinates<S: Scalar>(&self, q: &[S]) -> [S; 3] {
        from_fn(|i| self.slots[i].map_or(S::constant(self.rest[i]), |slot| q[slot]))
    }

    fn free(&self) -> impl Iterator<Item = usize> + '_ {
        (0..3).filter(|&i| self.slots[i].is_some())
    }
}

impl<const D: usize> BodyKernel<D> for RigidPlanar<D> {
    fn facts(&self) -> BodyFacts {
        let Freedom { rotations, .. } = Freedom::all(D);
        let translations = self.free().filter(|&i| i < 2).collect();
        let rotations = if self.slots[2].is_some() { rotations } else { Vec::new() };
        BodyFacts {
            freedom: Some(Freedom { translations, rotations }),
            has_constant_forces: true,
            ..BodyFacts::new(self.free().map(|i| NAMES[i]), self.free().map(|i| RATES[i]))
        }
    }
    fn markers(&self) -> &[Marker<D>] {
        &self.markers
    }

    #[inline]
    fn frame<S: Scalar>(&self, q: &[S]) -> Frame<S, D> {
        let [x, y, turn] = self.coordinates(q);
        let (s, c) = turn.sin_cos();
        let axes = [[c, s], [-s, c]];
        Frame { r: from_fn(|i| [x, y][i]), axes: from_fn(|i| from_fn(|k| axes[i][k])), turn }
    }

    #[inline]
    fn pull_back<S: Scalar>(&self, q: &[S], frame: &Frame<S, D>, wrench: &Wrench<S, D>, f: &mut [S]) {
        let [x, y, _] = self.coordinates(q);
        let mut centre = [S::zero(); D];
        (centre[0], centre[1]) = (x, y);
        let moment = wrench.torque[2] + cross(&sub(&frame.r, &centre), &wrench.force)[2];
        for (slot, force) in self.slots.iter().zip([wrench.force[0], wrench.force[1], moment]) {
            if let Some(slot) = slot {
                f[*slot] += force;
            }
        }
    }

    fn pose(&self, q: &[f64], v: &[f64]) -> Pose<D> {
        if let (&[x, y, turn], &[x_rate, y_rate, spin]) = (q, v) {
            return Pose::in_plane([x, y, turn], [x_rate, y_rate, spin]);
        }
        Pose::in_plane(self.coordinates(q), self.slots.each(|slot| slot.map_or(0.0, |slot| v[slot])))
    }

    fn mass(&self, values: &mut [f64]) {
        self.free().zip(values).for_each(|(i, value)| *value = self.inertia[i]);
    }
    fn own_forces<S: Scalar>(&self, _q: &[S], _v: &[S], gravity: &[f64; D], f: &mut [S]) {
        for (slot, g) in self.slots.iter().zip(&gravity[..2]) {
            if let Some(slot) = slot {
                f[*slot] += S::constant(self.inertia[0] * g);
            }
        }
    }
    fn energy<S: Scalar>(&self, q: &[S], v: &[S], gravity: &[f64; D]) -> Energy<S> {
        let kinetic = self.free().zip(v).fold(S::zero(), |sum, (i, &v)| sum + v * v * (0.5 * self.inertia[i]));
        let [x, y, _] = self.coordinates(q);
        Energy { kinetic, potential: (x * gravity[0] + y * gravity[1]) * -self.inertia[0] }
    }
}
