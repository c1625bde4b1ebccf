//! Switching functions, single forces, roads and gaps, as the time loop asks for them.

use super::Feed;
use super::actions::act;
use super::gather::{MovingFrames, gathered};
use super::layout::Layout;
use super::placed_joint::PlacedJoint;
use super::terms::OperatingPoint;
use super::view::{Plain, StateView, input_on};
use crate::body::{Frame, MOST_MARKERS, MarkerId, Wrench, norm};
use crate::force::InputKind;
use crate::math::array::Each;
use crate::math::{Rate, Regime, Taylor, Time, all_finite};
use crate::scene::{Model, ModelForce};

/// Writes the arguments of all switching functions; `motion` has the frames with the accelerations of the state.
pub(super) fn write_arguments<const D: usize>(
    layout: &Layout<D>,
    time: Time<Rate>,
    motion: &MovingFrames<D>,
    inputs: &[f64],
    out: &mut [Rate],
) {
    let model = &layout.model;
    for joint in PlacedJoint::all(layout) {
        gathered(&joint.joint.markers, |&marker| motion[marker], |frames| joint.switching(time, frames, out));
    }
    for (i, force) in model.given_forces().iter().chain(model.rates()).enumerate() {
        let input = input_on(model, i, inputs).map(|u| Taylor::fixed(Rate::fixed(u)));
        gathered(
            &force.markers,
            |&marker| motion[marker].map(along_motion),
            |frames| force.element.switching(&input, frames, time.map(Taylor::running), out),
        );
    }
}

/// What each force does at a state.
pub(super) fn list_feeds<const D: usize>(view: &Plain<D>) -> Vec<Feed> {
    let feed = |(i, force): (usize, &ModelForce<D>)| {
        let mut wrenches = [Wrench::zero(); MOST_MARKERS];
        act(view.model, i, view, &mut wrenches);
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
    view.model.forces.iter().enumerate().map(feed).collect()
}

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

/// True if the scene has a tyre.
pub(super) fn has_roads<const D: usize>(model: &Model<D>) -> bool {
    model.given_forces().iter().any(|force| matches!(force.element.input(), InputKind::Displacement { .. }))
}

/// The roads under the wheels.
pub(super) fn find_roads<const D: usize>(model: &Model<D>, time: Time<f64>, motion: &MovingFrames<D>) -> Vec<Road> {
    model.given_forces().iter().filter_map(|force| road(force, time, motion)).collect()
}

fn road<const D: usize>(force: &ModelForce<D>, time: Time<f64>, motion: &MovingFrames<D>) -> Option<Road> {
    let InputKind::Displacement { rate: is_damped } = force.element.input() else { return None };
    let time = time.map(Taylor::time);
    gathered(
        &force.markers,
        |&marker| motion[marker],
        |frames: &[Frame<_, D>]| {
            let wheel = force.element.wheel(frames, time)?;
            let mut wrenches = [Wrench::zero(); MOST_MARKERS];
            let load = force.element.act(frames, time, &mut wrenches[..frames.len()]).magnitude;
            let clearance = frames[0].r[D - 1].x - wheel.road;
            let radius = wheel.radius;
            let lifts = wheel.lifts;
            let tyre = force.name.clone();
            Some(Road { tyre, height: wheel.road, is_damped, clearance, radius, load, lifts })
        },
    )
}

/// Writes the gaps of the forces that have one, m, along the axes of the world.
pub(super) fn write_gaps<const D: usize>(model: &Model<D>, q: &[f64], out: &mut [[f64; 3]]) {
    let forces = model.forces.iter().filter(|force| force.element.gap().is_some());
    for (force, gap) in forces.zip(out) {
        let [a, b] = [0, 1].each(|slot| origin_of(model, force.markers[slot], q));
        (0..D).for_each(|i| gap[i] = b[i] - a[i]);
    }
}

/// Origin of a marker in the world. It does not depend on the velocities: q stands in for v.
fn origin_of<const D: usize>(model: &Model<D>, marker: MarkerId, q: &[f64]) -> [f64; D] {
    let at = OperatingPoint { t: 0.0, q, v: q, vdot: &[], lambda: &[] };
    Plain { model, at, regime: Regime::FREE, inputs: &[] }.frame(marker).r.each(|r| r.x)
}

/// A value and its rate, each with its own rate along the motion.
fn along_motion(x: Taylor<f64>) -> Taylor<Rate> {
    Taylor::new(Rate { re: x.x, eps: [x.d] }, Rate { re: x.d, eps: [x.dd] }, Rate::fixed(x.dd))
}
