//! The steady rotation that drives prescribe, and the coordinates that take part in it.

use super::mechanism::Mechanism;
use super::spin::{Placement, Rotation, Spin};
use crate::body::{Frame, MarkerId, in_space};
use crate::joint::{Axis, Joint};
use crate::math::array::{Each, from_fn};
use crate::math::{Regime, Taylor, Time};
use crate::scene::{Connection, Part};
use crate::tolerances;

impl<const D: usize> Mechanism<D> {
    /// The unit quaternions among the coordinates.
    pub(super) fn quaternions(&self) -> impl Iterator<Item = Rotation> {
        let places = |part: &Part<D>| part.body.turning().map(|first| (part.first_q + first, part.first_v + first));
        self.model().bodies.iter().filter_map(places).map(|(q, v)| Rotation { q, v })
    }

    /// The rotation that all drives active at `t` prescribe in common; `None` where they differ or accelerate.
    pub(super) fn driven_spin(&self, t: f64) -> Option<Spin> {
        let mut common: Option<Spin> = None;
        for joint in self.model().joints.iter().filter(|joint| joint.element.depends_on_time()) {
            let [rate, acceleration] = self.prescribed(joint, t)?;
            if acceleration != 0.0 {
                return None;
            }
            if rate != 0.0 {
                let spin = self.turn_about_ground(joint, rate)?;
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
    fn prescribed(&self, joint: &Connection<Box<dyn Joint<D>>>, t: f64) -> Option<[f64; 2]> {
        if joint.element.row_names().len() != 1 {
            return None;
        }
        let frames: Vec<_> = joint.markers.iter().map(|&marker| self.fixed(marker).map(Taylor::fixed)).collect();
        let mut row = [Taylor::fixed(0.0)];
        let time = Time { t: Taylor::time(t), regime: Regime::FREE };
        joint.element.levels(&frames, time, &mut row);
        Some([-row[0].d, -row[0].dd])
    }

    /// Frame of a marker of the ground; for other markers any frame.
    fn fixed(&self, marker: MarkerId) -> Frame<f64, D> {
        self.model().ground.get(marker).map_or_else(Frame::world, |own| Frame::world().at(own))
    }

    /// Rotation of the second marker at `rate` where the first is on the ground, or of the first at -`rate` where the
    /// second is.
    fn turn_about_ground(&self, joint: &Connection<Box<dyn Joint<D>>>, rate: f64) -> Option<Spin> {
        let [first, second] = joint.markers[..] else { return None };
        let (ground, speed) = match (self.model().carrier(first), self.model().carrier(second)) {
            (None, Some(_)) => (first, rate),
            (Some(_), None) => (second, -rate),
            _ => return None,
        };
        let frame = self.fixed(ground);
        match joint.element.joint_axis(&frame) {
            Some(Axis::Turn(axis)) => Some(Spin { velocity: axis.each(|x| speed * x), point: in_space(&frame.r) }),
            _ => None,
        }
    }

    /// All coordinates that change when the world is rotated, in the order of the bodies.
    pub(super) fn placed_coordinates(&self) -> Option<Vec<Placement>> {
        self.model().bodies.iter().map(placements).collect::<Option<Vec<_>>>().map(|all| all.concat())
    }
}

/// Placements of one body: x, y(, z) first, then an angle or a quaternion where it has an orientation.
fn placements<const D: usize>(part: &Part<D>) -> Option<Vec<Placement>> {
    let body = &part.body;
    let names = part.body.coordinate_names();
    let own: Vec<&str> = names.iter().map(String::as_str).collect();
    let place = Placement::Place { q: part.first_q, v: part.first_v, count: D };
    let q = part.first_q + D;
    let v = part.first_v + D;
    match (D, own.as_slice()) {
        (_, []) => Some(Vec::new()),
        (2, ["x", "y", "angle", ..]) => Some(vec![place, Placement::Angle { q, v }]),
        (3, ["x", "y", "z", "qw", ..]) => Some(vec![place, Placement::Axes { q, v }]),
        (2, ["x", "y"]) | (3, ["x", "y", "z"]) if !body.oriented() => Some(vec![place]),
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
