//! Point on a line.

use super::lock::{Lock, NONE, direction};
use super::{BuiltJoint, JointSpec};
use crate::body::Build;
use crate::error::Result;
use crate::math::expression::Number;
use schemars::JsonSchema;
use serde::Deserialize;

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

    fn build<const D: usize>(&self, build: &Build<D>) -> Result<BuiltJoint<D>> {
        let axis = direction(build, &self.axis)?;
        match D {
            2 => Lock::new(&[1], NONE).along(0, axis).between(&self.between, build),
            _ => Lock::new(&[0, 1], NONE).along(2, axis).between(&self.between, build),
        }
    }
}
