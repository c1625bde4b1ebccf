//! Gaps between markers along which forces act that jump where they close.

use super::mechanism::Mechanism;
use super::tangent::OperatingPoint;
use super::view::{Plain, View};
use crate::body::MarkerId;
use crate::math::Regime;
use crate::math::array::Each;

impl<const D: usize> Mechanism<D> {
    /// The piece that holds each line, and its two markers.
    pub(super) fn gap_lines(&self) -> impl Iterator<Item = (usize, [MarkerId; 2])> {
        self.model()
            .forces
            .iter()
            .filter_map(|force| Some((force.element.gap()?, [force.markers[0], force.markers[1]])))
    }

    /// Writes the gap between two markers, m, along the axes of the world.
    pub(super) fn write_gap(&self, markers: [MarkerId; 2], q: &[f64], out: &mut [f64; 3]) {
        let [a, b] = markers.each(|marker| self.origin_of(marker, q));
        for (i, out) in out.iter_mut().take(D).enumerate() {
            *out = b[i] - a[i];
        }
    }

    /// Origin of a marker in the world. It does not depend on the velocities: q stands in for v.
    fn origin_of(&self, marker: MarkerId, q: &[f64]) -> [f64; D] {
        let at = OperatingPoint { t: 0.0, q, v: q, vdot: &[], lambda: &[] };
        let view = Plain { model: self.model(), at, regime: Regime::FREE, inputs: &[] };
        view.frame(marker).r.each(|r| r.x)
    }
}
