//! Driver: a relative coordinate prescribed as a function of time.

use super::lock::{Lock, NONE, direction};
use super::{Axis, BuiltJoint, JointKernel, JointSpec};
use crate::body::{Build, Frame, dot, in_space, sub};
use crate::error::{Error, Result};
use crate::math::expression::{Expression, Number};
use crate::math::{Rate, Scalar, Time};
use schemars::JsonSchema;
use serde::Deserialize;

/// Prescribes a coordinate of the second marker against the first as a function of t; its rate and acceleration follow
/// exactly. 1 row, coordinate - value(t). The multiplier is the force or torque that the drive takes up. An input of the
/// scene may add to the value.
#[derive(Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Driver {
    /// Markers `body.marker`: the reference (often on the ground), then the one that is driven.
    pub between: [String; 2],
    pub coordinate: Coordinate,
    /// m or rad, an expression of t.
    pub value: Number,
    /// In space: the axis of rotation for `angle`, in both markers. Default: their z axes.
    pub axis: Option<Vec<Number>>,
}

/// x, y and z are along the axes of the first marker.
#[derive(Deserialize, JsonSchema, Clone, Copy, PartialEq, Eq)]
#[serde(rename_all = "snake_case")]
pub enum Coordinate {
    X,
    Y,
    Z,
    Angle,
    Distance,
}

impl JointSpec for Driver {
    const TYPE: &'static str = "driver";

    fn build<const D: usize>(&self, build: &Build<D>) -> Result<BuiltJoint<D>> {
        if D == 2 && self.coordinate == Coordinate::Z {
            return Err(Error::input("a planar scene has no z").under("coordinate").hint("use x, y or angle"));
        }
        let markers = build.between(&self.between)?;
        if self.coordinate == Coordinate::Angle {
            build.oriented("between", &markers)?;
        }
        let value = build.function_of_time("value", &self.value)?;
        let axes = match D {
            2 => Lock::new(&[], NONE),
            _ => Lock::new(&[], NONE).along(2, direction(build, &self.axis)?),
        };
        Ok(BuiltJoint { joint: Box::new(Drive { coordinate: self.coordinate, value, axes }), markers })
    }
}

struct Drive<const D: usize> {
    coordinate: Coordinate,
    value: Expression,
    axes: Lock<D>,
}

impl<const D: usize> JointKernel<D> for Drive<D> {
    fn row_names(&self) -> Vec<&'static str> {
        vec![match self.coordinate {
            Coordinate::X => "x",
            Coordinate::Y => "y",
            Coordinate::Z => "z",
            Coordinate::Angle => "angle",
            Coordinate::Distance => "length",
        }]
    }

    fn depends_on_time(&self) -> bool {
        true
    }

    fn joint_axis(&self, first: &Frame<f64, D>) -> Option<Axis> {
        let along = |i: usize| Some(Axis::Along(in_space(&first.axes[i])));
        match self.coordinate {
            Coordinate::X => along(0),
            Coordinate::Y => along(1),
            Coordinate::Z => along(D - 1),
            Coordinate::Distance => None,
            Coordinate::Angle if D == 2 => Some(Axis::Turn([0.0, 0.0, 1.0])),
            Coordinate::Angle => Some(Axis::Turn(in_space(&self.axes.axis(first, 2)))),
        }
    }

    fn switching(&self, _frames: &[Frame<Rate, D>], time: Time<Rate>, out: &mut [Rate]) {
        self.value.arguments(&[time.t], time.regime, out);
    }

    fn prescribes(&self) -> bool {
        true
    }

    fn prescribed(&self, t: f64) -> Option<f64> {
        Some(self.value.eval(&[t]))
    }

    fn phi<S: Scalar>(&self, frames: &[Frame<S, D>], time: Time<S>, out: &mut [S]) {
        JointKernel::<D>::driven(self, S::zero(), frames, time, out);
    }

    fn driven<S: Scalar>(&self, input: S, frames: &[Frame<S, D>], time: Time<S>, out: &mut [S]) {
        let [a, b] = [&frames[0], &frames[1]];
        let value = self.value.eval_held(&[time.t], time.regime) + input;
        let gap = sub(&b.r, &a.r);
        out[0] = match self.coordinate {
            Coordinate::X => dot(&a.axes[0], &gap) - value,
            Coordinate::Y => dot(&a.axes[1], &gap) - value,
            Coordinate::Z => dot(&a.axes[D - 1], &gap) - value,
            Coordinate::Distance => dot(&gap, &gap).sqrt() - value,
            Coordinate::Angle if D == 2 => b.turn - a.turn - value,
            Coordinate::Angle => angle_beyond(relative_turn(&self.axes, a, b), value),
        };
    }
}

/// The angle of this cosine and sine less `value`, within half a turn: no difference of two atan2, which jumps.
pub fn angle_beyond<S: Scalar>(cosine_and_sine: (S, S), value: S) -> S {
    let (c, s) = cosine_and_sine;
    let (sine, cosine) = value.sin_cos();
    S::atan2(s * cosine - c * sine, c * cosine + s * sine)
}

/// Cosine and sine of the angle of B relative to A about A's joint axis.
pub fn relative_turn<S: Scalar, const D: usize>(axes: &Lock<D>, a: &Frame<S, D>, b: &Frame<S, D>) -> (S, S) {
    let x = axes.axis(b, 0);
    (dot(&axes.axis(a, 0), &x), dot(&axes.axis(a, 1), &x))
}
