//! Spring and damper along the line between two points.

use super::law::Law;
use super::{Action, BuiltForce, ForceKernel, ForceSpec, Instant, Motion};
use crate::body::{Build, Probe, Quantity, Wrench, dot, norm, sub};
use crate::error::Result;
use crate::math::array::Each;
use crate::math::expression::Number;
use crate::math::{Rate, Scalar, Side, Taylor};
use crate::tolerances;
use schemars::JsonSchema;
use serde::Deserialize;

/// Tension k (l - free_length) + c l' - preload along the line between two markers; its direction is undefined at
/// l = 0, unless free_length and preload are zero and there is no damping. Or a tension by any law.
#[derive(Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct SpringDamper {
    /// Markers `body.marker` of two bodies.
    pub between: [String; 2],
    /// k, N/m. Default: zero.
    pub stiffness: Option<Number>,
    /// c, N s/m. Default: zero.
    pub damping: Option<Number>,
    /// Length without force (with preload: the length at which the force is the preload), m. Default: zero.
    pub free_length: Option<Number>,
    /// Force that pushes the markers apart at free_length, N. Default: zero.
    pub preload: Option<Number>,
    /// Instead of these: the tension, N, positive where it pulls, an expression of `length`, m, its `rate`, m/s, t, marker
    /// quantities and outputs by name, such as "k*(length - l0)^3 + c*rate". It has no potential in the energy: what it
    /// stores counts as work that it takes.
    pub law: Option<Number>,
}

impl ForceSpec for SpringDamper {
    const TYPE: &'static str = "spring_damper";

    fn build<const D: usize>(&self, build: &Build<D>) -> Result<BuiltForce<D>> {
        if let Some(law) = &self.law {
            return self.by_law(law, build);
        }
        let mut force = Spring {
            line: None,
            k: optional_not_negative("stiffness", &self.stiffness, build)?,
            c: optional_not_negative("damping", &self.damping, build)?,
            free: optional_not_negative("free_length", &self.free_length, build)?,
            preload: build.number_or("preload", &self.preload, 0.0)?,
        };
        if force.k * force.free + force.preload != 0.0 {
            force.line = Some(build.held());
        }
        Ok(BuiltForce { force: Box::new(force), markers: build.between(&self.between)? })
    }
}

impl SpringDamper {
    fn by_law<const D: usize>(&self, law: &Number, build: &Build<D>) -> Result<BuiltForce<D>> {
        let given = [
            ("stiffness", self.stiffness.is_some()),
            ("damping", self.damping.is_some()),
            ("free_length", self.free_length.is_some()),
            ("preload", self.preload.is_some()),
        ];
        let ends = build.between(&self.between)?;
        let length = Probe::new(ends[1], ends[0], Quantity::Distance, 0);
        let law = Law::read(law, &given, "length", length, &ends, build)?;
        let markers = law.markers().to_vec();
        Ok(BuiltForce { force: Box::new(Lawful { law }), markers })
    }
}

pub fn optional_not_negative<const D: usize>(field: &str, number: &Option<Number>, build: &Build<D>) -> Result<f64> {
    number.as_ref().map_or(Ok(0.0), |number| build.not_negative(field, number))
}

struct Spring {
    k: f64,
    c: f64,
    free: f64,
    preload: f64,
    /// Number of the piece that holds the line where both markers meet, if the force jumps there.
    line: Option<usize>,
}

impl Spring {
    /// The law along a line that is held: the gap counts as a length with a sign, by which the force passes zero
    /// without its jump. Where the gap is closed the line is that of its rate.
    fn act_along<S: Scalar, const D: usize>(
        &self,
        side: Side,
        gap: &[Taylor<S>; D],
        out: &mut [Wrench<S, D>],
    ) -> Action<S> {
        let values = gap.each(|x| x.x.value());
        let rates = gap.each(|x| x.d.value());
        let is_open =
            norm(&values) > tolerances::SIX_DIGITS * self.free.max(self.preload.abs() / self.k.max(f64::MIN_POSITIVE));
        let line = side.along(if is_open { values } else { rates });
        let length = gap.iter().zip(line).fold(Taylor::fixed(S::zero()), |sum, (x, u)| sum + *x * u);
        let stretch = length - self.free;
        let tension = stretch.x * self.k + length.d * self.c - self.preload;
        out[0].force = line.each(|u| tension * u);
        out[1].force = line.each(|u| tension * -u);
        Action { potential: stretch.square() * (0.5 * self.k) - stretch * self.preload, magnitude: tension }
    }
}

impl<const D: usize> ForceKernel<D> for Spring {
    fn gap(&self) -> Option<usize> {
        self.line
    }

    fn depends_on_velocities(&self) -> bool {
        self.c > 0.0
    }

    fn act<S: Scalar>(&self, frames: &Motion<S, D>, time: Instant<S>, out: &mut [Wrench<S, D>]) -> Action<S> {
        let gap = sub(&frames[1].r, &frames[0].r);
        if let Some(side) = self.line.and_then(|number| Side::of_piece(time.regime.piece(number)?)) {
            return self.act_along(side, &gap, out);
        }
        let square = dot(&gap, &gap);
        // Without free length, preload and damping the force is k times the gap, also where the gap closes.
        if self.free == 0.0 && self.preload == 0.0 && (self.c == 0.0 || square.value() == 0.0) {
            out[0].force = gap.each(|x| x.x * self.k);
            out[1].force = gap.each(|x| x.x * -self.k);
            let length = if square.value() == 0.0 { S::zero() } else { square.x.sqrt() };
            return Action { potential: square * (0.5 * self.k), magnitude: length * self.k };
        }
        let length = square.sqrt();
        let stretch = length - self.free;
        let tension = stretch.x * self.k + length.d * self.c - self.preload;
        out[0].force = gap.each(|x| x.x * tension / length.x);
        out[1].force = out[0].force.each(|x| -x);
        Action { potential: stretch.square() * (0.5 * self.k) - stretch * self.preload, magnitude: tension }
    }
}

/// A spring whose tension is an expression.
struct Lawful {
    law: Law,
}

impl<const D: usize> ForceKernel<D> for Lawful {
    fn acted(&self, _markers: usize) -> usize {
        2
    }

    fn act<S: Scalar>(&self, frames: &Motion<S, D>, time: Instant<S>, out: &mut [Wrench<S, D>]) -> Action<S> {
        let gap = sub(&frames[1].r, &frames[0].r).each(|x| x.x);
        let tension = self.law.value(frames, time);
        let length = norm(&gap);
        out[0].force = gap.each(|x| x * tension / length);
        out[1].force = out[0].force.each(|x| -x);
        Action::without_potential(tension)
    }

    fn switching(&self, _input: &[Taylor<Rate>; 3], frames: &Motion<Rate, D>, time: Instant<Rate>, out: &mut [Rate]) {
        self.law.switching(frames, time, out);
    }
}
