//! Bodies, joints and forces of a page: fixed geometry in frames that move.

use crate::body::{Solid, dot, sub};
use crate::joint::Axis;
use crate::math::rotation::quaternion_from_axes;
use crate::report::mechanism::{Limb, Link, Pose, Snapshot, Trace, pitch_radii};
use serde::Serialize;

/// A frame of which a page has the pose at each of its times.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Source {
    /// The frame of a body at its centre of mass.
    Body(usize),
    /// A marker on a body that deforms: joint or force, its number, number of the end.
    End(bool, usize, usize),
    /// A point of the outline of a body that deforms.
    Point(usize, usize),
    /// A marker whose path is drawn.
    Marker(usize),
}

/// A point with axes, fixed in a frame.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct FramePoint {
    /// 0 is the ground, others count from 1.
    pub frame: usize,
    /// Position in the frame, m.
    pub at: [f32; 3],
    /// Quaternion [w, x, y, z] of its axes in the frame; none if they are those of the frame.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub rotation: Option<[f32; 4]>,
}

/// A body.
#[derive(Clone, Debug, Serialize)]
pub struct BodyPart {
    pub name: String,
    /// Its frame, at the centre of mass.
    pub frame: usize,
    /// False for a point mass.
    pub oriented: bool,
    /// Points of its outline.
    pub points: Vec<FramePoint>,
    /// Its shapes, placed from the centre of mass; empty where the scene gives none.
    pub solids: Vec<Solid>,
    /// Number of the points of its line, for a beam; else 0.
    pub line: usize,
}

/// A joint or force.
#[derive(Clone, Debug, Serialize)]
pub struct LinkPart {
    pub name: String,
    pub kind: &'static str,
    pub ends: Vec<FramePoint>,
    /// Bodies of the ends; none is the ground.
    pub bodies: Vec<Option<usize>>,
    /// Axis of a joint in the axes of its first end.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub axis: Option<[f32; 3]>,
    /// Radius of a tyre, or radii of the pitch circles of a pair of gears, m.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    pub radii: Vec<f32>,
}

/// A point whose path is drawn.
#[derive(Clone, Debug, Serialize)]
pub struct TracePart {
    pub name: String,
    pub body: Option<usize>,
    pub place: FramePoint,
}

/// What a page shows of a mechanism, with the frames that it needs.
#[derive(Clone, Debug, Default)]
pub struct PageParts {
    pub sources: Vec<Source>,
    pub bodies: Vec<BodyPart>,
    /// Number of the bodies of the scene.
    pub all_bodies: usize,
    pub joints: Vec<LinkPart>,
    pub forces: Vec<LinkPart>,
    pub traces: Vec<TracePart>,
    /// Numbers of the joints, and of the forces, in the scene.
    pub joint_numbers: Vec<usize>,
    pub force_numbers: Vec<usize>,
    /// Numbers of the bodies that are drawn as lines.
    pub lines: Vec<usize>,
}

/// Largest number of points of the line of a beam.
const LINE_POINTS: usize = 25;

/// Returns the points of a line that are drawn: evenly chosen ones, with both ends.
pub fn line_points(line: &[[f64; 3]]) -> impl Iterator<Item = [f64; 3]> + '_ {
    let count = line.len().min(LINE_POINTS);
    (0..count).map(move |k| line[k * (line.len() - 1) / (count - 1).max(1)])
}

impl PageParts {
    /// Describes the first `most` bodies of a scene, and all joints and forces between these and the ground.
    pub fn new(scene: &Snapshot, solids: &[Vec<Solid>], traces: &[Trace], most: usize) -> Self {
        let mut parts = PageParts { all_bodies: scene.limbs.len(), ..PageParts::default() };
        for (i, limb) in scene.limbs.iter().enumerate().take(most) {
            parts.add_body(i, limb, &solids[i]);
        }
        let is_shown = |link: &Link| link.carriers.iter().flatten().all(|body| *body < most);
        for (is_force, links) in [(false, &scene.joints), (true, &scene.forces)] {
            for (i, link) in links.iter().enumerate().filter(|(_, link)| is_shown(link)) {
                let part = parts.link(scene, is_force, i, link);
                let (list, numbers) = if is_force {
                    (&mut parts.forces, &mut parts.force_numbers)
                } else {
                    (&mut parts.joints, &mut parts.joint_numbers)
                };
                list.push(part);
                numbers.push(i);
            }
        }
        for trace in traces.iter().filter(|trace| trace.body.is_none_or(|body| body < most)) {
            let place = parts.place(scene, trace.body, &scene.markers[trace.marker], Source::Marker(trace.marker));
            parts.traces.push(TracePart { name: trace.name.clone(), body: trace.body, place });
        }
        parts
    }

