//! The angles in space that q carries beside the coordinates of the bodies.

use super::mechanism::{Mechanism, of};
use crate::body::{Carried, MarkerId, norm};
use crate::scene::Part;

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
            *rate = turning.rate(|marker| self.carried(marker, q, v));
        }
    }

    /// Brings them back to what the bodies say, each within half a turn of where it was.
    pub(super) fn continue_turnings(&self, q: &mut [f64]) {
        let first = q.len() - self.model().turnings.len();
        // How the markers stand does not depend on how fast they move: any numbers serve as velocities.
        for (i, turning) in self.model().turnings.iter().enumerate() {
            q[first + i] = turning.next_to(q[first + i], |marker| self.carried(marker, q, q));
        }
    }

    /// All but point masses.
    pub(super) fn oriented_bodies(&self) -> impl Iterator<Item = &Part<D>> {
        self.model().bodies.iter().filter(|part| part.body.oriented())
    }

    /// Writes the size of the angular velocity of each of them, rad/s.
    pub(super) fn write_spins(&self, q: &[f64], v: &[f64], out: &mut [f64]) {
        for (out, part) in out.iter_mut().zip(self.oriented_bodies()) {
            *out = norm(&part.body.attitude(of(q, part, true), of(v, part, false)).spin);
        }
    }

    /// A marker as its body's own frame carries it.
    #[inline]
    pub(super) fn carried(&self, marker: MarkerId, q: &[f64], v: &[f64]) -> Carried<'_, D> {
        let model = self.model();
        match model.carrier(marker) {
            None => Carried { body: None, marker: &model.ground[marker] },
            Some(part) => Carried {
                body: Some(part.body.attitude(of(q, part, true), of(v, part, false))),
                marker: part.body.marker(marker - part.first_marker),
            },
        }
    }
}
