//! Prismatic joint (slider).

use super::lock::{ALL, Lock, direction};
use super::{BuiltJoint, JointSpec};
use crate::body::Build;
use crate::error::Result;
use crate::math::expression::Number;
use schemars::JsonSchema;
use serde::Deserialize;

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

    fn build<const D: usize>(&self, build: &Build<D>) -> Result<BuiltJoint<D>> {
        let axis = direction(build, &self.axis)?;
        match D {
            2 => Lock::new(&[1], ALL_IN_PLANE).along(0, axis).between(&self.between, build),
            _ => Lock::new(&[0, 1], ALL).along(2, axis).between(&self.between, build),
        }
    }
}

/// In the plane one row locks the angle.
pub const ALL_IN_PLANE: &[(usize, usize)] = &[(0, 1)];
