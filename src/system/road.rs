//! The roads under the wheels of a scene.

use super::mechanism::{Mechanism, with_frames};
use super::workspace::Workspace;
use crate::body::{MOST_MARKERS, Wrench};
use crate::force::{Force, InputKind};
use crate::math::{Taylor, Time};
use crate::scene::Connection;

/// The road under a wheel, and the wheel above it.
#[derive(Clone, Debug, PartialEq)]
#[doc(hidden)]
pub struct Road {
    /// Name of the tyre in the scene.
    pub tyre: String,
    /// Height under the wheel, m.
    pub height: f64,
    /// True if the force depends on the rate of the height.
    pub is_damped: bool,
    /// Height of the wheel's centre above the road, m.
    pub clearance: f64,
    /// Radius of the tyre without load, m.
    pub radius: f64,
    /// Force of the tyre on the wheel, N.
    pub load: f64,
    /// True if the tyre may leave the road, so that it never pulls.
    pub lifts: bool,
}

impl Road {
    /// Compression of the tyre as a part of its radius; 1 where the centre of the wheel is on the road.
    pub fn compression(&self) -> f64 {
        1.0 - self.clearance / self.radius
    }
}

impl<const D: usize> Mechanism<D> {
    /// True if the scene has a tyre.
    pub(super) fn has_roads(&self) -> bool {
        self.model().given_forces().iter().any(|force| is_displaced(force.element.as_ref()))
    }

    /// The roads under the wheels.
    pub(super) fn find_roads(&self, time: Time<f64>, work: &Workspace<D>) -> Vec<Road> {
        let road = |force: &Connection<Box<dyn Force<D>>>| self.road(force, time, work);
        self.model().given_forces().iter().filter_map(road).collect()
    }

    fn road(&self, force: &Connection<Box<dyn Force<D>>>, time: Time<f64>, work: &Workspace<D>) -> Option<Road> {
        let InputKind::Displacement { rate: is_damped } = force.element.input() else { return None };
        let time = time.map(Taylor::time);
        with_frames(&work.motion, &force.markers, |frames| {
            let wheel = force.element.wheel(frames, time)?;
            let mut wrenches = [Wrench::zero(); MOST_MARKERS];
            let load = force.element.act(frames, time, &mut wrenches[..frames.len()]).magnitude;
            let clearance = frames[0].r[D - 1].x - wheel.road;
            let radius = wheel.radius;
            let lifts = wheel.lifts;
            let tyre = force.name.clone();
            Some(Road { tyre, height: wheel.road, is_damped, clearance, radius, load, lifts })
        })
    }
}

/// True if an input of the force is the height of a road.
fn is_displaced<const D: usize>(force: &dyn Force<D>) -> bool {
    matches!(force.input(), InputKind::Displacement { .. })
}
