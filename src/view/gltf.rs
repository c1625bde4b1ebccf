//! A motion as one binary glTF 2.0 file, for viewers, slides and Blender.
//!
//! Each frame of the mechanism is a node with a channel of translations and one of rotations. Bodies and joints are fixed
//! to these nodes. Rods, springs and the pieces of bent beams are nodes with a channel of scales, too.

use super::ShownMotion;
use super::clip::pose;
use super::glb::{Glb, turned};
use super::moving::scene_at;
use super::parts::{BodyPart, FramePoint, LinkPart, PageParts, line_points};
use super::primitives::{Placement, Primitive};
use super::rows::even_rows;
use crate::body::{Form, Solid, norm, sub};
use crate::math::rotation::{quaternion_from_axes, quaternion_product};
use crate::report::mechanism::{Pose, Snapshot, solids, up};
use std::f64::consts::FRAC_1_SQRT_2;

const STILL: [f64; 4] = [0.0, 0.0, 0.0, 1.0];

/// Returns the file of a run with at least one row, with at most `most` poses.
pub fn glb(run: &ShownMotion, most: usize) -> Vec<u8> {
    let mut rows = even_rows(run.rows, most);
    // Times of glTF increase; those of a jump are two rows.
    rows.dedup_by_key(|row| run.trajectory.rows[*row][0].to_bits());
    let scenes: Vec<Snapshot> = rows.iter().map(|row| scene_at(run, *row)).collect();
    let Some(first) = scenes.first() else { return Vec::new() };
    let mechanism = &run.prepared.mechanism;
    let parts = PageParts::new(first, &solids(mechanism), &[], usize::MAX);
    let times = rows.iter().map(|row| run.trajectory.rows[*row][0] - run.trajectory.rows[0][0]);
    let mut glb = Glb::new(&run.prepared.name, upright(up(mechanism)), times);
    // Frame 0 is the ground.
    let mut frames = vec![glb.node("ground", ([0.0; 3], STILL, [1.0; 3]), None)];
    for (number, source) in parts.sources.iter().enumerate() {
        let name = parts.bodies.iter().find(|body| body.frame == number + 1).map_or("point", |body| &body.name);
        let placed = |scene: &Snapshot| {
            let Pose { r, axes } = pose(scene, *source);
            (r, xyzw(quaternion_from_axes(&axes)), [1.0; 3])
        };
        frames.push(glb.moving_node(name, scenes.iter().map(placed), None));
    }
    let radius = 0.008 * size(&scenes);
    let mut figure = Figure { glb, frames, scenes: &scenes, radius };
    parts.bodies.iter().enumerate().for_each(|(i, body)| figure.body(i, body));
    parts.joints.iter().for_each(|joint| figure.joint(joint));
    parts.forces.iter().for_each(|force| figure.force(force));
    figure.glb.finish()
}

/// Rotation that turns axis number `up` to the y axis, which points up in glTF.
fn upright(up: usize) -> [f64; 4] {
    match up {
        0 => [0.0, 0.0, FRAC_1_SQRT_2, FRAC_1_SQRT_2],
        2 => [-FRAC_1_SQRT_2, 0.0, 0.0, FRAC_1_SQRT_2],
        _ => STILL,
    }
}

/// Returns a quaternion [w, x, y, z] in the order of glTF.
fn xyzw(quaternion: [f64; 4]) -> [f64; 4] {
    let [w, x, y, z] = quaternion;
    [x, y, z, w]
}

/// Largest distance of a marker from the first one over the motion, m; 1 m where all coincide.
fn size(scenes: &[Snapshot]) -> f64 {
    let origin = scenes[0].markers[0].r;
    let places = scenes.iter().flat_map(|scene| &scene.markers);
    let size = places.map(|marker| norm(&sub(&marker.r, &origin))).fold(0.0, f64::max);
    if size > 0.0 { size } else { 1.0 }
}

/// Places something of length 1 along y from one point to another.
fn between(from: [f64; 3], to: [f64; 3], radius: f64) -> Placement {
    let way = sub(&to, &from);
    let length = norm(&way);
    if length == 0.0 {
        return (from, STILL, [radius, 0.0, radius]);
    }
    let [x, y, z] = way.map(|part| part / length);
    // The rotation from y to the way: axis y x way, with the half angle from 1 + cos; from y to -y about x.
    let w = (0.5 * (1.0 + y)).max(0.0).sqrt();
    let rotation = if w > 1e-8 { [0.5 * z / w, 0.0, -0.5 * x / w, w] } else { [1.0, 0.0, 0.0, 0.0] };
    (from, rotation, [radius, length, radius])
}

struct Figure<'a> {
    glb: Glb,
    /// Nodes of the frames.
    frames: Vec<usize>,
    scenes: &'a [Snapshot],
    /// Radius of links, m.
    radius: f64,
}

