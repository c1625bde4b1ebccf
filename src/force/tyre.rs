//! Vertical tyre on a road profile.

use super::{Action, Built, ForceKernel, ForceSpec, Instant, Motion, Wheel};
use crate::body::{Build, Wrench};
use crate::error::Result;
use crate::math::expression::{Expression, Number};
use crate::math::{Rate, Scalar, Taylor};
use schemars::JsonSchema;
use serde::Deserialize;

/// Vertical force k (radius - (z - road)) + c (road' - z') at the wheel centre, along y in the plane and z in space.
#[derive(Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Tyre {
    /// Marker `body.marker` at the wheel centre.
    pub at: String,
    /// k, N/m
    pub stiffness: Number,
    /// c, N s/m. Default: zero.
    pub damping: Option<Number>,
    /// Radius without load, m.
    pub radius: Number,
    /// Height of the road under the wheel, m, an expression of t. Default: zero.
    pub road: Option<Number>,
    /// Whether the wheel may leave the road (the force is then never below zero). Default: no.
    #[serde(default)]
    pub lift_off: bool,
}

impl ForceSpec for Tyre {
    const TYPE: &'static str = "tyre";

    fn build<const D: usize>(&self, build: &Build<D>) -> Result<Built<D>> {
        let road = self.road.clone().unwrap_or(Number::Value(0.0));
        let force = Spring {
            k: build.not_negative("stiffness", &self.stiffness)?,
            c: super::spring_damper::optional_not_negative("damping", &self.damping, build)?,
            radius: build.positive("radius", &self.radius)?,
            road: build.function_of_time("road", &road)?,
            lift_off: self.lift_off.then(|| [build.switch(), build.switch()]),
        };
        Ok(Built { force: Box::new(force), markers: vec![build.marker("at", &self.at)?] })
    }
}

struct Spring {
    k: f64,
    c: f64,
    radius: f64,
    road: Expression,
    /// Numbers of the two switching functions, compression and load, if the wheel may leave the road.
    lift_off: Option<[usize; 2]>,
}

impl Spring {
    fn squeeze<S: Scalar, const D: usize>(&self, frames: &Motion<S, D>, time: Instant<S>) -> Taylor<S> {
        self.road.eval_held(&[time.t], time.regime) - frames[0].r[D - 1] + self.radius
    }

    fn load<S: Scalar>(&self, squeeze: Taylor<S>) -> S {
        squeeze.x * self.k + squeeze.d * self.c
    }
}

impl<const D: usize> ForceKernel<D> for Spring {
    fn switching(&self, frames: &Motion<Rate, D>, time: Instant<Rate>, out: &mut [Rate]) {
        self.road.arguments(&[time.t.x], time.regime, out);
        if let Some([gap, pull]) = self.lift_off {
            let squeeze = self.squeeze(frames, time);
            (out[gap], out[pull]) = (squeeze.x, self.load(squeeze));
        }
    }

    fn wheel(&self, t: f64) -> Option<Wheel> {
        Some(Wheel { radius: self.radius, road: self.road.eval(&[t]) })
    }

    fn act<S: Scalar>(&self, frames: &Motion<S, D>, time: Instant<S>, out: &mut [Wrench<S, D>]) -> Action<S> {
        let squeeze = self.squeeze(frames, time);
        let is_below = |number: usize, x: f64| time.regime.piece(number).map_or(x < 0.0, |piece| piece == 0);
        if self.lift_off.is_some_and(|[gap, _]| is_below(gap, squeeze.value())) {
            return Action::without_potential(S::zero());
        }
        let mut load = self.load(squeeze);
        // Where the damper would pull the road, the load is zero; the energy of the compressed tyre is then lost.
        if self.lift_off.is_some_and(|[_, pull]| is_below(pull, load.value())) {
            load = S::zero();
        }
        out[0].force[D - 1] = load;
        Action { potential: squeeze.square() * (0.5 * self.k), magnitude: load }
    }
}
