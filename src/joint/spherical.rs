//! Spherical joint (ball).

use super::lock::{Lock, NONE};
use super::{BuiltJoint, JointSpec};
use crate::body::Build;
use crate::error::Result;
use schemars::JsonSchema;
use serde::Deserialize;

/// Ball joint: the markers' origins coincide. 3 rows; in space only.
#[derive(Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Spherical {
    /// Markers `body.marker` of two bodies.
    pub between: [String; 2],
}

impl JointSpec for Spherical {
    const TYPE: &'static str = "spherical";

    fn build<const D: usize>(&self, build: &Build<D>) -> Result<BuiltJoint<D>> {
        build.needs_dimension(3, "a spherical joint", "\"revolute\"")?;
        Lock::new(&[0, 1, 2], NONE).between(&self.between, build)
    }
}