impl Figure<'_> {
    fn body(&mut self, number: usize, body: &BodyPart) {
        let color = Some(number);
        if body.line > 1 {
            let line = |scene: &Snapshot| line_points(&scene.limbs[number].line).collect::<Vec<_>>();
            let lines: Vec<Vec<[f64; 3]>> = self.scenes.iter().map(line).collect();
            for piece in 0..body.line - 1 {
                let ends = lines.iter().map(|line| between(line[piece], line[piece + 1], self.radius));
                self.glb.moving_node(&body.name, ends.collect::<Vec<_>>(), Some((Primitive::Cylinder, color)));
            }
            return;
        }
        for solid in &body.solids {
            self.solid(body, solid, color);
        }
        if !body.solids.is_empty() {
            return;
        }
        for (k, from) in body.points.iter().enumerate() {
            let size = self.radius * if body.points.len() == 1 { 3.0 } else { 1.0 };
            self.fixed(from, ([0.0; 3], STILL, [size; 3]), Primitive::Sphere, color, &body.name);
            for to in &body.points[k + 1..] {
                self.link(from, to, self.radius, color, &body.name);
            }
        }
    }

    fn joint(&mut self, joint: &LinkPart) {
        let size = 1.5 * self.radius;
        for end in &joint.ends {
            self.fixed(end, ([0.0; 3], STILL, [size; 3]), Primitive::Sphere, None, &joint.name);
        }
        if let ("distance", [from, to, ..]) = (joint.kind, &joint.ends[..]) {
            self.link(from, to, 0.7 * self.radius, None, &joint.name);
        }
    }

    fn force(&mut self, force: &LinkPart) {
        if let ("tyre", [hub, ..], [radius, ..]) = (force.kind, &force.ends[..], &force.radii[..]) {
            let radius = f64::from(*radius);
            let width = 0.3 * radius;
            // About y in space, about z in the plane.
            let is_planar = self.scenes[0].is_planar;
            let turned = if is_planar { [FRAC_1_SQRT_2, 0.0, 0.0, FRAC_1_SQRT_2] } else { STILL };
            let at = if is_planar { [0.0, 0.0, -0.5 * width] } else { [0.0, -0.5 * width, 0.0] };
            self.fixed(hub, (at, turned, [radius, width, radius]), Primitive::Cylinder, None, &force.name);
        } else if let [from, to, ..] = &force.ends[..] {
            self.link(from, to, 0.5 * self.radius, None, &force.name);
        }
    }

    /// A rod between two places, which moves by itself unless both are in one frame.
    fn link(&mut self, from: &FramePoint, to: &FramePoint, radius: f64, color: Option<usize>, name: &str) {
        if from.frame == to.frame {
            let ends = between(from.at.map(f64::from), to.at.map(f64::from), radius);
            self.glb.fixed_node(self.frames[from.frame], name, ends, (Primitive::Cylinder, color));
            return;
        }
        let ends = |k: usize| {
            between(
                self.glb.position(self.frames[from.frame], k, from.at),
                self.glb.position(self.frames[to.frame], k, to.at),
                radius,
            )
        };
        let placements: Vec<Placement> = (0..self.scenes.len()).map(ends).collect();
        self.glb.moving_node(name, placements, Some((Primitive::Cylinder, color)));
    }

    /// Something at a place, in its axes.
    fn fixed(&mut self, place: &FramePoint, placement: Placement, mesh: Primitive, color: Option<usize>, name: &str) {
        let (at, rotation, scale) = placement;
        let axes = place.rotation.map_or([1.0, 0.0, 0.0, 0.0], |rotation| rotation.map(f64::from));
        let [x, y, z, w] = rotation;
        let both = xyzw(quaternion_product(&axes, &[w, x, y, z]));
        let offset = turned(xyzw(axes), at);
        let at = std::array::from_fn(|i| f64::from(place.at[i]) + offset[i]);
        self.glb.fixed_node(self.frames[place.frame], name, (at, both, scale), (mesh, color));
    }

    fn solid(&mut self, body: &BodyPart, solid: &Solid, color: Option<usize>) {
        let rotation = Some(solid.rotation.map(|x| x as f32));
        let place = FramePoint { frame: body.frame, at: solid.at.map(|x| x as f32), rotation };
        for (placement, mesh) in solid_pieces(&solid.form, self.radius) {
            self.fixed(&place, placement, mesh, color, &body.name);
        }
    }
}

/// Returns the pieces that a shape is drawn with; what has no thickness is `thin`.
fn solid_pieces(form: &Form, thin: f64) -> Vec<(Placement, Primitive)> {
    let thick = |size: f64| if size > 0.0 { size } else { thin };
    let along_z = |radius: f64, length: f64| {
        ([0.0, 0.0, -0.5 * length], [FRAC_1_SQRT_2, 0.0, 0.0, FRAC_1_SQRT_2], [radius, length, radius])
    };
    match form {
        Form::Box(edges) => vec![(([0.0; 3], STILL, edges.map(thick)), Primitive::Cube)],
        Form::Tube([outer, _, length]) => vec![(along_z(*outer, thick(*length)), Primitive::Cylinder)],
        Form::Sphere(radius) => vec![(([0.0; 3], STILL, [*radius; 3]), Primitive::Sphere)],
        Form::Rod(from, to, radius) => vec![(between(*from, *to, thick(*radius)), Primitive::Cylinder)],
        Form::Polygon(corners, thickness) => {
            // Its edges: it would be the only shape with a mesh of its own.
            let point = |corner: &[f64; 2]| [corner[0], corner[1], 0.0];
            let edge = |(from, to)| (between(point(from), point(to), 0.5 * thick(*thickness)), Primitive::Cylinder);
            corners.iter().zip(corners.iter().cycle().skip(1)).map(edge).collect()
        }
    }
}
