//! Massless rod: a fixed distance between two points.

use super::{BuiltJoint, ClosedForm, JointKernel, JointSpec};
use crate::body::{Build, Frame, dot, sub};
use crate::error::Result;
use crate::math::expression::Number;
use crate::math::{Scalar, Time};
use schemars::JsonSchema;
use serde::Deserialize;

/// Massless rod of given length. 1 row, |r_B - r_A| - length: in metres like its neighbours, so that its multiplier is
/// the force in the rod (tension positive).
#[derive(Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Distance {
    /// Markers `body.marker` of two bodies.
    pub between: [String; 2],
    /// m, above zero.
    pub length: Number,
}

impl JointSpec for Distance {
    const TYPE: &'static str = "distance";

    fn build<const D: usize>(&self, build: &Build<D>) -> Result<BuiltJoint<D>> {
        let length = build.positive("length", &self.length)?;
        Ok(BuiltJoint { joint: Box::new(MasslessRod { length }), markers: build.between(&self.between)? })
    }
}

struct MasslessRod {
    length: f64,
}

impl<const D: usize> JointKernel<D> for MasslessRod {
    fn row_names(&self) -> Vec<&'static str> {
        vec!["length"]
    }

    fn depends_on_time(&self) -> bool {
        false
    }

    fn closed_form(&self) -> Option<ClosedForm<D>> {
        Some(ClosedForm::Rod(self.length))
    }

    #[inline]
    fn phi<S: Scalar>(&self, frames: &[Frame<S, D>], _: Time<S>, out: &mut [S]) {
        let gap = sub(&frames[1].r, &frames[0].r);
        out[0] = dot(&gap, &gap).sqrt() - self.length;
    }
}
