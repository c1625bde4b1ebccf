//! Accepted steps allocate nothing: a run of 2N steps makes as many allocations as one of N.

use crate::common::counting::count;
use crate::common::driven_pendulum::{self, DrivenPendulum};
use crate::common::{adaptive, fixed};
use holonom::math::Scalar;
use holonom::prepared::{Model, Overrides};
use holonom::scene::{Scene, generate};
use holonom::simulate::{Method, Observation, Outcome, Sink, Span, simulate, spread};
use holonom::system::{Equations, MechanicalSystem, OperatingPoint, Scratch};
use std::path::Path;

/// Methods that between them use every vector field, projection, field and kind of explicit integrator.
const METHODS: [(&str, &str, &str); 17] = [
    ("index1", "heun", "none"),
    ("index1", "rk4", "none"),
    ("index1", "rk4", "position"),
    ("index1", "dopri5", "velocity"),
    ("index1", "dopri5", "exact"),
    ("index1", "dop853", "manifold"),
    ("index1", "dop853", "full"),
    ("baumgarte", "dopri5", "full:metric=mass"),
    ("invariant_manifold", "rk4", "none"),
    ("invariant_manifold:field=triangular", "rk4", "none"),
    ("invariant_manifold:field=full", "dopri5", "none"),
    ("force_projection", "dopri5", "none"),
    ("penalty", "rk4", "none"),
    ("augmented_lagrangian", "dopri5", "manifold"),
    ("udwadia_kalaba", "rk4", "none"),
    ("null_space", "dopri5", "manifold"),
    ("null_space", "rk4", "none"),
];

/// Methods for the constraints themselves.
const DIRECT: [(&str, &str, &str); 10] = [
    ("index1", "radau_iia", "none"),
    ("index2", "radau_iia:order=9", "manifold"),
    ("index3", "radau_iia:order=13", "velocity"),
    ("ggl", "radau_iia", "none"),
    ("index2", "hem5", "none"),
    ("index2", "phem56", "manifold"),
    ("index3", "rattle", "none"),
    ("index3", "generalized_alpha", "velocity"),
    ("ggl", "generalized_alpha", "none"),
    ("index3", "ali3p", "none"),
];

/// The allocations up to the last row: the memory that a method leaves for a later run comes after it.
struct Counted(usize);

impl Sink for Counted {
    fn watches(&self) -> bool {
        false
    }
    fn row(&mut self, _: &Observation) {
        self.0 = count();
    }
}

fn allocations(
    system: &dyn MechanicalSystem,
    method: &Method,
    span: Span,
    start: (&[f64], &[f64]),
) -> (usize, Outcome) {
    let before = count();
    let mut counted = Counted(before);
    let outcome = simulate(system, method, span, start, &mut counted).unwrap();
    (counted.0 - before, outcome)
}

/// Runs of 20 and of 40 steps, with rows at the ends, after one step that fills the memory of libraries.
fn check(name: &str, system: &dyn MechanicalSystem, start: (&[f64], &[f64]), step: f64) {
    check_methods(name, &METHODS, system, start, step);
}

fn check_methods(
    name: &str,
    methods: &[(&str, &str, &str)],
    system: &dyn MechanicalSystem,
    start: (&[f64], &[f64]),
    step: f64,
) {
    for &(formulation, integrator, projection) in methods {
        let method = fixed(formulation, integrator, projection, step);
        let [_, few, many] = [1_u32, 20, 40].map(|steps| {
            let end = f64::from(steps) * step;
            let (made, outcome) = allocations(system, &method, Span { start: 0.0, end, output_step: end }, start);
            assert_eq!(outcome.failure, None, "{name} {method:?}");
            assert_eq!(outcome.statistics.steps, u64::from(steps), "{name} {method:?}");
            made
        });
        assert_eq!(few, many, "{name} {formulation} {integrator} {projection}");
    }
}

#[test]
fn own_equations() {
    let (q, v) = driven_pendulum::start();
    check("driven pendulum", &DrivenPendulum, (&q, &v), 0.01);
}

/// Unit pendulum whose constraint is given twice.
struct Twice;

impl Equations for Twice {
    fn size(&self) -> (usize, usize) {
        (2, 2)
    }
    fn mass<S: Scalar>(&self, _t: S, _q: &[S], mass: &mut [S]) {
        mass.copy_from_slice(&[S::one(), S::zero(), S::zero(), S::one()]);
    }
    fn force<S: Scalar>(&self, _t: S, _q: &[S], _v: &[S], f: &mut [S]) {
        f.copy_from_slice(&[S::zero(), S::constant(-9.81)]);
    }
    fn phi<S: Scalar>(&self, _t: S, q: &[S], phi: &mut [S]) {
        phi.fill((q[0].square() + q[1].square() - 1.0) * 0.5);
    }
}

