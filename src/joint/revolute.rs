//! Revolute joint (hinge).

use super::lock::{ALL_BUT_Z, Lock, NONE, direction};
use super::{BuiltJoint, JointSpec};
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

    fn build<const D: usize>(&self, build: &Build<D>) -> Result<BuiltJoint<D>> {
        match D {
            2 => Lock::new(&[0, 1], NONE).between(&self.between, build),
            _ => Lock::new(&[0, 1, 2], ALL_BUT_Z).along(2, direction(build, &self.axis)?).between(&self.between, build),
        }
    }
}
