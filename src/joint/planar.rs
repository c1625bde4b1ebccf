//! Planar joint.

use super::lock::{ALL_BUT_Z, Lock, direction};
use super::{BuiltJoint, JointSpec};
use crate::body::Build;
use crate::error::Result;
use crate::math::expression::Number;
use schemars::JsonSchema;
use serde::Deserialize;

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

    fn build<const D: usize>(&self, build: &Build<D>) -> Result<BuiltJoint<D>> {
        build.needs_dimension(3, "a planar joint", "no joint: every body moves in the plane")?;
        Lock::new(&[2], ALL_BUT_Z).along(2, direction(build, &self.axis)?).between(&self.between, build)
    }
}
