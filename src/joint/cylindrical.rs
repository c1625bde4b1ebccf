//! Cylindrical joint.

use super::lock::{ALL_BUT_Z, Lock, direction};
use super::{BuiltJoint, JointSpec};
use crate::body::Build;
use crate::error::Result;
use crate::math::expression::Number;
use schemars::JsonSchema;
use serde::Deserialize;

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

    fn build<const D: usize>(&self, build: &Build<D>) -> Result<BuiltJoint<D>> {
        build.needs_dimension(3, "a cylindrical joint", "\"point_on_line\"")?;
        Lock::new(&[0, 1], ALL_BUT_Z).along(2, direction(build, &self.axis)?).between(&self.between, build)
    }
}
