//! What the time loop asks where the form of the equations changes: switching functions, infinite forces.

use super::mechanism::{Mechanism, with_frames};
use super::tangent::OperatingPoint;
use super::view::{Plain, along_motion, gathered};
use super::workspace::Workspace;
use crate::body::{MOST_MARKERS, Wrench};
use crate::math::{Rate, Regime, Taylor, Time, all_finite};

impl<const D: usize> Mechanism<D> {
    /// Writes the arguments of all switching functions.
    pub(super) fn write_arguments(
        &self,
        at: OperatingPoint,
        regime: Regime,
        work: &mut Workspace<D>,
        out: &mut [Rate],
    ) {
        self.place(at.q, at.v, at.vdot, work);
        let time = Time { t: Rate::seeded(at.t, 0), regime };
        for joint in self.placed_joints() {
            with_frames(&work.motion, &joint.joint.markers, |frames| joint.switching(time, frames, out));
        }
        let still = [Taylor::fixed(Rate::fixed(0.0)); 3];
        for force in self.model().given_forces().iter().chain(self.model().rates()) {
            gathered(
                &force.markers,
                |marker| work.motion[marker].map(along_motion),
                |frames| force.element.switching(&still, frames, time.map(Taylor::running), out),
            );
        }
    }

    /// Name of the first force that is infinite or not a number.
    pub(super) fn find_infinite_force(&self, view: &Plain<D>) -> Option<String> {
        let is_infinite = |force: &usize| {
            let mut wrenches = [Wrench::zero(); MOST_MARKERS];
            self.act(*force, view, &mut wrenches);
            wrenches.iter().any(|wrench| !all_finite(&wrench.force) || !all_finite(&wrench.torque))
        };
        (0..self.model().forces.len()).find(is_infinite).map(|force| self.model().forces[force].name.clone())
    }
}
