//! The steady rotation that drives prescribe.

use super::spin::Spin;
use crate::body::{Frame, MarkerId, in_space};
use crate::joint::Axis;
use crate::math::array::{Each, from_fn};
use crate::math::{Regime, Taylor, Time};
use crate::scene::{Model, ModelJoint};
use crate::tolerances;

/// The rotation that all drives active at `t` prescribe in common; `None` where they differ or accelerate.
pub(super) fn driven_spin<const D: usize>(model: &Model<D>, t: f64) -> Option<Spin> {
    let mut common: Option<Spin> = None;
    for joint in model.joints.iter().filter(|joint| joint.element.depends_on_time()) {
        let [rate, acceleration] = prescribed(model, joint, t)?;
        if acceleration != 0.0 {
            return None;
        }
        if rate != 0.0 {
            let spin = turn_about_ground(model, joint, rate)?;
            match common {
                None => common = Some(spin),
                Some(other) if !spin.is_same(&other) => return None,
                Some(_) => {}
            }
        }
    }
    common
}

/// -phi_t and -phi_tt of a joint of one row; `None` for other joints. They do not depend on the positions of the
/// markers.
fn prescribed<const D: usize>(model: &Model<D>, joint: &ModelJoint<D>, t: f64) -> Option<[f64; 2]> {
    if joint.element.row_names().len() != 1 {
        return None;
    }
    let frames: Vec<_> = joint.markers.iter().map(|&marker| fixed(model, marker).map(Taylor::fixed)).collect();
    let mut row = [Taylor::fixed(0.0)];
    let time = Time { t: Taylor::time(t), regime: Regime::FREE };
    joint.element.levels(&frames, time, &mut row);
    Some([-row[0].d, -row[0].dd])
}

/// Frame of a marker of the ground; for other markers any frame.
fn fixed<const D: usize>(model: &Model<D>, marker: MarkerId) -> Frame<f64, D> {
    model.ground.get(marker).map_or_else(Frame::world, |own| Frame::world().at(own))
}

/// Rotation of the second marker at `rate` where the first is on the ground, or of the first at -`rate` where the
/// second is.
fn turn_about_ground<const D: usize>(model: &Model<D>, joint: &ModelJoint<D>, rate: f64) -> Option<Spin> {
    let [first, second] = joint.markers[..] else { return None };
    let (ground, speed) = match (model.carrier(first), model.carrier(second)) {
        (None, Some(_)) => (first, rate),
        (Some(_), None) => (second, -rate),
        _ => return None,
    };
    let frame = fixed(model, ground);
    match joint.element.joint_axis(&frame) {
        Some(Axis::Turn(axis)) => Some(Spin { velocity: axis.each(|x| speed * x), point: in_space(&frame.r) }),
        _ => None,
    }
}

impl Spin {
    /// True if both have the same axis and speed, within round-off.
    fn is_same(&self, other: &Spin) -> bool {
        let turn = |i: usize| (self.velocity[i] - other.velocity[i]).abs();
        let speed = self.speed();
        let arm: [f64; 3] = from_fn(|i| other.point[i] - self.point[i]);
        let across = crate::body::cross(&self.velocity, &arm);
        (0..3).all(|i| turn(i) <= tolerances::SAME * speed && across[i].abs() <= tolerances::SAME * speed)
    }
}
