//! The angles in space that q carries beside the coordinates of the bodies.

use super::mechanism::{Mechanism, of};
use crate::body::{Frame, Marker, MarkerId};
use crate::math::Taylor;

impl<const D: usize> Mechanism<D> {
    /// Those of q.
    #[inline]
    pub fn turned<'q>(&self, q: &'q [f64]) -> &'q [f64] {
        &q[q.len() - self.model().turnings.len()..]
    }

    pub(super) fn turning_names(&self) -> Vec<String> {
        self.model().turnings.iter().map(|turning| turning.name.clone()).collect()
    }

    /// Writes their rates.
    pub(super) fn turning_rates(&self, q: &[f64], v: &[f64], qdot: &mut [f64]) {
        let first = q.len() - self.model().turnings.len();
        for (rate, turning) in qdot[first..].iter_mut().zip(&self.model().turnings) {
            *rate = turning.rate(|marker| self.undeformed(marker, q, v));
        }
    }

    /// Brings them back to what the bodies say, each within half a turn of where it was.
    pub(super) fn continue_turnings(&self, q: &mut [f64]) {
        let first = q.len() - self.model().turnings.len();
        // Where the markers are does not depend on how fast they move: any numbers serve as velocities.
        for (i, turning) in self.model().turnings.iter().enumerate() {
            q[first + i] = turning.next_to(q[first + i], |marker| self.undeformed(marker, q, q));
        }
    }

    /// A marker as its body's own frame, the first one, carries it: small rotations by deformation do not change the turn.
    pub(super) fn undeformed(&self, marker: MarkerId, q: &[f64], v: &[f64]) -> Frame<Taylor<f64>, D> {
        let model = self.model();
        let Some(part) = model.carrier(marker) else {
            return Frame::world().at(&model.ground[marker]);
        };
        let mut own = [Frame::world()];
        part.body.motion(of(q, part, true), of(v, part, false), None, &mut own);
        own[0].at(&Marker { offset: [0.0; D], ..*part.body.marker(marker - part.first_marker) })
    }
}
