//! Weld joint.

use super::lock::{ALL, Lock};
use super::prismatic::ALL_IN_PLANE;
use super::{BuiltJoint, JointSpec};
use crate::body::Build;
use crate::error::Result;
use schemars::JsonSchema;
use serde::Deserialize;

/// The markers coincide in position and orientation. 3 rows in the plane, 6 in space.
#[derive(Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Weld {
    /// Markers `body.marker` of two bodies.
    pub between: [String; 2],
}

impl JointSpec for Weld {
    const TYPE: &'static str = "weld";

    fn build<const D: usize>(&self, build: &Build<D>) -> Result<BuiltJoint<D>> {
        match D {
            2 => Lock::new(&[0, 1], ALL_IN_PLANE).between(&self.between, build),
            _ => Lock::new(&[0, 1, 2], ALL).between(&self.between, build),
        }
    }
}
