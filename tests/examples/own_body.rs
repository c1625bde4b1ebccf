//! An own body: a ball in a fluid, which carries some of it along.

use holonom::Result;
use holonom::parts::{
    BodyFacts, BodyKernel, BodySpec, Build, BuiltBody, Elements, Energy, Frame, Initial, Marker, Number, Scalar,
};
use schemars::JsonSchema;
use serde::Deserialize;

/// What a scene says: a ball of this mass that moves `added` more of the fluid, and is as heavy as `mass - displaced`.
#[derive(Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct BallInFluid {
    /// kg
    mass: Number,
    added: Number,
    displaced: Number,
}

impl BodySpec for BallInFluid {
    const TYPE: &'static str = "ball_in_fluid";

    fn build<const D: usize>(
        &self,
        markers: Vec<Marker<D>>,
        start: &Initial,
        build: &Build<D>,
    ) -> Result<BuiltBody<D>> {
        let mass = build.positive("mass", &self.mass)?;
        let inertia = mass + build.not_negative("added", &self.added)?;
        let weight = mass - build.not_negative("displaced", &self.displaced)?;
        let (q, v) = start.translation(build)?;
        Ok(BuiltBody::new(Ball { inertia, weight, markers }, q.to_vec(), v.to_vec()))
    }
}

struct Ball<const D: usize> {
    inertia: f64,
    weight: f64,
    markers: Vec<Marker<D>>,
}

/// Coordinates x, y (and z in space); M = inertia I. How forces at its markers act follows from its frame.
impl<const D: usize> BodyKernel<D> for Ball<D> {
    fn facts(&self) -> BodyFacts {
        BodyFacts::new(["x", "y", "z"].into_iter().take(D), ["x'", "y'", "z'"].into_iter().take(D))
    }
    fn markers(&self) -> &[Marker<D>] {
        &self.markers
    }
    fn frame<S: Scalar>(&self, q: &[S]) -> Frame<S, D> {
        Frame { r: std::array::from_fn(|i| q[i]), ..Frame::world() }
    }
    fn mass(&self, values: &mut [f64]) {
        values.fill(self.inertia);
    }
    fn own_forces<S: Scalar>(&self, _q: &[S], _v: &[S], gravity: &[f64; D], f: &mut [S]) {
        f.iter_mut().zip(gravity).for_each(|(f, g)| *f += S::constant(self.weight * g));
    }
    fn energy<S: Scalar>(&self, q: &[S], v: &[S], gravity: &[f64; D]) -> Energy<S> {
        let square = v.iter().fold(S::zero(), |sum, v| sum + v.square());
        let potential = q.iter().zip(gravity).fold(S::zero(), |sum, (&q, g)| sum - q * (self.weight * g));
        Energy { kinetic: square * (0.5 * self.inertia), potential }
    }
}

#[test]
fn scenes_use_it_by_its_type_name() -> Result<()> {
    let elements = Elements::default().with_body::<BallInFluid>()?;
    let scene = r#"{ "name": "ball", "dimension": 2, "gravity": [0, -10],
        "bodies": [{ "name": "ball", "type": "ball_in_fluid", "mass": 3, "added": 1, "displaced": 1 }] }"#;
    let prepared = holonom::prepared::Model::new(elements.parse(scene, &[])?, &Default::default())?;
    assert_eq!(prepared.assembly.vdot, [0.0, -5.0], "(3 - 1) 10/(3 + 1)");
    Ok(())
}
