//! Poses of a mechanism over time.

use super::encode::Floats;
use super::parts::{PageParts, Source, line_points};
use crate::math::rotation::quaternion_from_axes;
use crate::report::mechanism::{Pose, Snapshot};
use serde::Serialize;

/// Rows of numbers at some times, in the order of the parts of the mechanism.
#[derive(Clone, Debug, Default, Serialize)]
pub struct Clip {
    /// Times, s.
    pub t: Floats,
    /// Of each frame x, y and angle in the plane; position and quaternion [x, y, z, w] in space.
    pub poses: Floats,
    /// Points of the lines of beams, x and y in the plane.
    pub lines: Floats,
    /// Size of the force in each joint, N; empty where it is not known.
    pub reactions: Floats,
    /// Height of the road under each tyre, m.
    pub roads: Floats,
    /// Forces of elements of type `applied_force`, N.
    pub arrows: Floats,
}

impl Clip {
    /// Adds a row; `reactions` has a value for each joint of the scene, or none.
    pub fn add(&mut self, parts: &PageParts, t: f64, scene: &Snapshot, reactions: &[f64]) {
        self.t.push(t);
        for source in &parts.sources {
            self.add_pose(&pose(scene, *source), scene.is_planar);
        }
        let dimension = if scene.is_planar { 2 } else { 3 };
        for body in &parts.lines {
            line_points(&scene.limbs[*body].line)
                .for_each(|point| self.lines.extend(point[..dimension].iter().copied()));
        }
        self.reactions.extend(parts.joint_numbers.iter().filter_map(|joint| reactions.get(*joint).copied()));
        for force in parts.force_numbers.iter().map(|force| &scene.forces[*force]) {
            self.roads.extend(force.wheel.map(|wheel| wheel.road));
            if force.kind == "applied_force" {
                self.arrows.extend(force.force);
            }
        }
    }

    fn add_pose(&mut self, pose: &Pose, is_planar: bool) {
        let [x, y, z] = pose.r;
        if is_planar {
            let [c, s, _] = pose.axes[0];
            self.poses.extend([x, y, s.atan2(c)]);
        } else {
            let [qw, qx, qy, qz] = quaternion_from_axes(&pose.axes);
            self.poses.extend([x, y, z, qx, qy, qz, qw]);
        }
    }

    /// Number of values.
    pub fn len(&self) -> usize {
        let lists = [&self.t, &self.poses, &self.lines, &self.reactions, &self.roads, &self.arrows];
        lists.iter().map(|list| list.0.len()).sum()
    }
}

/// Returns the pose of a frame.
pub fn pose(scene: &Snapshot, source: Source) -> Pose {
    let axes = [[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]];
    match source {
        Source::Body(body) => scene.limbs[body].centre,
        Source::End(true, force, end) => scene.forces[force].ends[end],
        Source::End(false, joint, end) => scene.joints[joint].ends[end],
        // Points of an outline that meet are one.
        Source::Point(body, point) => {
            let limb = &scene.limbs[body];
            Pose { r: limb.points.get(point).copied().unwrap_or(limb.centre.r), axes }
        }
        Source::Marker(marker) => scene.markers[marker],
    }
}
