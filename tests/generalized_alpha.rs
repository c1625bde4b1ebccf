//! Generalized-alpha where it is meant for: stiff motions, and rotations; with steps of its own, redundant constraints,
//! long runs, many bodies.

use crate::common::driven_pendulum::{DrivenPendulum, start};
use crate::common::stiff::{STIFF, slow_position};
use crate::common::{adaptive, distance, fixed, stepwise, until};
use holonom::analysis::Recorder;
use holonom::math::Scalar;
use holonom::method_spec::MethodSpec;
use holonom::prepared::Model;
use holonom::scene::Scene;
use holonom::scene::generate;
use holonom::simulate::Span;
use holonom::simulate::{Method, Outcome, simulate};
use holonom::system::Equations;
use std::path::Path;

fn run(prepared: &Model, integrator: &str, step: f64) -> (Outcome, f64) {
    let method = Method {
        formulation: MethodSpec::named("index3"),
        integrator: MethodSpec::parse(integrator).unwrap(),
        projection: MethodSpec::named("none"),
        step: Some(step),
        ..Method::default()
    };
    let mut recorder = Recorder::new(prepared.system());
    let outcome =
        simulate(prepared.system(), &method, prepared.span().unwrap(), prepared.start(), &mut recorder).unwrap();
    let trajectory = recorder.finish().trajectory;
    let last = *trajectory.column("x").unwrap().last().unwrap();
    (outcome, last)
}

/// The fast spring swings at 3e5 rad/s, three thousand times what the step resolves; the slow motion is that of 1.001 kg
/// on the soft spring.
#[test]
fn a_stiff_motion_is_stepped_over() {
    let prepared = Model::new(Scene::parse(STIFF, &[]).unwrap(), &Default::default()).unwrap();
    let (outcome, x) = run(&prepared, "generalized_alpha:rho_inf=0.5", 0.01);
    assert!(outcome.failure.is_none(), "{:?}", outcome.failure);
    let slow = slow_position();
    // Errors of order 2 after ten radians: some h^2.
    assert!((x - slow).abs() < 2e-4, "{x} against {slow}");
    assert_eq!(outcome.statistics.steps, 1000);
    assert!(outcome.statistics.newton_iterations < 6000, "{:?}", outcome.statistics);
}

fn shipped(name: &str) -> Model {
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join(format!("models/{name}.json"));
    Model::load_with(&path, &Default::default()).unwrap()
}

/// Turn of the top about the vertical after a second.
fn precession(prepared: &Model, method: &Method) -> f64 {
    let mut recorder = Recorder::new(prepared.system());
    let outcome =
        simulate(prepared.system(), method, prepared.span().unwrap(), prepared.start(), &mut recorder).unwrap();
    assert_eq!(outcome.failure, None, "{method:?}");
    *recorder.finish().trajectory.column("precession").unwrap().last().unwrap()
}

/// The top of the shipped scene: nutation and precession in space, with the quaternion advanced along the group. With ggl
/// steps of a radian about its axis converge too.
#[test]
fn rotations_converge_with_order_two() {
    let prepared = shipped("spinning_top");
    let exact = precession(&prepared, &adaptive("index1", "dop853", "none", 1e-12));
    for (formulation, coarse) in [("index3", 1e-3), ("ggl", 1e-3), ("ggl", 5e-4)] {
        let error =
            |step: f64| (precession(&prepared, &fixed(formulation, "generalized_alpha", "none", step)) - exact).abs();
        let order = (error(coarse) / error(0.5 * coarse)).log2();
        assert!((order - 2.0).abs() < 0.15, "{formulation}: order {order}");
    }
    let large = precession(&prepared, &fixed("ggl", "generalized_alpha", "none", 5e-3));
    assert!((large - exact).abs() < 0.5, "{large} against {exact}");
}

/// Errors of q, v and lambda at the end, and the number of steps.
fn errors(formulation: &str, tolerance: f64, exact: &crate::common::Run) -> ([f64; 3], f64) {
    let (q, v) = start();
    let method = stepwise(formulation, "generalized_alpha", "none", tolerance);
    let run = crate::common::run(&DrivenPendulum, &method, until(1.5), (&q, &v)).completed();
    let ((q, v, lambda), (q1, v1, lambda1)) = (run.last(), exact.last());
    let found = [distance(q, q1), distance(v, v1), distance(lambda, lambda1)];
    assert!(run.drift().0 < 1e-14, "{:?}", run.drift());
    assert!(formulation == "index3" || run.drift().1 < 1e-12, "{:?}", run.drift());
    (found, run.outcome.statistics.steps as f64)
}

/// Were a not moved with the step, the order would be one.
#[test]
fn steps_of_its_own_keep_order_two() {
    let (q, v) = start();
    let exact =
        crate::common::run(&DrivenPendulum, &adaptive("index1", "dop853", "exact", 1e-12), until(1.5), (&q, &v));
    for formulation in ["index3", "ggl"] {
        let (coarse, few) = errors(formulation, 1e-6, &exact);
        let (fine, many) = errors(formulation, 1e-9, &exact);
        for (level, name) in ["q", "v", "lambda"].into_iter().enumerate() {
            let order = (coarse[level] / fine[level]).ln() / (many / few).ln();
            assert!((order - 2.0).abs() < 0.3, "{formulation}: order {order:.2} in {name}, {coarse:?}, {fine:?}");
        }
    }
}

