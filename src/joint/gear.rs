//! Gear pair.

use super::driver::relative_turn;
use super::lock::{Lock, NONE};
use super::{BuiltJoint, JointKernel, JointSpec};
use crate::body::{Build, Frame, Turned};
use crate::error::{Error, Result};
use crate::math::expression::Number;
use crate::math::{Scalar, Time};
use schemars::JsonSchema;
use serde::Deserialize;

/// Two wheels roll on each other: z1 angle1 + z2 angle2 = offset with the numbers of teeth z1, z2 (negative for an
/// internal gear). Angles are those of the wheels' markers against the carrier's. 1 row, divided by z1, in radians.
#[derive(Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Gear {
    /// Markers `body.marker` of the two wheels.
    pub between: [String; 2],
    /// Numbers of teeth, whole and not zero.
    pub teeth: [Number; 2],
    /// Markers against which the wheels turn; in space about their z axes. Default in the plane: the ground.
    pub carrier: Option<[String; 2]>,
    /// rad. Default: zero.
    pub offset: Option<Number>,
}

impl JointSpec for Gear {
    const TYPE: &'static str = "gear";

    fn build<const D: usize>(&self, build: &Build<D>) -> Result<BuiltJoint<D>> {
        let teeth = [self.count(0, build)?, self.count(1, build)?];
        let mut markers = build.between(&self.between)?;
        match &self.carrier {
            Some(carrier) => {
                markers.push(build.marker("carrier[0]", &carrier[0])?);
                markers.push(build.marker("carrier[1]", &carrier[1])?);
                self.refuse_wheels_of_carrier(&markers, build)?;
            }
            None if D == 2 => {}
            None => {
                return Err(Error::input("the key `carrier` is missing")
                    .hint("in space name two markers whose z axes are the axes of the wheels"));
            }
        }
        build.oriented("between", &markers)?;
        let offset = build.number_or("offset", &self.offset, 0.0)?;
        let wheel = |i: usize| Some(Turned { of: markers[i], to: *markers.get(i + 2)?, factor: teeth[i], axes: None });
        let turning = build.turning((0..2).filter_map(wheel).collect(), offset);
        Ok(BuiltJoint { joint: Box::new(GearPair { teeth, offset, turning }), markers })
    }
}

impl Gear {
    /// The number of teeth of a wheel.
    fn count<const D: usize>(&self, wheel: usize, build: &Build<D>) -> Result<f64> {
        let field = format!("teeth[{wheel}]");
        let teeth = build.number(&field, &self.teeth[wheel])?;
        if teeth.fract() == 0.0 && (1.0..=MOST_TEETH).contains(&teeth.abs()) {
            return Ok(teeth);
        }
        Err(Error::input(format!("a wheel cannot have {teeth} teeth"))
            .under(field)
            .hint("give a whole number, not zero; it is negative for an internal gear"))
    }

    /// A wheel that is one body with its carrier never turns against it.
    fn refuse_wheels_of_carrier<const D: usize>(&self, markers: &[usize], build: &Build<D>) -> Result<()> {
        let body = |marker: usize| build.markers.bodies[markers[marker]];
        let Some(wheel) = (0..2).find(|wheel| body(*wheel) == body(wheel + 2)) else { return Ok(()) };
        let name = self.between[wheel].split('.').next().unwrap_or_default();
        Err(Error::input(format!("the wheel `{name}` is its own carrier, so it does not turn against it"))
            .under(format!("carrier[{wheel}]"))
            .hint("name a marker of the body that the wheel turns on"))
    }
}

/// More would be a mistake.
const MOST_TEETH: f64 = 1e6;

struct GearPair {
    teeth: [f64; 2],
    offset: f64,
    /// Index of the counted angle z1 angle1 + z2 angle2, in space.
    turning: usize,
}

impl<const D: usize> JointKernel<D> for GearPair {
    fn row_names(&self) -> Vec<&'static str> {
        vec!["angle"]
    }

    fn depends_on_time(&self) -> bool {
        false
    }

    fn phi<S: Scalar>(&self, frames: &[Frame<S, D>], time: Time<S>, out: &mut [S]) {
        let [z1, z2] = self.teeth;
        if D == 2 {
            let turn = |i: usize| frames.get(i + 2).map_or(frames[i].turn, |carrier| frames[i].turn - carrier.turn);
            out[0] = (turn(0) * z1 + turn(1) * z2 - self.offset) / z1;
            return;
        }
        let axes = Lock::new(&[], NONE);
        let angle = |i: usize| {
            let (c, s) = relative_turn(&axes, &frames[i + 2], &frames[i]);
            S::atan2(s, c)
        };
        // A full turn of a wheel adds 2 pi z: the wheels begin in the gap between teeth that is nearest, and stay in it.
        let sum = time.regime.angle(self.turning, angle(0) * z1 + angle(1) * z2, self.offset);
        out[0] = (sum - self.offset) / z1;
    }
}
