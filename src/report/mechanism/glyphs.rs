//! Table of the symbols of all kinds of joints and forces.

use super::canvas::{Canvas, Layer};
use super::snapshot::{Link, Sight, Snapshot};
use super::{bodies, forces, joints};

/// Properties of the joints and forces over the whole motion, in their order.
#[derive(Clone, Debug, Default)]
pub struct ElementTravel {
    /// Range of each joint's position along its axis, m.
    pub travels: Vec<Option<(f64, f64)>>,
    /// Distance of the ends of each force at the start, m.
    pub lengths: Vec<f64>,
}

/// Returns the symbol of a kind, and true if it is long, so that earlier pictures of a stroboscope show it too.
fn glyph(kind: &str) -> (fn(&mut Canvas, &Link, &Sight), bool) {
    match kind {
        "revolute" => (joints::revolute, false),
        "prismatic" => (joints::slot, false),
        "cylindrical" => (joints::cylindrical, false),
        "universal" => (joints::universal, false),
        "spherical" => (joints::spherical, false),
        "planar" => (joints::planar, false),
        "weld" => (joints::weld, false),
        "distance" => (joints::distance, true),
        "point_on_line" => (joints::point_on_line, false),
        "gear" => (joints::gear, true),
        "driver" => (joints::driver, false),
        "equation" => (joints::equation, false),
        "spring_damper" => (forces::spring_damper, true),
        "torsion_spring" => (forces::torsion_spring, false),
        "bushing" => (forces::bushing, false),
        "beam" => (forces::beam, true),
        "applied_force" => (forces::applied_force, false),
        "applied_torque" => (forces::applied_torque, false),
        "tyre" => (forces::tyre, true),
        _ => (joints::equation, false),
    }
}

pub fn draw(pen: &mut Canvas, scene: &Snapshot, course: &ElementTravel) {
    let depths: Vec<f64> = scene.limbs.iter().map(|limb| bodies::depth(pen, limb)).collect();
    let sight = |travel, length| Sight { is_planar: scene.is_planar, travel, length };
    let travel = |i: usize| course.travels.get(i).copied().flatten();
    let joints = scene.joints.iter().enumerate().map(|(i, link)| (link, sight(travel(i), 0.0)));
    let length = |i: usize| course.lengths.get(i).copied().unwrap_or(0.0);
    let forces = scene.forces.iter().enumerate().map(|(i, link)| (link, sight(None, length(i))));
    for (link, sight) in joints.chain(forces) {
        let (draw, is_long) = glyph(link.kind);
        if is_long || pen.paleness == 0.0 {
            pen.layer = Layer::Joint;
            pen.depth = depth(pen, link, &depths, is_long);
            draw(pen, link, &sight);
        }
    }
}

/// Returns the depth of a symbol: one at a point is in front of the bodies that it joins; a long one between two points
/// has the depth of its middle.
fn depth(pen: &Canvas, link: &Link, bodies: &[f64], is_long: bool) -> f64 {
    let own = link.ends.iter().map(|end| pen.view.depth(end.r));
    if is_long {
        return own.sum::<f64>() / link.ends.len().max(1) as f64;
    }
    let joined = link.carriers.iter().flatten().map(|body| bodies[*body]);
    own.chain(joined).fold(f64::NEG_INFINITY, f64::max)
}
