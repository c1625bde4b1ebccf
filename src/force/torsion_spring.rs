//! Torsion spring and damper.

use super::law::Law;
use super::spring_damper::optional_not_negative;
use super::{Action, BuiltForce, ForceKernel, ForceSpec, Instant, Motion};
use crate::body::{Build, Frame, MarkerId, Probe, Quantity, Turned, Wrench, cross, dot};
use crate::error::Result;
use crate::math::array::{Each, from_fn};
use crate::math::expression::Number;
use crate::math::{Rate, Scalar, Taylor};
use schemars::JsonSchema;
use serde::Deserialize;

/// Torque -(k (angle - free_angle) + c angle') on the second marker and its opposite on the first. The angle is that
/// of the second marker against the first; counted through full turns; in space about the first one's z axis, and within half a turn of
/// free_angle at the start.
/// Where the markers' z axes do not coincide, the torque is along the gradient of the angle, so that the spring gives
/// back what it takes.
#[derive(Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct TorsionSpring {
    /// Markers `body.marker` of two bodies.
    pub between: [String; 2],
    /// k, N m/rad. Default: zero.
    pub stiffness: Option<Number>,
    /// c, N m s/rad. Default: zero.
    pub damping: Option<Number>,
    /// rad. Default: zero.
    pub free_angle: Option<Number>,
    /// Instead of stiffness and damping: the torque against growing angles, N m, an expression of `angle`, rad, its
    /// `rate`, rad/s, t, marker quantities and outputs by name, such as "k*angle^3 + c*rate"; free_angle says near which
    /// turn the angle begins. It has no potential in the energy: what it stores counts as work that it takes.
    pub law: Option<Number>,
}

impl ForceSpec for TorsionSpring {
    const TYPE: &'static str = "torsion_spring";

    fn build<const D: usize>(&self, build: &Build<D>) -> Result<BuiltForce<D>> {
        let markers = build.between(&self.between)?;
        build.oriented("between", &markers)?;
        let free = build.number_or("free_angle", &self.free_angle, 0.0)?;
        let turning = build.turning(vec![Turned { of: markers[1], to: markers[0], factor: 1.0, axes: None }], free);
        if let Some(law) = &self.law {
            return self.by_law(law, free, turning, &markers, build);
        }
        let force = Torsion {
            k: optional_not_negative("stiffness", &self.stiffness, build)?,
            c: optional_not_negative("damping", &self.damping, build)?,
            free,
            turning,
        };
        Ok(BuiltForce { force: Box::new(force), markers })
    }
}

impl TorsionSpring {
    fn by_law<const D: usize>(
        &self,
        law: &Number,
        start: f64,
        turning: usize,
        ends: &[MarkerId],
        build: &Build<D>,
    ) -> Result<BuiltForce<D>> {
        let given = [("stiffness", self.stiffness.is_some()), ("damping", self.damping.is_some())];
        let quantity = match D {
            2 => Quantity::Angle,
            _ => Quantity::Turn { turning, start, factor: 1.0, axes: None },
        };
        let angle = Probe::new(ends[1], ends[0], quantity, 0);
        let law = Law::read(law, &given, "angle", angle, ends, build)?;
        let markers = law.markers().to_vec();
        Ok(BuiltForce { force: Box::new(Lawful { law }), markers })
    }
}

struct Torsion {
    k: f64,
    c: f64,
    free: f64,
    /// Index of the counted angle, in space.
    turning: usize,
}

impl<const D: usize> ForceKernel<D> for Torsion {
    fn depends_on_velocities(&self) -> bool {
        self.c > 0.0
    }

    fn is_torque(&self) -> bool {
        true
    }

    fn act<S: Scalar>(&self, frames: &Motion<S, D>, time: Instant<S>, out: &mut [Wrench<S, D>]) -> Action<S> {
        let [a, b] = [&frames[0], &frames[1]];
        let (twist, axis) = if D == 2 {
            (b.turn - a.turn - self.free, [S::zero(), S::zero(), S::one()])
        } else {
            let (c, s) = cos_sin(a, b);
            let angle = time.regime.angle(self.turning, Taylor::atan2(s, c), self.free);
            (angle - self.free, gradient(a, b, c.x, s.x))
        };
        let torque = -(twist.x * self.k + twist.d * self.c);
        out[0].torque = axis.each(|x| -(x * torque));
        out[1].torque = axis.each(|x| x * torque);
        Action { potential: twist.square() * (0.5 * self.k), magnitude: torque }
    }
}

/// A torsion spring whose torque is an expression.
struct Lawful {
    law: Law,
}

impl<const D: usize> ForceKernel<D> for Lawful {
    fn is_torque(&self) -> bool {
        true
    }

    fn acted(&self, _markers: usize) -> usize {
        2
    }

    fn act<S: Scalar>(&self, frames: &Motion<S, D>, time: Instant<S>, out: &mut [Wrench<S, D>]) -> Action<S> {
        let [a, b] = [&frames[0], &frames[1]];
        let axis = if D == 2 {
            [S::zero(), S::zero(), S::one()]
        } else {
            let (c, s) = cos_sin(a, b);
            gradient(a, b, c.x, s.x)
        };
        let torque = -self.law.value(frames, time);
        out[0].torque = axis.each(|x| -(x * torque));
        out[1].torque = axis.each(|x| x * torque);
        Action::without_potential(torque)
    }

    fn switching(&self, _input: &[Taylor<Rate>; 3], frames: &Motion<Rate, D>, time: Instant<Rate>, out: &mut [Rate]) {
        self.law.switching(frames, time, out);
    }
}

/// c = a_x . b_x and s = a_y . b_x
fn cos_sin<S: Scalar, const D: usize>(a: &Frame<Taylor<S>, D>, b: &Frame<Taylor<S>, D>) -> (Taylor<S>, Taylor<S>) {
    (dot(&a.axes[0], &b.axes[0]), dot(&a.axes[1], &b.axes[0]))
}

/// d(angle)/d(rotation of b) for the angle atan2(s, c), s = a_y . b_x and c = a_x . b_x: b_x x (c a_y - s a_x)/(c^2 + s^2).
fn gradient<S: Scalar, const D: usize>(a: &Frame<Taylor<S>, D>, b: &Frame<Taylor<S>, D>, c: S, s: S) -> [S; 3] {
    let square = c * c + s * s;
    let normal = from_fn(|i| (a.axes[1][i].x * c - a.axes[0][i].x * s) / square);
    cross::<S, D>(&b.axes[0].each(|x| x.x), &normal)
}
