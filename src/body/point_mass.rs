//! Point mass: position only, no orientation.

use super::rigid::{Initial, start_vector};
use super::{BodyFacts, BodyKernel, BodySpec, Build, BuiltBody, Energy, Frame, Freedom, Marker, Wrench};
use crate::error::{Error, Result};
use crate::math::Scalar;
use crate::math::array::from_fn;
use crate::math::expression::Number;
use schemars::JsonSchema;
use serde::Deserialize;

/// A mass without extension: two coordinates in the plane, three in space. It has no orientation, so joints that hold
/// one and torques are refused.
#[derive(Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct PointMass {
    /// kg
    pub mass: Number,
}

impl BodySpec for PointMass {
    const TYPE: &'static str = "point_mass";

    fn build<const D: usize>(
        &self,
        markers: Vec<Marker<D>>,
        initial: &Initial,
        build: &Build<D>,
    ) -> Result<BuiltBody<D>> {
        if markers.iter().any(|marker| marker.offset.iter().any(|&x| x != 0.0)) {
            return Err(Error::input("a marker of a point mass lies at the mass itself")
                .under("markers")
                .hint("use position zero, or a body of type \"rigid\""));
        }
        initial.refuse_rotation()?;
        initial.refuse_elastic()?;
        let mass = build.not_negative("mass", &self.mass)?;
        let q = start_vector::<D>("initial.position", &initial.position, build)?.to_vec();
        let v = start_vector::<D>("initial.velocity", &initial.velocity, build)?.to_vec();
        Ok(BuiltBody { body: Box::new(Particle { mass, markers }), q, v })
    }
}

/// M = m I, no velocity-dependent forces.
struct Particle<const D: usize> {
    mass: f64,
    markers: Vec<Marker<D>>,
}

impl<const D: usize> BodyKernel<D> for Particle<D> {
    fn facts(&self) -> BodyFacts {
        let names = ["x", "y", "z"].into_iter().take(D);
        let rates = ["x'", "y'", "z'"].into_iter().take(D);
        let freedom = Some(Freedom { translations: (0..D).collect(), rotations: Vec::new() });
        BodyFacts { oriented: false, freedom, has_constant_forces: true, ..BodyFacts::new(names, rates) }
    }
    fn markers(&self) -> &[Marker<D>] {
        &self.markers
    }
    fn frame<S: Scalar>(&self, q: &[S]) -> Frame<S, D> {
        Frame { r: from_fn(|i| q[i]), ..Frame::world() }
    }
    fn pull_back<S: Scalar>(&self, _q: &[S], _frame: &Frame<S, D>, wrench: &Wrench<S, D>, f: &mut [S]) {
        f.iter_mut().zip(wrench.force).for_each(|(f, w)| *f += w);
    }
    fn mass(&self, values: &mut [f64]) {
        values.fill(self.mass);
    }
    fn own_forces<S: Scalar>(&self, _q: &[S], _v: &[S], gravity: &[f64; D], f: &mut [S]) {
        f.iter_mut().zip(gravity).for_each(|(f, g)| *f += S::constant(self.mass * g));
    }
    fn energy<S: Scalar>(&self, q: &[S], v: &[S], gravity: &[f64; D]) -> Energy<S> {
        let square = v.iter().fold(S::zero(), |sum, &v| sum + v * v);
        let height = q.iter().zip(gravity).fold(S::zero(), |sum, (&q, g)| sum - q * *g);
        Energy { kinetic: square * (0.5 * self.mass), potential: height * self.mass }
    }
}
