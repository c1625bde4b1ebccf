//! Own copies of built-in elements against these: rigid bodies whose J^T w is left to the derivative of their frames, a
//! distance and a spring.

use crate::common::{Run, adaptive, fixed, run};
use holonom::body::{
    BodyFacts, BodyKernel, BodySpec, Build, BuiltBody, Energy, Frame, Initial, Marker, cross, dot, sub,
};
use holonom::joint::{self, JointKernel, JointSpec};
use holonom::linearize::{Linear, State};
use holonom::math::expression::Number;
use holonom::math::rotation::{axes_from_quaternion, quaternion_rate};
use holonom::math::{Scalar, Time};
use holonom::method_spec::MethodSpec;
use holonom::prepared::Model;
use holonom::scene::Elements;
use holonom::simulate::{Method, Span};
use schemars::JsonSchema;
use serde::Deserialize;
use std::array::from_fn;

/// Planar x, y, angle, or spatial x, y, z and a quaternion, with principal moments of inertia.
#[derive(Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
struct OwnRigid {
    mass: Number,
    inertia: Vec<Number>,
}

impl BodySpec for OwnRigid {
    const TYPE: &'static str = "own_rigid";

    fn build<const D: usize>(
        &self,
        markers: Vec<Marker<D>>,
        initial: &Initial,
        build: &Build<D>,
    ) -> holonom::Result<BuiltBody<D>> {
        let mass = build.positive("mass", &self.mass)?;
        let (position, velocity) = initial.translation(build)?;
        if D == 2 {
            let inertia = build.vector::<1>("inertia", &self.inertia)?.to_vec();
            let (angle, spin) = initial.planar(build)?;
            let body = Box::new(OwnBody { mass, inertia, markers });
            return Ok(BuiltBody { body, q: [&position[..], &[angle]].concat(), v: [&velocity[..], &[spin]].concat() });
        }
        let inertia = build.vector::<3>("inertia", &self.inertia)?.to_vec();
        let (quaternion, spin) = initial.spatial(build)?;
        let body = Box::new(OwnBody { mass, inertia, markers });
        Ok(BuiltBody { body, q: [&position[..], &quaternion].concat(), v: [&velocity[..], &spin].concat() })
    }
}

struct OwnBody<const D: usize> {
    mass: f64,
    inertia: Vec<f64>,
    markers: Vec<Marker<D>>,
}

impl<const D: usize> BodyKernel<D> for OwnBody<D> {
    fn facts(&self) -> BodyFacts {
        match D {
            2 => BodyFacts::new(["x", "y", "angle"], ["x'", "y'", "angle'"]),
            _ => BodyFacts {
                turning: Some(3),
                ..BodyFacts::new(["x", "y", "z", "qw", "qx", "qy", "qz"], ["x'", "y'", "z'", "wx", "wy", "wz"])
            },
        }
    }
    fn markers(&self) -> &[Marker<D>] {
        &self.markers
    }
    fn rate<S: Scalar>(&self, q: &[S], v: &[S], qdot: &mut [S]) {
        qdot[..3].copy_from_slice(&v[..3]);
        if D == 3 {
            quaternion_rate(&q[3..7], &v[3..6], &mut qdot[3..7]);
        }
    }
    fn frame<S: Scalar>(&self, q: &[S]) -> Frame<S, D> {
        let r = from_fn(|i| q[i]);
        if D == 3 {
            let axes = axes_from_quaternion(&q[3..7]);
            return Frame { r, axes: from_fn(|i| from_fn(|j| axes[i][j])), ..Frame::world() };
        }
        let s = q[2].sin();
        let c = q[2].cos();
        Frame { r, axes: from_fn(|i| from_fn(|j| [[c, s], [-s, c]][i][j])), turn: q[2] }
    }
    fn mass(&self, values: &mut [f64]) {
        values[..D].fill(self.mass);
        values[D..].copy_from_slice(&self.inertia);
    }
    fn own_forces<S: Scalar>(&self, _q: &[S], v: &[S], gravity: &[f64; D], f: &mut [S]) {
        f.iter_mut().zip(gravity).for_each(|(f, g)| *f += S::constant(self.mass * g));
        if D == 3 {
            let w: [S; 3] = from_fn(|i| v[3 + i]);
            let gyroscopic = cross(&w, &from_fn(|i| w[i] * self.inertia[i]));
            f[3..].iter_mut().zip(gyroscopic).for_each(|(f, g)| *f -= g);
        }
    }
    fn energy<S: Scalar>(&self, q: &[S], v: &[S], gravity: &[f64; D]) -> Energy<S> {
        let masses = [self.mass; D].into_iter().chain(self.inertia.iter().copied());
        let kinetic = v.iter().zip(masses).fold(S::zero(), |sum, (v, mass)| sum + v.square() * (0.5 * mass));
        let potential = q.iter().zip(gravity).fold(S::zero(), |sum, (&q, g)| sum - q * (self.mass * g));
        Energy { kinetic, potential }
    }
    fn normalize(&self, q: &mut [f64]) {
        if D == 3 {
            let norm = q[3..7].iter().map(|x| x * x).sum::<f64>().sqrt();
            q[3..7].iter_mut().for_each(|x| *x /= norm);
        }
    }
}

#[derive(Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
struct OwnDistance {
    between: [String; 2],
    length: Number,
}

impl JointSpec for OwnDistance {
    const TYPE: &'static str = "own_distance";

    fn build<const D: usize>(&self, build: &Build<D>) -> holonom::Result<joint::BuiltJoint<D>> {
        let length = build.positive("length", &self.length)?;
        Ok(joint::BuiltJoint { joint: Box::new(OwnRod { length }), markers: build.between(&self.between)? })
    }
}

struct OwnRod {
    length: f64,
}

