//! How long the steps of explicit methods may be: the limits that they state, measured on oscillators; and the warning
//! before a run whose steps are too long or too many.

use crate::common::{fixed, method};
use crate::scenes::{Ready, parse};
use holonom::analysis::Recorder;
use holonom::integrator::{self, Stability, Steps};
use holonom::simulate::{Method, Span, simulate};

/// x'' + c x' + k x = 0 on a rail.
fn oscillator(k: f64, c: f64) -> Ready {
    parse(&format!(
        r#"{{ "name": "oscillator", "dimension": 2, "ground": {{ "markers": {{ "O": [0, 0] }} }},
            "bodies": [ {{ "name": "mass", "type": "rigid", "mass": 1, "inertia": 1,
                           "initial": {{ "position": [1, 0], "velocity": [1, 0] }} }} ],
            "joints": [ {{ "name": "rail", "type": "equation", "expression": "mass.y" }},
                        {{ "name": "level", "type": "equation", "expression": "mass.angle" }} ],
            "forces": [ {{ "name": "spring", "type": "bushing", "between": ["ground.O", "mass"],
                           "stiffness": [{k}, 0, 0], "damping": [{c}, 0, 0] }} ] }}"#
    ))
}

/// Limits of all integrators of fixed steps that have one, with a formulation each.
fn limits() -> Vec<(&'static str, &'static str, Stability)> {
    let of =
        |entry: &'static integrator::IntegratorEntry| Some((entry.name, entry.accepts().next()?, entry.stability?()));
    integrator::registry().iter().filter(|entry| entry.steps != Steps::Own).filter_map(of).collect()
}

/// The largest |x| on the way, infinite where the run fails.
fn largest(scene: &Ready, method: &Method, steps: f64) -> f64 {
    let h = method.step.unwrap();
    let mut recorder = Recorder::new(scene.system());
    let span = Span { start: 0.0, end: steps * h, output_step: h };
    let outcome = simulate(scene.system(), method, span, scene.0.start(), &mut recorder).unwrap();
    let rows = recorder.finish().trajectory.rows;
    match outcome.failure {
        Some(_) => f64::INFINITY,
        None => rows.iter().fold(0.0, |most: f64, row| most.max(row[1].abs())),
    }
}

/// Swings and decays: steps below the limit stay bounded for hundreds of radians, twice as long ones do not.
#[test]
fn stated_limits_are_the_measured_ones() {
    for (k, c, decay, swing) in
        [(1.0, 0.0, 0.0, 1.0), (1.0, 2f64.sqrt(), 0.5f64.sqrt(), 0.5f64.sqrt()), (1e-6, 1.0, 1.0, 0.0)]
    {
        let scene = oscillator(k, c);
        let all = limits();
        assert_eq!(all.len(), 9, "{all:?}");
        // What decays for long is no longer a number to compare.
        let radians = if decay > 0.0 { 300.0 } else { 1000.0 };
        for (name, formulation, stability) in all {
            let limit = stability.limit(decay, swing);
            let run = |h: f64| largest(&scene, &fixed(formulation, name, "none", h), (radians / h).ceil());
            assert!(run(0.95 * limit) < 10.0, "{name} at {limit} along -{decay} + {swing} i: {}", run(0.95 * limit));
            assert!(
                run(2.0 * limit) > 100.0,
                "{name} at twice {limit} along -{decay} + {swing} i: {}",
                run(2.0 * limit)
            );
        }
    }
}

fn warning(scene: &Ready, method: &Method, end: f64) -> Option<holonom::simulate::Stiffness> {
    use holonom::system::OperatingPoint;
    let at = scene.start();
    let state = OperatingPoint { t: 0.0, q: &at.q, v: &at.v, vdot: &at.vdot, lambda: &at.lambda };
    holonom::simulate::stiffness(scene.system(), method, state, Span { start: 0.0, end, output_step: end })
}

/// 1000 rad/s: rk4 may step 2.83 ms. The advised step runs, twice the limit does not.
#[test]
fn fixed_steps_that_are_too_long_are_told() {
    let scene = oscillator(1e6, 0.0);
    let method = |h: f64| fixed("index1", "rk4", "manifold", h);
    assert_eq!(warning(&scene, &method(2.5e-3), 10.0), None);
    let told = warning(&scene, &method(5e-3), 10.0).unwrap();
    assert!((told.mode.swing - 1e3).abs() < 1e-6 && (told.stable_step - 2.83e-3).abs() < 1e-5, "{told:?}");
    assert_eq!(
        told.to_string(),
        "a mode of the start swings at 1000 rad/s: rk4 with steps of 0.005 s is unstable above 570 1/s"
    );
    assert!(told.advice.starts_with("take steps below 0.0025 s, or "), "{}", told.advice);
    assert!(largest(&scene, &method(2.5e-3), 1e4) < 2.0);
    assert!(largest(&scene, &method(2.0 * told.stable_step), 1e3) > 100.0);
    // What is implicit has no limit.
    assert_eq!(warning(&scene, &fixed("ggl", "radau_iia", "none", 5e-3), 10.0), None);
}

/// A strong damper: an adaptive method needs steps for stability that accuracy does not ask for.
#[test]
fn adaptive_steps_that_stability_holds_short_are_told() {
    let scene = oscillator(1e4, 1e6);
    let told = warning(&scene, &method("index1", "dopri5", "manifold"), 10.0).unwrap();
    assert!((told.mode.decay - 1e6).abs() < 1.0 && (told.limit - 3.3).abs() < 0.02, "{told:?}");
    assert!((told.steps_for_stability / 3.02e6 - 1.0).abs() < 0.01, "{told:?}");
    assert!(told.implicit_gain.unwrap() > 100.0, "{told:?}");
    assert!(told.advice.contains("--formulation ggl --integrator radau_iia"), "{}", told.advice);
    assert_eq!(warning(&oscillator(1.0, 0.1), &Method::default(), 10.0), None);
    // A swing that is awake asks for its steps by accuracy.
    assert_eq!(warning(&oscillator(1e4, 0.0), &Method::default(), 10.0), None);
}

/// No false alarm: the shipped scenes with their own settings have methods that go with them.
#[test]
fn shipped_scenes_are_not_warned_of() {
    for path in crate::scenes::models() {
        let scene = crate::scenes::load(&path, &[]);
        let told = scene.0.stiffness(scene.span());
        assert!(told.is_none(), "{}: {told:?}", scene.0.name);
    }
    let told = crate::scenes::shipped("quarter_car", &[("c_strut", 2e5)]);
    let told = told.0.stiffness(told.span()).unwrap();
    // The strut pulls the wheel and the body together: c (1/m + 1/M).
    assert!((told.mode.decay / (2e5 * (1.0 / 38.0 + 1.0 / 400.0)) - 1.0).abs() < 0.01, "{told:?}");
    assert!((told.steps_for_stability / (2.5 * told.mode.rate() / 3.308) - 1.0).abs() < 0.01, "{told:?}");
}
