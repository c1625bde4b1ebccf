//! A driver that asks for more than the joints reach: G loses rank, phi_t is not zero along the lost row, and no motion
//! goes on from there.

use crate::scenes::{Ready, parse};
use holonom::analysis::Recorder;
use holonom::method_spec::MethodSpec;
use holonom::simulate::{Method, Span, simulate};

/// A crank of 0.5, a coupler of 0.6 and a rocker of 0.55 over a ground of 1: coupler and rocker are in line at cos(a) =
/// (1 + 0.5^2 - 1.15^2)/(2 * 0.5), which the drive passes by a thousandth.
fn beyond(joint: &str) -> Ready {
    let bar = |name: &str, length: f64, [x, y]: [f64; 2], angle: f64, ends: [&str; 2]| {
        format!(
            r#"{{ "name": "{name}", "type": "rigid", "mass": 1, "inertia": 0.1, "origin": [{}, 0],
                "markers": {{ "{}": [0, 0], "{}": [{length}, 0] }},
                "initial": {{ "position": [{x}, {y}], "angle": {angle} }} }}"#,
            -0.5 * length,
            ends[0],
            ends[1]
        )
    };
    parse(&format!(
        r#"{{ "name": "beyond", "dimension": 2, "ground": {{ "markers": {{ "O": [0, 0], "D": [1, 0] }} }},
            "bodies": [{}, {}, {}],
            "joints": [{{ "name": "o", "type": "revolute", "between": ["ground.O", "crank.O"] }},
                {{ "name": "a", "type": "revolute", "between": ["crank.A", "coupler.A"] }},
                {{ "name": "b", "type": "revolute", "between": ["coupler.B", "rocker.B"] }},
                {{ "name": "d", "type": "revolute", "between": ["ground.D", "rocker.D"] }}, {joint}] }}"#,
        bar("crank", 0.5, [0.0, 0.0], 1.0, ["O", "A"]),
        bar("coupler", 0.6, [0.270_151_152_934_069_9, 0.420_735_492_403_948_25], 0.186_223_351_524_646, ["A", "B"]),
        bar("rocker", 0.55, [1.0, 0.0], 1.828_592_427_570_065, ["D", "B"]),
    ))
}

const VALUE: &str = "1.0 + 0.6443599905155815*(1 - cos(3*t))/2";

fn driver() -> Ready {
    beyond(&format!(
        r#"{{ "name": "drive", "type": "driver", "between": ["ground.O", "crank.O"], "coordinate": "angle",
            "value": "{VALUE}" }}"#
    ))
}

/// The angle at which coupler and rocker are in line, and the time at which the drive asks for it.
fn end_of_travel() -> (f64, f64) {
    let angle = ((1.25 - 1.15f64.powi(2)) / 1.0).acos();
    (angle, (1.0 - 2.0 * (angle - 1.0) / 0.6443599905155815).acos() / 3.0)
}

fn method(formulation: &str, integrator: &str, projection: &str, step: Option<f64>) -> Method {
    let spec = |text: &str| MethodSpec::parse(text).unwrap();
    let [formulation, integrator, projection] = [formulation, integrator, projection].map(spec);
    Method { formulation, integrator, projection, rtol: 1e-7, atol: 1e-7, step }
}

/// The failure of a run with its reason, and the times of the rows.
fn failed(scene: &Ready, method: &Method) -> (f64, String, Vec<f64>) {
    let mut recorder = Recorder::new(scene.system());
    let span = Span { start: 0.0, end: 6.0, output_step: 0.15 };
    let outcome = simulate(scene.system(), method, span, scene.0.start(), &mut recorder).unwrap();
    let failure = outcome.failure.unwrap_or_else(|| panic!("{method:?}"));
    (failure.t, failure.reason, recorder.finish().trajectory.times().collect())
}

const ADAPTIVE: [[&str; 3]; 16] = [
    ["index1", "dop853", "manifold"],
    ["index1", "dopri5", "none"],
    ["baumgarte", "dop853", "none"],
    ["index1", "adams", "manifold"],
    ["ggl", "radau_iia", "none"],
    ["index2", "radau_iia", "none"],
    ["ggl", "bdf", "none"],
    ["index3", "generalized_alpha", "none"],
    ["index3", "generalized_alpha", "manifold"],
    ["index1", "dopri5", "exact"],
    ["null_space", "dopri5", "manifold"],
    ["udwadia_kalaba", "dopri5", "none"],
    ["penalty", "dopri5", "manifold"],
    ["baumgarte", "radau_iia", "none"],
    ["penalty", "dopri5", "none"],
    ["augmented_lagrangian", "dopri5", "none"],
];

fn is_told(scene: &Ready, method: &Method) {
    let (angle, end) = end_of_travel();
    let (t, reason, rows) = failed(scene, method);
    // Positions close to 1e-10 rad, which the drive of 0.06 rad/s passes in 2e-9 s.
    assert!((t - end).abs() < 1e-8, "{method:?}: {t} {end}: {reason}");
    let reached = format!("its travel ends at {angle:.8}");
    let told = reason.contains("the driver `drive` later asks for 1.64435999 rad") && reason.contains(&reached);
    assert!(told, "{method:?}: {reason}");
    // Rows at 0, 0.15 ... 0.9, and the last good state.
    assert!(rows.len() >= 7 && rows.iter().all(|row| *row <= end + 1e-8), "{method:?}: {rows:?}");
}

#[test]
fn a_driver_beyond_its_travel_is_named() {
    let scene = driver();
    for [formulation, integrator, projection] in ADAPTIVE {
        is_told(&scene, &method(formulation, integrator, projection, None));
    }
}

#[test]
fn fixed_steps_do_not_go_over_the_end_of_a_travel() {
    let scene = driver();
    for (formulation, integrator, projection) in [
        ("index1", "rk4", "manifold"),
        ("index1", "rk4", "none"),
        ("index3", "rattle", "none"),
        ("penalty", "rk4", "none"),
    ] {
        is_told(&scene, &method(formulation, integrator, projection, Some(1e-3)));
    }
}

/// An equation that depends on time has no value, but an end.
#[test]
fn an_equation_of_time_beyond_its_travel_is_named() {
    let scene = beyond(&format!(r#"{{ "name": "law", "type": "equation", "expression": "crank.angle - ({VALUE})" }}"#));
    let (t, reason, _) = failed(&scene, &method("index1", "dop853", "manifold", None));
    assert!((t - end_of_travel().1).abs() < 1e-8 && reason.contains("`law`"), "{t}: {reason}");
}

/// The drive turns back a thousandth before the end: a singular state is near, and the motion goes on.
#[test]
fn a_driver_that_turns_back_in_time_is_not_stopped() {
    let value = "1.0 + 0.6423599905155815*(1 - cos(3*t))/2";
    let scene = beyond(&format!(
        r#"{{ "name": "drive", "type": "driver", "between": ["ground.O", "crank.O"], "coordinate": "angle",
            "value": "{value}" }}"#
    ));
    for [formulation, integrator, projection] in [["index1", "dop853", "manifold"], ["ggl", "radau_iia", "none"]] {
        scene.run(&method(formulation, integrator, projection, None), Span { start: 0.0, end: 4.0, output_step: 0.1 });
    }
}
