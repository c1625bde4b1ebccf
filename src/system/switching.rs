//! Single forces and switching functions, as the time loop asks for them: arguments, powers, infinite forces.

use super::Feed;
use super::mechanism::{Mechanism, with_frames};
use super::tangent::OperatingPoint;
use super::view::{Plain, View, along_motion, gathered, input_on};
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
        let forces = self.model().given_forces().iter().chain(self.model().rates());
        for (i, force) in forces.enumerate() {
            let input = input_on(self.model(), i, &work.inputs).map(|u| Taylor::fixed(Rate::fixed(u)));
            gathered(
                &force.markers,
                |marker| work.motion[marker].map(along_motion),
                |frames| force.element.switching(&input, frames, time.map(Taylor::running), out),
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
            for (wrench, &marker) in wrenches.iter().zip(&force.markers) {
                power += wrench.power(&view.frame(marker));
                size += norm(&wrench.force) + norm(&wrench.torque);
            }
            Feed { name: force.name.clone(), power, size }
        };
        self.model().forces.iter().enumerate().map(feed).collect()
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
