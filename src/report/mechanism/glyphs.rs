//! Table of the symbols of all kinds of joints and forces.

use super::canvas::{Canvas, Layer};
use super::snapshot::{Link, Sight, Snapshot};
use super::{bodies, forces, joints};

/// Properties of the joints and forces over the whole motion, in their order.
#[derive(Clone, Debug, Default)]
pub struct Course {
    /// Range of each joint's position along its axis, m.
    pub travels: Vec<Option<(f64, f64)>>,
    /// Distance of the ends of each force at the start, m.
    pub lengths: Vec<f64>,
}

struct Glyph {
    kind: &'static str,
    draw: fn(&mut Canvas, &Link, &Sight),
    /// True if earlier pictures of a stroboscope show it too.
    in_all: bool,
}

const fn glyph(kind: &'static str, draw: fn(&mut Canvas, &Link, &Sight), in_all: bool) -> Glyph {
    Glyph { kind, draw, in_all }
}

const JOINTS: &[Glyph] = &[
    glyph("revolute", joints::revolute, false),
    glyph("prismatic", joints::prismatic, false),
    glyph("cylindrical", joints::cylindrical, false),
    glyph("universal", joints::universal, false),
    glyph("spherical", joints::spherical, false),
    glyph("planar", joints::planar, false),
    glyph("weld", joints::weld, false),
    glyph("distance", joints::distance, true),
    glyph("point_on_line", joints::point_on_line, false),
    glyph("gear", joints::gear, true),
    glyph("driver", joints::driver, false),
    glyph("equation", joints::equation, false),
];

const FORCES: &[Glyph] = &[
    glyph("spring_damper", forces::spring_damper, true),
    glyph("torsion_spring", forces::torsion_spring, false),
    glyph("bushing", forces::bushing, false),
    glyph("beam", forces::beam, true),
    glyph("applied_force", forces::applied_force, false),
    glyph("applied_torque", forces::applied_torque, false),
    glyph("tyre", forces::tyre, true),
];

/// Symbol of kinds from outside the crate.
const OWN: Glyph = glyph("", joints::equation, false);

/// Draws all joints and forces of a scene.
pub fn draw(pen: &mut Canvas, scene: &Snapshot, course: &Course) {
    let depths: Vec<f64> = scene.limbs.iter().map(|limb| bodies::depth(pen, limb)).collect();
    let sight = |travel, length| Sight { is_planar: scene.is_planar, travel, length };
    let travel = |i: usize| course.travels.get(i).copied().flatten();
    let joints = scene.joints.iter().enumerate().map(|(i, link)| (link, JOINTS, sight(travel(i), 0.0)));
    let length = |i: usize| course.lengths.get(i).copied().unwrap_or(0.0);
    let forces = scene.forces.iter().enumerate().map(|(i, link)| (link, FORCES, sight(None, length(i))));
    for (link, table, sight) in joints.chain(forces) {
        let glyph = table.iter().find(|glyph| glyph.kind == link.kind).unwrap_or(&OWN);
        if !glyph.in_all && pen.paleness > 0.0 {
            continue;
        }
        pen.layer = Layer::Joint;
        pen.depth = depth(pen, link, &depths, glyph.in_all);
        (glyph.draw)(pen, link, &sight);
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