/// A hundred swings of a pendulum: without damping the energy stays, with it what is lost has the order of the method.
#[test]
fn long_runs_keep_their_energy() {
    let prepared = shipped("pendulum");
    let loss = |formulation: &str, integrator: &str, step: f64| {
        let mut recorder = Recorder::new(prepared.system());
        let span = until(100.0);
        let method = fixed(formulation, integrator, "none", step);
        let outcome = simulate(prepared.system(), &method, span, prepared.start(), &mut recorder).unwrap();
        assert_eq!(outcome.failure, None);
        let record = recorder.finish();
        assert!(record.drift.position.max < 1e-14);
        record.energy.unwrap().max_error
    };
    // Of 6.9 J.
    let undamped = [0.01, 0.005].map(|step| loss("ggl", "generalized_alpha:rho_inf=1", step));
    assert!(undamped[0] < 0.01 && undamped[0] > 3.5 * undamped[1], "{undamped:?}");
    for formulation in ["index3", "ggl"] {
        let damped = [0.01, 0.005].map(|step| loss(formulation, "generalized_alpha:rho_inf=0.5", step));
        assert!(damped[0] < 0.05 && damped[0] > 3.5 * damped[1], "{damped:?}");
    }
    let method = fixed("index3", "generalized_alpha:rho_inf=0.98", "none", 0.01);
    let span = until(1.0);
    let refused = simulate(prepared.system(), &method, span, prepared.start(), &mut Recorder::new(prepared.system()));
    assert!(refused.unwrap_err().to_string().contains("index3"));
}

/// Two of the three cranks would do.
#[test]
fn redundant_constraints_are_solved() {
    let prepared = shipped("parallelogram_redundant");
    let exact = crate::common::run(
        prepared.system(),
        &adaptive("index1", "dop853", "exact", 1e-12),
        until(2.0),
        prepared.start(),
    );
    for formulation in ["index3", "ggl"] {
        let method = fixed(formulation, "generalized_alpha", "none", 1e-3);
        let run = crate::common::run(prepared.system(), &method, until(2.0), prepared.start()).completed();
        let ((q, v, lambda), (q1, v1, lambda1)) = (run.last(), exact.last());
        let errors = [distance(q, q1), distance(v, v1), distance(lambda, lambda1)];
        // Some h^2, of values of 2, 7 and 30.
        assert!(errors[0] < 5e-5 && errors[1] < 2e-4 && errors[2] < 1e-3, "{formulation} {errors:?}");
        assert!(run.drift().0 < 1e-14, "{:?}", run.drift());
    }
}

/// Told where to be twice: the same at first, and later not.
struct Torn;

impl Equations for Torn {
    fn size(&self) -> (usize, usize) {
        (2, 2)
    }
    fn mass<S: Scalar>(&self, _t: S, _q: &[S], mass: &mut [S]) {
        mass.copy_from_slice(&[S::one(), S::zero(), S::zero(), S::one()]);
    }
    fn force<S: Scalar>(&self, _t: S, _q: &[S], _v: &[S], f: &mut [S]) {
        f.fill(S::zero());
    }
    fn phi<S: Scalar>(&self, t: S, q: &[S], phi: &mut [S]) {
        phi[0] = q[0] - t.square();
        phi[1] = q[0] - t.square() * (S::one() + t);
    }
}

#[test]
fn redundant_constraints_that_contradict_each_other_end_the_run() {
    for formulation in ["index3", "ggl"] {
        for method in [
            fixed(formulation, "generalized_alpha", "none", 1e-3),
            adaptive(formulation, "generalized_alpha", "none", 1e-6),
        ] {
            let run = crate::common::run(&Torn, &method, until(1.0), (&[0.0, 1.0], &[0.0, 0.0]));
            let failure = run.outcome.failure.unwrap();
            assert!(failure.reason.contains("contradict"), "{failure:?}");
            assert!(failure.hint.contains("holonom check"), "{failure:?}");
        }
    }
}

/// Cost is linear in the number of links: 0.2, 2.5 and 30 ms a step for 20, 200 and 2000 of them.
#[test]
fn a_chain_of_two_hundred_links() {
    let (_, make) = generate::registry().iter().find(|(name, _)| *name == "chain").unwrap();
    let prepared = Model::new(Scene::parse(&make(200).to_string(), &[]).unwrap(), &Default::default()).unwrap();
    for formulation in ["index3", "ggl"] {
        let method = fixed(formulation, "generalized_alpha", "none", 1e-3);
        let span = Span { start: 0.0, end: 0.1, output_step: 0.1 };
        let run = crate::common::run(prepared.system(), &method, span, prepared.start()).completed();
        assert!(run.drift().0 < 1e-13 && (formulation == "index3" || run.drift().1 < 1e-10), "{:?}", run.drift());
        // Of 0.24 J that turn from potential to kinetic energy.
        let error = run.record.energy.unwrap().max_error;
        assert!(error < 1e-4, "{error}");
    }
}
