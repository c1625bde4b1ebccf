//! A bead on a parabola with a hardening spring: as a scene of own elements, and as own equations.

use crate::common::{Run, run};
use crate::examples::own_force::HardeningSpring;
use crate::examples::own_joint::PointOnParabola;
use holonom::integrator::{self, Steps};
use holonom::linearize::{self, Linear, LinearModel, State, Variation, at_rest};
use holonom::math::Scalar;
use holonom::math::expression::Number;
use holonom::method_spec::{Listed, MethodSpec};
use holonom::prepared::{Model, Overrides};
use holonom::report::mechanism;
use holonom::scene::{Elements, SceneBuilder, json};
use holonom::simulate::{Method, Span};
use holonom::sweep::{Family, Range};
use holonom::system::{Equations, MechanicalSystem};
use holonom::validate::{Settings, validate};
use holonom::{formulation, study};

const MASS: f64 = 1.3;
const CURVATURE: f64 = 2.0;
const STIFFNESS: f64 = 3.0;
const HARDENING: f64 = 5.0;
const GRAVITY: f64 = 9.81;
const START: [f64; 2] = [0.7, 0.49];

/// Coordinates x, y, m.
struct Bead;

impl Equations for Bead {
    fn size(&self) -> (usize, usize) {
        (2, 1)
    }
    fn mass<S: Scalar>(&self, _: S, _: &[S], mass: &mut [S]) {
        mass.copy_from_slice(&[MASS, 0.0, 0.0, MASS].map(S::constant));
    }
    fn force<S: Scalar>(&self, _: S, q: &[S], _: &[S], f: &mut [S]) {
        let stiffness = (q[0].square() + q[1].square()) * HARDENING + STIFFNESS;
        f.copy_from_slice(&[-(q[0] * stiffness), -(q[1] * stiffness) - MASS * GRAVITY]);
    }
    fn phi<S: Scalar>(&self, _: S, q: &[S], phi: &mut [S]) {
        phi[0] = q[1] - q[0].square() * (0.5 * CURVATURE);
    }
    fn potential(&self, _: f64, q: &[f64]) -> Option<f64> {
        let square = q[0] * q[0] + q[1] * q[1];
        Some(MASS * GRAVITY * q[1] + 0.5 * STIFFNESS * square + 0.25 * HARDENING * square * square)
    }
}

fn elements() -> Elements {
    Elements::default().with_joint::<PointOnParabola>().unwrap().with_force::<HardeningSpring>().unwrap()
}

fn scene() -> SceneBuilder {
    SceneBuilder::new("bead", 2)
        .with("gravity", [0.0, -GRAVITY])
        .parameter("k", STIFFNESS)
        .body("bead", "point_mass", json!({ "mass": MASS, "initial": { "position": START } }))
        .joint("wire", "point_on_parabola", json!({ "between": ["ground", "bead"], "curvature": CURVATURE }))
        .force(
            "spring",
            "hardening_spring",
            json!({ "between": ["ground", "bead"], "stiffness": "k", "hardening": HARDENING }),
        )
        .output("x", "reaction", json!({ "of": "wire", "component": "x" }))
        .output("y", "reaction", json!({ "of": "wire", "component": "y" }))
        .output("pull", "force", json!({ "of": "spring" }))
        .output("energy", "energy", json!({}))
        .simulation("t_end", 1.0)
}

fn prepared() -> Model {
    Model::new(scene().build(&elements()).unwrap(), &Default::default()).unwrap()
}

fn motion(system: &dyn MechanicalSystem, method: &Method) -> Run {
    run(system, method, Span { start: 0.0, end: 1.0, output_step: 0.1 }, (&START, &[0.0, 0.0])).completed()
}

/// Every formulation, by an integrator that takes it.
pub fn methods() -> impl Iterator<Item = Method> {
    formulation::registry().iter().map(|formulation| {
        let mut takers = integrator::registry().iter().filter(|entry| (entry.solves)(formulation));
        let taker = takers.find(|entry| entry.steps != Steps::Own).expect("each is integrated");
        let projection = if taker.refuses(formulation.name, "manifold") { "none" } else { "manifold" };
        Method {
            formulation: formulation.spec(),
            integrator: MethodSpec::named(taker.name),
            projection: MethodSpec::named(projection),
            step: Some(1e-3),
            ..Method::default()
        }
    })
}

#[test]
fn every_formulation_moves_them_as_the_equations_say() {
    let prepared = prepared();
    for method in methods() {
        let found = motion(prepared.system(), &method);
        let expected = motion(&Bead, &method);
        for (found, expected) in found.record.trajectory.rows.iter().zip(&expected.record.trajectory.rows) {
            // t, q, v, lambda; sums of the same terms in another order, over a thousand steps.
            let off = found.iter().zip(expected).map(|(a, b)| (a - b).abs() / (1.0 + b.abs()));
            let off = off.fold(0.0, f64::max);
            assert!(off < 1e-10, "{}: {off:e}, {found:?} against {expected:?}", method.triple());
        }
    }
}