    /// Returns about how many bytes the parts take as JSON.
    pub fn bytes(&self) -> usize {
        let text = serde_json::to_string(&(&self.bodies, &self.joints, &self.forces, &self.traces));
        text.map_or(0, |text| text.len())
    }

    fn add_body(&mut self, i: usize, limb: &Limb, solids: &[Solid]) {
        let is_line = limb.line.len() > 1;
        let is_deformed = limb.is_elastic && !is_line;
        let mut points = Vec::new();
        for (k, point) in limb.points.iter().enumerate().filter(|_| !is_line) {
            points.push(if is_deformed {
                FramePoint { frame: self.frame(Source::Point(i, k)), at: [0.0; 3], rotation: None }
            } else {
                FramePoint { frame: self.frame(Source::Body(i)), at: local(&limb.centre, *point), rotation: None }
            });
        }
        let is_drawn = is_line || !limb.points.is_empty();
        let frame = if is_drawn { self.frame(Source::Body(i)) } else { 0 };
        if is_line {
            self.lines.push(i);
        }
        self.bodies.push(BodyPart {
            name: limb.name.clone(),
            frame,
            oriented: limb.oriented,
            points,
            solids: solids.to_vec(),
            line: line_points(&limb.line).count(),
        });
    }

    fn link(&mut self, scene: &Snapshot, is_force: bool, number: usize, link: &Link) -> LinkPart {
        let ends = link.ends.iter().zip(&link.carriers).enumerate();
        let ends = ends.map(|(k, (end, body))| self.place(scene, *body, end, Source::End(is_force, number, k)));
        let ends: Vec<FramePoint> = ends.collect();
        let axis =
            link.axis.zip(link.ends.first()).map(|(Axis::Along(axis) | Axis::Turn(axis), end)| in_axes(end, axis));
        let radii = match link.wheel {
            Some(wheel) => vec![wheel.radius as f32],
            None if link.kind == "gear" => {
                pitch_radii(link).map_or(Vec::new(), |radii| radii.map(|r| r as f32).to_vec())
            }
            None => Vec::new(),
        };
        LinkPart { name: link.name.clone(), kind: link.kind, ends, bodies: link.carriers.clone(), axis, radii }
    }

    /// Returns the place of a marker: in the frame of its body, or in one of its own if the body deforms.
    fn place(&mut self, scene: &Snapshot, body: Option<usize>, marker: &Pose, own: Source) -> FramePoint {
        let Some(body) = body else { return relative(0, &WORLD, marker) };
        if scene.limbs[body].is_elastic {
            return FramePoint { frame: self.frame(own), at: [0.0; 3], rotation: None };
        }
        relative(self.frame(Source::Body(body)), &scene.limbs[body].centre, marker)
    }

    /// Returns the number of a frame.
    fn frame(&mut self, source: Source) -> usize {
        // The frame that is asked for is mostly among the last ones.
        let known = self.sources.iter().rposition(|known| *known == source);
        known.unwrap_or_else(|| {
            self.sources.push(source);
            self.sources.len() - 1
        }) + 1
    }
}

const WORLD: Pose = Pose { r: [0.0; 3], axes: [[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]] };

/// Returns a vector in the axes of a frame.
fn in_axes(frame: &Pose, vector: [f64; 3]) -> [f32; 3] {
    frame.axes.map(|axis| dot(&axis, &vector) as f32)
}

/// Returns a point in a frame.
fn local(frame: &Pose, point: [f64; 3]) -> [f32; 3] {
    in_axes(frame, sub(&point, &frame.r))
}

fn relative(number: usize, frame: &Pose, marker: &Pose) -> FramePoint {
    let axes = marker.axes.map(|axis| frame.axes.map(|own| dot(&own, &axis)));
    let rotation = quaternion_from_axes(&axes).map(|x| x as f32);
    let is_turned = rotation[1..].iter().any(|x| *x != 0.0);
    FramePoint { frame: number, at: local(frame, marker.r), rotation: is_turned.then_some(rotation) }
}
