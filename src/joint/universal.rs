//! Universal joint (Hooke, Cardan).

use super::lock::Lock;
use super::{BuiltJoint, JointSpec};
use crate::body::Build;
use crate::error::Result;
use schemars::JsonSchema;
use serde::Deserialize;

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

    fn build<const D: usize>(&self, build: &Build<D>) -> Result<BuiltJoint<D>> {
        build.needs_dimension(3, "a universal joint", "\"revolute\"")?;
        Lock::new(&[0, 1, 2], &[(0, 1)]).between(&self.between, build)
    }
}