/// The energy of the bead stays what the kernels' potentials say, and outputs are what lambda and q make of them.
#[test]
fn outputs_and_energy_are_theirs() {
    let prepared = prepared();
    let method = Method { rtol: 1e-12, atol: 1e-12, ..Method::default() };
    let run = motion(prepared.system(), &method);
    let energy = run.record.energy.expect("a scene has an energy");
    let start = Bead.potential(0.0, &START).unwrap();
    assert!((energy.initial - start).abs() < 1e-14 * start, "{energy:?}");
    // What wrenches do beyond the loss of their potential, in a few hundred steps: round-off.
    assert!(energy.work.abs() < 1e-14 * start, "{energy:?}");
    assert!(energy.relative_max_error.unwrap() < 1e-11, "{energy:?}");
    for row in &run.record.trajectory.rows {
        let ([x, y], lambda, outputs) = ([row[1], row[2]], row[5], &row[6..]);
        let length = (x * x + y * y).sqrt();
        // The reaction is -G^T lambda with G = (-c x, 1).
        let expected = [CURVATURE * x * lambda, -lambda, (STIFFNESS + HARDENING * length * length) * length, start];
        for (found, expected) in outputs.iter().zip(expected) {
            assert!((found - expected).abs() < 1e-10 * (1.0 + expected.abs()), "{outputs:?}, {expected}");
        }
    }
}

fn model(variation: &mut Variation, method: &str) -> LinearModel {
    variation.linearize(&Linear { method: MethodSpec::named(method), chart: None }).unwrap()
}

/// At rest at the vertex the frequency has a formula, omega^2 = g c + k/m; beside it all methods have the eigenvalues of the
/// equations.
#[test]
fn linear_models_are_those_of_the_equations() {
    let prepared = prepared();
    let rest = at_rest(&prepared, &State { q: vec![0.1, 0.01], ..State::start(&prepared) }).unwrap();
    let frequency = (GRAVITY * CURVATURE + STIFFNESS / MASS).sqrt();
    let found = model(&mut rest.variation().unwrap(), "mcs").modes[0].value;
    assert!((found.im.abs() - frequency).abs() < 1e-13 * frequency && found.re.abs() < 1e-13, "{found}");

    let v = [0.4, 0.4 * CURVATURE * START[0]];
    let mut own = Variation::new(&Bead, 0.0, &START, &v).unwrap();
    let mut scene = Variation::new(prepared.system(), 0.0, &START, &v).unwrap();
    for method in linearize::registry() {
        let [expected, found] = [&mut own, &mut scene].map(|variation| model(variation, method.name).modes);
        let off =
            expected.iter().zip(&found).map(|(a, b)| if a.value == b.value { 0.0 } else { (a.value - b.value).norm() });
        assert!(expected.len() == found.len() && off.fold(0.0, f64::max) < 1e-11, "{}", method.name);
    }
}

/// A term missing in K, C or phi'' would show as order 1.
#[test]
fn their_linear_models_pass_validation() {
    let prepared = prepared();
    let state = State { v: vec![0.4, 0.4 * CURVATURE * START[0]], ..State::start(&prepared) };
    let found = validate(prepared.system(), &state, &Settings::default()).unwrap();
    assert!(found.verdict.ltv && found.verdict.lti, "{}", found.verdict.text);
}

#[test]
fn files_sweeps_and_maps_know_them() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("bead.json");
    std::fs::write(&path, scene().json().to_string()).unwrap();
    let overrides =
        Overrides { elements: elements(), set: vec![("k".into(), Number::Value(7.0))], ..Overrides::default() };
    assert_eq!(Model::load_with(&path, &overrides).unwrap().parameters.get("k"), Some(7.0));
    let family = Family::load_with(&path, &overrides).unwrap();
    let sweep = family.sweep(&Range::new("k", (0.0, 10.0), 3).unwrap(), |_| ()).unwrap();
    assert_eq!(sweep.points.len(), 3);
    let subject = study::stress::Subject::load(&path, &overrides).unwrap();
    let end = |motion: &study::Motion| Ok(motion.span.end);
    assert_eq!(subject.with(&subject.base, end).unwrap(), 1.0);
}

/// Kinds without a sign of their own are drawn by a common one.
#[test]
fn figures_show_them() {
    let prepared = prepared();
    let bare =
        SceneBuilder::new("bead", 2).body("bead", "point_mass", json!({ "initial": { "position": START }, "mass": 1 }));
    let bare = Model::new(bare.build(&Elements::default()).unwrap(), &Default::default()).unwrap();
    let areas = |prepared: &Model| {
        let look = mechanism::Look::plain(&prepared.mechanism);
        mechanism::mechanism_figure(prepared, &look, &State::start(prepared)).to_svg().len()
    };
    assert!(areas(&prepared) > areas(&bare) + 100, "{} {}", areas(&prepared), areas(&bare));
}
