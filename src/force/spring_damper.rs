//! Linear spring and damper along the line between two points.

use super::{Action, Built, ForceKernel, ForceSpec, Instant, Motion};
use crate::body::{Build, Wrench, dot, sub};
use crate::error::Result;
use crate::math::Scalar;
use crate::math::expression::Number;
use schemars::JsonSchema;
use serde::Deserialize;

/// Tension k (l - free_length) + c l' - preload along the line between two markers; its direction is undefined at
/// l = 0, unless free_length and preload are zero and there is no damping.
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
}

impl ForceSpec for SpringDamper {
    const TYPE: &'static str = "spring_damper";

    fn build<const D: usize>(&self, build: &Build<D>) -> Result<Built<D>> {
        let force = Spring {
            k: optional_not_negative("stiffness", &self.stiffness, build)?,
            c: optional_not_negative("damping", &self.damping, build)?,
            free: optional_not_negative("free_length", &self.free_length, build)?,
            preload: build.number_or("preload", &self.preload, 0.0)?,
        };
        Ok(Built { force: Box::new(force), markers: build.between(&self.between)? })
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
}

impl<const D: usize> ForceKernel<D> for Spring {
    fn act<S: Scalar>(&self, frames: &Motion<S, D>, _: Instant<S>, out: &mut [Wrench<S, D>]) -> Action<S> {
        let gap = sub(&frames[1].r, &frames[0].r);
        let square = dot(&gap, &gap);
        // Without free length, preload and damping the force is k times the gap, also where the gap closes.
        if self.free == 0.0 && self.preload == 0.0 && (self.c == 0.0 || square.value() == 0.0) {
            out[0].force = gap.map(|x| x.x * self.k);
            out[1].force = gap.map(|x| x.x * -self.k);
            let length = if square.value() == 0.0 { S::zero() } else { square.x.sqrt() };
            return Action { potential: square * (0.5 * self.k), magnitude: length * self.k };
        }
        let length = square.sqrt();
        let stretch = length - self.free;
        let tension = stretch.x * self.k + length.d * self.c - self.preload;
        out[0].force = gap.map(|x| x.x * tension / length.x);
        out[1].force = out[0].force.map(|x| -x);
        Action { potential: stretch.square() * (0.5 * self.k) - stretch * self.preload, magnitude: tension }
    }
}
