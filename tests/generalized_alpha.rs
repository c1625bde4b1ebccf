//! Generalized-alpha where it is meant for: stiff motions, and rotations.

mod common;

use common::stiff::{STIFF, slow_position};
use holonom::formulation::Choice;
use holonom::measure::Recorder;
use holonom::scene::Scene;
use holonom::simulate::{Method, Outcome, simulate};
use holonom::study::Study;
use std::path::Path;

fn run(study: &Study, integrator: &str, step: f64) -> (Outcome, f64) {
    let method = Method {
        formulation: Choice::named("index3"),
        integrator: Choice::parse(integrator).unwrap(),
        projection: Choice::named("none"),
        step: Some(step),
        ..Method::default()
    };
    let mut recorder = Recorder::new(study.system());
    let outcome = simulate(study.system(), &method, study.span().unwrap(), study.start(), &mut recorder).unwrap();
    let trajectory = recorder.finish().trajectory;
    let last = *trajectory.column("x").unwrap().last().unwrap();
    (outcome, last)
}

/// The fast spring swings at 3e5 rad/s, three thousand times what the step resolves; the slow motion is that of 1.001 kg
/// on the soft spring.
#[test]
fn a_stiff_motion_is_stepped_over() {
    let study = Study::new(Scene::parse(STIFF, &[]).unwrap(), &Default::default()).unwrap();
    let (outcome, x) = run(&study, "generalized_alpha:rho_inf=0.5", 0.01);
    assert!(outcome.failure.is_none(), "{:?}", outcome.failure);
    let slow = slow_position();
    // Errors of order 2 after ten radians: some h^2.
    assert!((x - slow).abs() < 2e-4, "{x} against {slow}");
    assert_eq!(outcome.statistics.steps, 1000);
    assert!(outcome.statistics.newton_iterations < 6000, "{:?}", outcome.statistics);
}

/// The top of the shipped scene: nutation and precession in space, with the quaternion advanced along the group.
#[test]
fn rotations_converge_with_order_two() {
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("models/spinning_top.json");
    let study = Study::load(&path, &Default::default()).unwrap();
    let precession = |integrator: &str, formulation: &str, step: Option<f64>| {
        let method = Method {
            formulation: Choice::named(formulation),
            integrator: Choice::named(integrator),
            projection: Choice::named("none"),
            rtol: 1e-12,
            atol: 1e-12,
            step,
        };
        let mut recorder = Recorder::new(study.system());
        simulate(study.system(), &method, study.span().unwrap(), study.start(), &mut recorder).unwrap();
        *recorder.finish().trajectory.column("precession").unwrap().last().unwrap()
    };
    let exact = precession("dop853", "index1", None);
    let error = |step: f64| (precession("generalized_alpha", "index3", Some(step)) - exact).abs();
    let order = (error(1e-3) / error(5e-4)).log2();
    assert!((order - 2.0).abs() < 0.1, "order {order}");
}
