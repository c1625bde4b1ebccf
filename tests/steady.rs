//! Motions without what an estimate of the error looks at: accelerations that change. Every adaptive method follows
//! them as accurately as asked.

use crate::common::{adaptive, until};
use crate::scenes::{Ready, parse};
use holonom::integrator::{IntegratorEntry, Steps, registry};
use rayon::prelude::*;

/// Each adaptive integrator with each formulation that solves rows, or with index 1.
fn methods() -> Vec<(&'static str, &'static str)> {
    let adaptive = registry().iter().filter(|entry| entry.steps != Steps::Fixed);
    let pairs = |entry: &'static IntegratorEntry| {
        let solved = ["index1", "index2", "index3", "ggl"];
        entry.accepts().filter(move |formulation| solved.contains(formulation)).map(move |name| (name, entry.name))
    };
    adaptive.flat_map(pairs).collect()
}

fn scene(bodies: &str, joints: &str, forces: &str, output: &str) -> Ready {
    parse(&format!(
        r#"{{ "name": "steady", "dimension": 3, "ground": {{ "markers": {{ "O": [0, 0, 0] }} }},
        "bodies": [{bodies}], "joints": [{joints}], "forces": [{forces}], "outputs": [{output}] }}"#
    ))
}

const ROTOR: &str = r#"{ "name": "r", "type": "rigid", "mass": 1, "inertia": [1, 1, 1.5],
    "markers": { "O": [0, 0, 0], "P": [1, 0, 0] }, "initial": { "angular_velocity": [0, 0, 10] } }"#;
const HINGE: &str = r#"{ "name": "h", "type": "revolute", "between": ["ground.O", "r.O"] }"#;
const PX: &str = r#"{ "name": "x", "measure": "position", "of": "r.P", "component": "x" }"#;

/// Distance of the output `x` at `end` from `exact` in tolerances, for every method at these tolerances.
fn follows(what: &str, ready: &Ready, end: f64, exact: f64) {
    methods().into_par_iter().for_each(|(formulation, integrator)| {
        for tolerance in [1e-3, 1e-5] {
            let run = ready.run(&adaptive(formulation, integrator, "none", tolerance), until(end));
            let error = (run.column("x").last().unwrap() - exact).abs() / tolerance;
            println!("{what} {formulation} {integrator} {tolerance:e}: {error:.2} tolerances");
            assert!(error < 10.0, "{what} {formulation} {integrator} {tolerance:e}: {error:.1} tolerances");
        }
    });
}

/// q' = N(q) v turns with v constant.
#[test]
fn steady_motions_are_as_accurate_as_asked() {
    follows("free spin", &scene(ROTOR, "", "", PX), 3.0, 30f64.cos());
    follows("hinged", &scene(ROTOR, HINGE, "", PX), 3.0, 30f64.cos());
    let flying = ROTOR.replace(r#""angular_velocity": [0, 0, 10]"#, r#""velocity": [0.7, -2, 3]"#);
    follows("translation", &scene(&flying, "", "", PX), 3.0, 1.0 + 0.7 * 3.0);
}

/// A slider at a constant speed whose rail carries a load that swings across it.
#[test]
fn loads_that_joints_carry_leave_the_motion_steady() {
    let slider = ROTOR.replace(r#""angular_velocity": [0, 0, 10]"#, r#""velocity": [0, 0, 0.7]"#);
    let rail = r#"{ "name": "rail", "type": "prismatic", "between": ["ground.O", "r.O"] }"#;
    let load = r#"{ "name": "load", "type": "applied_force", "at": "r.P", "force": ["50*sin(3*t)", "20*t", 0] }"#;
    let z = PX.replace(r#""component": "x""#, r#""component": "z""#);
    follows("slider", &scene(&slider, rail, load, &z), 3.0, 0.7 * 3.0);
}

#[test]
fn prescribed_motions_are_those_prescribed() {
    let still = ROTOR.replace("[0, 0, 10]", "[0, 0, 0]");
    let joints = format!(
        r#"{HINGE}, {{ "name": "d", "type": "driver", "between": ["ground.O", "r.O"], "coordinate": "angle",
        "value": "5*t + smoothstep(t/2)" }}"#
    );
    follows("driven", &scene(&still, &joints, "", PX), 3.0, 16f64.cos());
}

/// 100 rad/s beside a pendulum of some 3 rad/s, which alone shows in the accelerations.
#[test]
fn a_fast_rotor_beside_a_slow_pendulum() {
    let bodies = ROTOR.replace("[0, 0, 10]", "[0, 0, 100]")
        + r#", { "name": "p", "type": "rigid", "mass": 1, "inertia": [0.1, 0.1, 0.1],
        "markers": { "Q": { "position": [-1, 0, 0], "rotation": ["pi/2", 0, 0] } }, "initial": { "position": [1, 3, 0] } }"#;
    let weight = r#"{ "name": "w", "type": "applied_force", "at": "p", "force": [0, 0, -9.81] }"#;
    let joints = format!(r#"{HINGE}, {{ "name": "k", "type": "revolute", "between": ["ground.Q", "p.Q"] }}"#);
    let ready = parse(&format!(
        r#"{{ "name": "flywheel", "dimension": 3,
        "ground": {{ "markers": {{ "O": [0, 0, 0], "Q": {{ "position": [0, 3, 0], "rotation": ["pi/2", 0, 0] }} }} }},
        "bodies": [{bodies}], "joints": [{joints}], "forces": [{weight}], "outputs": [{PX}] }}"#
    ));
    follows("flywheel", &ready, 0.3, 30f64.cos());
}

/// A free body under a constant torque about a second axis of its own: v' hardly changes, and the axis of the rotation
/// moves. The reference is dop853 at 1e-12.
#[test]
fn a_rotation_whose_axis_moves_is_as_accurate_as_asked() {
    let body = ROTOR.replace("[1, 1, 1.5]", "[1, 1, 1]");
    let torque = r#"{ "name": "m", "type": "applied_torque", "at": "r.O", "torque": [0, 8, 0], "axes": "marker" }"#;
    let ready = scene(&body, "", torque, PX);
    let exact = ready.run(&adaptive("index1", "dop853", "none", 1e-12), until(2.0));
    follows("moving axis", &ready, 2.0, *exact.column("x").last().unwrap());
}