#[test]
fn redundant_constraints() {
    check("pendulum twice", &Twice, (&[0.6, -0.8], &[0.0, 0.0]), 0.01);
    check_methods("pendulum twice", &DIRECT, &Twice, (&[0.6, -0.8], &[0.0, 0.0]), 0.01);
}

#[test]
fn methods_for_the_constraints_themselves() {
    let (q, v) = driven_pendulum::start();
    check_methods("driven pendulum", &DIRECT, &DrivenPendulum, (&q, &v), 0.01);
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("models/andrews.json");
    let prepared = Model::load_with(&path, &Overrides::default()).unwrap();
    check_methods("andrews", &DIRECT, prepared.system(), prepared.start(), 1e-5);
}

/// Planar, redundant, and spatial with quaternions and a driver.
#[test]
fn scenes() {
    for name in ["andrews", "parallelogram_redundant", "universal_shaft", "spinning_top"] {
        let path = Path::new(env!("CARGO_MANIFEST_DIR")).join(format!("models/{name}.json"));
        let prepared = Model::load_with(&path, &Overrides::default()).unwrap();
        check(name, prepared.system(), prepared.start(), 1e-5);
    }
}

/// Both kinds of frames, in the plane and in space; steps short enough for explicit methods.
#[test]
fn flexible_beams() {
    let methods = [
        ("index1", "rk4", "none"),
        ("index1", "dop853", "manifold"),
        ("ggl", "generalized_alpha", "none"),
        ("ggl", "radau_iia", "none"),
    ];
    for name in ["flexible_slider_crank_fe", "flexible_four_bar", "flexible_pendulum", "right_angle_cantilever"] {
        let path = Path::new(env!("CARGO_MANIFEST_DIR")).join(format!("models/{name}.json"));
        let prepared = Model::load_with(&path, &Overrides::default()).unwrap();
        check_methods(name, &methods, prepared.system(), prepared.start(), 1e-8);
    }
}

/// Rows of a trajectory: outputs and energies, after the first ones.
#[test]
fn outputs() {
    for name in ["andrews", "spinning_top", "flexible_slider_crank", "flexible_pendulum", "five_link_suspension"] {
        let path = Path::new(env!("CARGO_MANIFEST_DIR")).join(format!("models/{name}.json"));
        let prepared = Model::load_with(&path, &Overrides::default()).unwrap();
        let (system, (q, v), mut scratch) = (prepared.system(), prepared.start(), Scratch::default());
        let mut out = vec![0.0; system.facts().outputs.len()];
        let mut row = || {
            let before = count();
            let at = OperatingPoint { t: 0.0, q, v, vdot: &prepared.assembly.vdot, lambda: &prepared.assembly.lambda };
            system.outputs(at, &mut out, &mut scratch);
            system.energy(0.0, q, v, &mut scratch);
            count() - before
        };
        assert_eq!((row() > 0, row()), (true, 0), "{name}");
    }
}

#[test]
fn adaptive_steps_and_rows() {
    let (q, v) = driven_pendulum::start();
    for (formulation, integrator, projection, tolerance) in [
        ("index1", "dopri5", "manifold", 1e-10),
        ("index1", "dop853", "manifold", 1e-10),
        ("null_space", "dop853", "manifold", 1e-10),
        ("ggl", "generalized_alpha", "manifold", 1e-7),
        ("ggl", "bdf", "none", 1e-7),
    ] {
        let method = adaptive(formulation, integrator, projection, tolerance);
        let run = |end| {
            let span = Span { start: 0.0, end, output_step: 0.001 };
            let (made, outcome) = allocations(&DrivenPendulum, &method, span, (&q, &v));
            assert_eq!(outcome.failure, None);
            (made, outcome.statistics.steps)
        };
        let ((few, short), (many, long)) = (run(0.5), run(1.0));
        assert!(long > short);
        assert_eq!(few, many, "{integrator}");
    }
}

#[test]
fn large_systems_on_some_threads() {
    // Two parts of the saddle-point matrix, and portions of bodies, joints and sums.
    let scene = Scene::parse(&generate::n_four_bar(3000).to_string(), &[]).unwrap();
    let prepared = Model::new(scene, &Overrides::default()).unwrap();
    let methods = [("index1", "rk4", "manifold"), ("ggl", "generalized_alpha", "none")];
    let check = || check_methods("n_four_bar", &methods, prepared.system(), prepared.start(), 1e-4);
    check();
    let pool = rayon::ThreadPoolBuilder::new().num_threads(2).build().unwrap();
    pool.install(|| spread(check));
}
