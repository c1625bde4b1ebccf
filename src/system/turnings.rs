//! Angles in space that count full turns, the last coordinates of q.

use super::mechanism::{Mechanism, of};
use super::model_facts::oriented_bodies;
use crate::body::{Carried, MarkerId, Pose, norm};

impl<const D: usize> Mechanism<D> {
    /// The turning angles in q.
    #[inline]
    pub fn turned<'q>(&self, q: &'q [f64]) -> &'q [f64] {
        &q[q.len() - self.model().turnings.len()..]
    }

    /// Writes the rates of the turning angles.
    pub(super) fn turning_rates(&self, q: &[f64], v: &[f64], qdot: &mut [f64]) {
        let first = q.len() - self.model().turnings.len();
        for (rate, turning) in qdot[first..].iter_mut().zip(&self.model().turnings) {
            *rate = turning.rate(|marker| self.carried(marker, q, v));
        }
    }

    /// Sets the turning angles to those of the bodies' orientations, each within pi of its old value.
    pub(super) fn continue_turnings(&self, q: &mut [f64]) {
        let first = q.len() - self.model().turnings.len();
        // The orientations do not depend on the velocities: q stands in for v.
        for (i, turning) in self.model().turnings.iter().enumerate() {
            q[first + i] = turning.next_to(q[first + i], |marker| self.carried(marker, q, q));
        }
    }

    /// Writes the magnitude of the angular velocity of each body with an orientation, rad/s.
    pub(super) fn write_spins(&self, q: &[f64], v: &[f64], out: &mut [f64]) {
        for (out, part) in out.iter_mut().zip(oriented_bodies(self.model())) {
            *out = norm(&part.body.pose(of(q, part, true), of(v, part, false)).spin);
        }
    }

    /// A marker with the pose of the body that carries it.
    #[inline(always)]
    pub(super) fn carried(&self, marker: MarkerId, q: &[f64], v: &[f64]) -> Carried<'_, D> {
        let model = self.model();
        match model.carrier(marker) {
            None => Carried { body: Pose::ground(), marker: &model.ground[marker] },
            Some(part) => Carried {
                body: part.body.pose(of(q, part, true), of(v, part, false)),
                marker: &part.body.markers()[marker - part.first_marker],
            },
        }
    }
}
