//! Vertical tyre on a road profile.

use super::{Action, BuiltForce, ForceKernel, ForceSpec, InputKind, Instant, Motion, Wheel};
use crate::body::{Build, Formula, MOST_MARKERS, MarkerId, Wrench};
use crate::error::{Error, Result};
use crate::math::expression::Number;
use crate::math::{Rate, Scalar, Taylor};
use schemars::JsonSchema;
use serde::Deserialize;

/// Vertical force k (radius - (z - road)) + c (road' - z') at the wheel centre, along y in the plane and z in space. A
/// road over the state does work where it is not level, as one that moves does: no force along it is modelled. An
/// input of the scene may add to its height.
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
    /// Height of the road under the wheel, m, an expression of t and marker positions such as `road(wheel.x)`. Default:
    /// zero.
    pub road: Option<Number>,
    /// Whether the wheel may leave the road (the force is then never below zero). Default: no.
    #[serde(default)]
    pub lift_off: bool,
}

impl ForceSpec for Tyre {
    const TYPE: &'static str = "tyre";

    fn build<const D: usize>(&self, build: &Build<D>) -> Result<BuiltForce<D>> {
        let road = self.road.clone().unwrap_or(Number::Value(0.0));
        let road = build.acting("road", &road, false)?;
        let markers = road.markers_after(&[build.marker("at", &self.at)?]);
        if markers.len() > MOST_MARKERS {
            return Err(Error::input(format!("the tyre and its road use {} markers", markers.len()))
                .under("road")
                .hint(format!("use at most {MOST_MARKERS}")));
        }
        let force = Spring {
            k: build.not_negative("stiffness", &self.stiffness)?,
            c: super::spring_damper::optional_not_negative("damping", &self.damping, build)?,
            radius: build.positive("radius", &self.radius)?,
            road,
            markers: markers.clone(),
            lift_off: self.lift_off.then(|| [build.switch(), build.switch()]),
        };
        Ok(BuiltForce { force: Box::new(force), markers })
    }
}

struct Spring {
    k: f64,
    c: f64,
    radius: f64,
    road: Formula,
    /// That of the wheel, then those that the road reads.
    markers: Vec<MarkerId>,
    /// Numbers of the two switching functions, compression and load, if the wheel may leave the road.
    lift_off: Option<[usize; 2]>,
}

impl Spring {
    /// Height of the road, with its rate by the chain rule.
    fn height<S: Scalar, const D: usize>(&self, frames: &Motion<S, D>, time: Instant<S>) -> Taylor<S> {
        self.road.placed(time, &self.markers, frames)
    }

    fn squeeze<S: Scalar, const D: usize>(&self, frames: &Motion<S, D>, time: Instant<S>) -> Taylor<S> {
        self.height(frames, time) - frames[0].r[D - 1] + self.radius
    }

    fn load<S: Scalar>(&self, squeeze: Taylor<S>) -> S {
        squeeze.x * self.k + squeeze.d * self.c
    }
}

impl<const D: usize> ForceKernel<D> for Spring {
    fn switching(&self, input: &[Taylor<Rate>; 3], frames: &Motion<Rate, D>, time: Instant<Rate>, out: &mut [Rate]) {
        self.road.switching_at(time.map(|t| t.x), &self.markers, frames, out);
        if let Some([gap, pull]) = self.lift_off {
            let squeeze = self.squeeze(frames, time) + input[0];
            (out[gap], out[pull]) = (squeeze.x, self.load(squeeze));
        }
    }

    fn wheel(&self, frames: &Motion<f64, D>, time: Instant<f64>) -> Option<Wheel> {
        Some(Wheel { radius: self.radius, road: self.height(frames, time).x, lifts: self.lift_off.is_some() })
    }

    fn input(&self) -> InputKind {
        InputKind::Displacement { rate: self.c > 0.0 }
    }

    fn act<S: Scalar>(&self, frames: &Motion<S, D>, time: Instant<S>, out: &mut [Wrench<S, D>]) -> Action<S> {
        self.driven(&[Taylor::fixed(S::zero()); 3], frames, time, out)
    }

    fn driven<S: Scalar>(
        &self,
        input: &[Taylor<S>; 3],
        frames: &Motion<S, D>,
        time: Instant<S>,
        out: &mut [Wrench<S, D>],
    ) -> Action<S> {
        let squeeze = self.squeeze(frames, time) + input[0];
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
