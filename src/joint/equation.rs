//! A constraint given by an expression.

use super::{BuiltJoint, JointKernel, JointSpec};
use crate::body::{Build, Formula, Frame, MOST_MARKERS};
use crate::error::{Error, Result};
use crate::math::expression::Number;
use crate::math::{Rate, Scalar, Time};
use schemars::JsonSchema;
use serde::Deserialize;

/// `expression` = 0, over t, parameters, marker coordinates such as `arm.tip.y` or `arm.angle`, and outputs that are
/// positions, distances or angles, by their names; of a joint that stands before this one. 1 row, in the units
/// of the expression. Its derivatives are exact.
#[derive(Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Equation {
    /// What is zero, such as `arm.tip.y - 0.1*sin(t)`.
    pub expression: Number,
}

impl JointSpec for Equation {
    const TYPE: &'static str = "equation";

    fn build<const D: usize>(&self, build: &Build<D>) -> Result<BuiltJoint<D>> {
        let formula = build.acting("expression", &self.expression, false)?;
        let markers = formula.markers();
        if markers.iter().all(|&marker| build.markers.bodies[marker].is_none()) {
            return Err(Error::input("the expression names no coordinate of a body")
                .under("expression")
                .hint("use marker coordinates such as `body.marker.x`"));
        }
        if markers.len() > MOST_MARKERS {
            return Err(Error::input(format!("the expression uses {} markers", markers.len()))
                .under("expression")
                .hint(format!("use at most {MOST_MARKERS}")));
        }
        Ok(BuiltJoint { joint: Box::new(GivenEquation { formula, markers: markers.clone() }), markers })
    }
}

struct GivenEquation {
    formula: Formula,
    markers: Vec<usize>,
}

impl<const D: usize> JointKernel<D> for GivenEquation {
    fn row_names(&self) -> Vec<&'static str> {
        vec!["value"]
    }

    fn depends_on_time(&self) -> bool {
        self.formula.expression.depends_on(0)
    }

    fn switching(&self, frames: &[Frame<Rate, D>], time: Time<Rate>, out: &mut [Rate]) {
        self.formula.switching_placed(time, &self.markers, frames, out);
    }

    fn phi<S: Scalar>(&self, frames: &[Frame<S, D>], time: Time<S>, out: &mut [S]) {
        out[0] = self.formula.placed(time, &self.markers, frames);
    }
}
