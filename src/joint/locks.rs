//! The joints that lock some translations and rotations between two markers.

use super::lock::{ALL, ALL_BUT_Z, ALL_IN_PLANE, Lock, NONE, direction};
use super::{Built, JointSpec};
use crate::body::Build;
use crate::error::Result;
use crate::math::expression::Number;
use schemars::JsonSchema;
use serde::Deserialize;

/// Hinge: the markers' origins coincide; in space their z axes too. 2 rows in the plane, 5 in space; no singular
/// configuration of its own.
#[derive(Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Revolute {
    /// Markers `body.marker` of two bodies.
    pub between: [String; 2],
    /// In space: the hinge axis in both markers. Default: their z axes.
    pub axis: Option<Vec<Number>>,
}

impl JointSpec for Revolute {
    const TYPE: &'static str = "revolute";

    fn build<const D: usize>(&self, build: &Build<D>) -> Result<Built<D>> {
        match D {
            2 => Lock::new(&[0, 1], NONE).between(&self.between, build),
            _ => Lock::new(&[0, 1, 2], ALL_BUT_Z).along(2, direction(build, &self.axis)?).between(&self.between, build),
        }
    }
}

/// Slider: the second marker moves along an axis of the first and does not turn against it. The axis is the markers'
/// x axis in the plane, z axis in space, or `axis`. 2 rows in the plane, 5 in space.
#[derive(Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Prismatic {
    /// Markers `body.marker` of two bodies.
    pub between: [String; 2],
    /// Sliding direction in both markers.
    pub axis: Option<Vec<Number>>,
}

impl JointSpec for Prismatic {
    const TYPE: &'static str = "prismatic";

    fn build<const D: usize>(&self, build: &Build<D>) -> Result<Built<D>> {
        let axis = direction(build, &self.axis)?;
        match D {
            2 => Lock::new(&[1], ALL_IN_PLANE).along(0, axis).between(&self.between, build),
            _ => Lock::new(&[0, 1], ALL).along(2, axis).between(&self.between, build),
        }
    }
}

/// The second marker slides along and turns about the z axis of the first. 4 rows; in space only.
#[derive(Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Cylindrical {
    /// Markers `body.marker` of two bodies.
    pub between: [String; 2],
    /// The common axis in both markers. Default: their z axes.
    pub axis: Option<Vec<Number>>,
}

impl JointSpec for Cylindrical {
    const TYPE: &'static str = "cylindrical";

    fn build<const D: usize>(&self, build: &Build<D>) -> Result<Built<D>> {
        build.needs_dimension(3, "a cylindrical joint", "\"point_on_line\"")?;
        Lock::new(&[0, 1], ALL_BUT_Z).along(2, direction(build, &self.axis)?).between(&self.between, build)
    }
}

/// The origins coincide, and the x axis of the first marker (one pin of the cross) stays at right angles to the y axis
/// of the second (the other pin). 4 rows; in space only. Singular where the two pins' yokes fold to 90 degrees.
#[derive(Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Universal {
    /// Markers `body.marker` of two bodies.
    pub between: [String; 2],
}

impl JointSpec for Universal {
    const TYPE: &'static str = "universal";

    fn build<const D: usize>(&self, build: &Build<D>) -> Result<Built<D>> {
        build.needs_dimension(3, "a universal joint", "\"revolute\"")?;
        Lock::new(&[0, 1, 2], &[(0, 1)]).between(&self.between, build)
    }
}

/// Ball joint: the markers' origins coincide. 3 rows; in space only.
#[derive(Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Spherical {
    /// Markers `body.marker` of two bodies.
    pub between: [String; 2],
}

impl JointSpec for Spherical {
    const TYPE: &'static str = "spherical";

    fn build<const D: usize>(&self, build: &Build<D>) -> Result<Built<D>> {
        build.needs_dimension(3, "a spherical joint", "\"revolute\"")?;
        Lock::new(&[0, 1, 2], NONE).between(&self.between, build)
    }
}

/// The second marker moves in the x-y plane of the first and turns about its z axis. 3 rows; in space only.
#[derive(Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Planar {
    /// Markers `body.marker` of two bodies.
    pub between: [String; 2],
    /// Normal of the plane in both markers. Default: their z axes.
    pub axis: Option<Vec<Number>>,
}

impl JointSpec for Planar {
    const TYPE: &'static str = "planar";

    fn build<const D: usize>(&self, build: &Build<D>) -> Result<Built<D>> {
        build.needs_dimension(3, "a planar joint", "no joint: every body moves in the plane")?;
        Lock::new(&[2], ALL_BUT_Z).along(2, direction(build, &self.axis)?).between(&self.between, build)
    }
}

/// The markers coincide in position and orientation. 3 rows in the plane, 6 in space.
#[derive(Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Weld {
    /// Markers `body.marker` of two bodies.
    pub between: [String; 2],
}

impl JointSpec for Weld {
    const TYPE: &'static str = "weld";

    fn build<const D: usize>(&self, build: &Build<D>) -> Result<Built<D>> {
        match D {
            2 => Lock::new(&[0, 1], ALL_IN_PLANE).between(&self.between, build),
            _ => Lock::new(&[0, 1, 2], ALL).between(&self.between, build),
        }
    }
}

/// The origin of the second marker stays on a line through the first: its x axis in the plane, z axis in space, or
/// `axis`. 1 row in the plane, 2 in space.
#[derive(Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct PointOnLine {
    /// Markers `body.marker`: the line's, then the point's.
    pub between: [String; 2],
    /// Direction of the line in the first marker.
    pub axis: Option<Vec<Number>>,
}

impl JointSpec for PointOnLine {
    const TYPE: &'static str = "point_on_line";

    fn build<const D: usize>(&self, build: &Build<D>) -> Result<Built<D>> {
        let axis = direction(build, &self.axis)?;
        match D {
            2 => Lock::new(&[1], NONE).along(0, axis).between(&self.between, build),
            _ => Lock::new(&[0, 1], NONE).along(2, axis).between(&self.between, build),
        }
    }
}
