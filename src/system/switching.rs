//! Single forces and switching functions, as the time loop asks for them: arguments and powers.

use super::Feed;
use super::mechanism::{Mechanism, with_frames};
use super::tangent::OperatingPoint;
use super::view::{Plain, View, along_motion, gathered};
use super::workspace::Workspace;
use crate::body::{MOST_MARKERS, Wrench, norm};
use crate::force::Force;
use crate::math::{Rate, Regime, Taylor, Time, all_finite};
use crate::scene::Connection;

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

    /// What each force does at a state.
    pub(super) fn list_feeds(&self, view: &Plain<D>) -> Vec<Feed> {
        let feed = |(i, force): (usize, &Connection<Box<dyn Force<D>>>)| {
            let mut wrenches = [Wrench::zero(); MOST_MARKERS];
            self.act(i, view, &mut wrenches);
            let mut power = 0.0;
            let mut size = 0.0;
            let mut is_finite = true;
            for (wrench, &marker) in wrenches.iter().zip(&force.markers) {
                power += wrench.power(&view.frame(marker));
                size += norm(&wrench.force) + norm(&wrench.torque);
                is_finite &= all_finite(&wrench.force) && all_finite(&wrench.torque);
            }
            Feed { name: force.name.clone(), power, size, is_finite }
        };
        self.model().forces.iter().enumerate().map(feed).collect()
    }
}