impl<const D: usize> JointKernel<D> for OwnRod {
    fn row_names(&self) -> Vec<&'static str> {
        vec!["length"]
    }
    fn depends_on_time(&self) -> bool {
        false
    }
    fn phi<S: Scalar>(&self, frames: &[Frame<S, D>], _: Time<S>, out: &mut [S]) {
        let gap = sub(&frames[1].r, &frames[0].r);
        out[0] = dot(&gap, &gap).sqrt() - self.length;
    }
}

const PLANAR: &str = r#"{ "name": "planar", "dimension": 2, "gravity": [0, -9.81],
    "bodies": [
        { "name": "a", "type": "rigid", "mass": 2, "inertia": [0.3], "markers": { "p": [0.3, 0.1], "e": [-0.2, 0.5] },
          "initial": { "position": [0.3, -0.1], "angle": 0.4, "angular_velocity": 2 } },
        { "name": "b", "type": "rigid", "mass": 1, "inertia": [0.1], "markers": { "p": [0.2, -0.3], "e": [0.4, 0.2] },
          "initial": { "position": [1, -0.5], "angle": -0.8 } } ],
    "joints": [
        { "name": "pivot", "type": "revolute", "between": ["ground", "a.p"] },
        { "name": "rod", "type": "distance", "between": ["a.e", "b.p"], "length": 0.8 } ],
    "forces": [{ "name": "s", "type": "torsion_spring", "between": ["a", "b"], "stiffness": 3, "damping": 0.1 }],
    "outputs": [{ "name": "pull", "measure": "reaction", "of": "rod", "component": "axial" }] }"#;

const SPATIAL: &str = r#"{ "name": "spatial", "dimension": 3, "gravity": [0, 0, -9.81],
    "bodies": [
        { "name": "a", "type": "rigid", "mass": 2, "inertia": [0.3, 0.4, 0.5], "markers": { "p": [0.3, 0.1, 0.2], "e": [-0.2, 0.5, 0.1] },
          "initial": { "position": [0.3, -0.1, 0], "rotation": [0.1, 0.5, -0.2], "angular_velocity": [1, 2, 3] } },
        { "name": "b", "type": "rigid", "mass": 1, "inertia": [0.1, 0.15, 0.2], "markers": { "p": [0.2, -0.3, 0], "e": [0.4, 0.2, 0.3] },
          "initial": { "position": [1, -0.5, 0.2], "angular_velocity": [0, 3, 1] } } ],
    "joints": [
        { "name": "pivot", "type": "spherical", "between": ["ground", "a.p"] },
        { "name": "rod", "type": "distance", "between": ["a.e", "b.p"], "length": 0.8 } ],
    "forces": [
        { "name": "c", "type": "applied_torque", "at": "a", "torque": ["sin(3*t)", 0.2, "-a.wx"], "reaction_on": "b" },
        { "name": "s", "type": "spring_damper", "between": ["a.e", "b.e"], "stiffness": 30, "damping": 0.5, "free_length": 0.4 } ],
    "outputs": [{ "name": "pull", "measure": "reaction", "of": "rod", "component": "axial" }] }"#;

/// The scene, and the same of own elements.
fn pair(text: &str) -> [Model; 2] {
    let elements = Elements::default().with_body::<OwnRigid>().and_then(Elements::with_joint::<OwnDistance>).unwrap();
    let own = text.replace("\"rigid\"", "\"own_rigid\"").replace("\"distance\"", "\"own_distance\"");
    let built_in = text.replace("[0.3],", "0.3,").replace("[0.1],", "0.1,");
    [built_in, own].map(|text| Model::new(elements.parse(&text, &[]).unwrap(), &Default::default()).unwrap())
}

fn motion(prepared: &Model, method: &Method) -> Run {
    let span = Span { start: 0.0, end: 1.0, output_step: 0.05 };
    run(prepared.system(), method, span, prepared.start()).completed()
}

/// The same equations, to the rounding of J^T w, of which the accelerations of generalized-alpha have 1/h as much, from
/// starts that the way to the nearest state leaves 1e-9 apart: it falls slowly where the guess is far off.
#[test]
fn they_move_as_the_built_in_ones() {
    for text in [PLANAR, SPATIAL] {
        let [built_in, own] = pair(text);
        for method in [
            adaptive("index1", "dop853", "manifold", 1e-9),
            adaptive("ggl", "radau_iia", "none", 1e-9),
            fixed("index3", "generalized_alpha", "none", 1e-3),
        ] {
            let [expected, found] = [&built_in, &own].map(|prepared| motion(prepared, &method));
            for (a, b) in expected.record.trajectory.rows.iter().zip(&found.record.trajectory.rows) {
                let off = a.iter().zip(b).fold(0.0f64, |off, (a, b)| off.max((a - b).abs() / (1.0 + a.abs())));
                assert!(off < 1e-8, "{} {}: {off:e} at {}", own.name, method.triple(), a[0]);
            }
            let [expected, found] = [expected, found].map(|run| run.record.energy.unwrap());
            assert!((expected.last - found.last).abs() < 1e-7 && (expected.work - found.work).abs() < 1e-7);
        }
    }
}

#[test]
fn their_linear_models_are_those_of_the_built_in_ones() {
    for text in [PLANAR, SPATIAL] {
        let models = pair(text).map(|prepared| {
            let request = Linear { method: MethodSpec::named("mcs"), chart: None };
            State::start(&prepared).variation(&prepared).unwrap().linearize(&request).unwrap()
        });
        let [expected, found] = models.map(|model| (model.a, model.c));
        let off = (&expected.0 - &found.0).amax() / expected.0.amax() + (&expected.1 - &found.1).amax();
        // That of the starts.
        assert!(off < 1e-8, "{off:e}");
    }
}
