//! Reactions of equations and drives against closed forms.

use crate::scenes::{Ready, parse};
use holonom::prepared::{Model, Overrides};
use holonom::scene::Scene;
use serde_json::{Value, json};

/// A cam turns at 3 rad/s and lifts a follower of 2 kg by 0.1 sin(a): y'' = -0.9 sin(3 t), and the contact force is
/// m (y'' + g). `sign` and the order of the terms are those of the scene.
fn cam(expression: &str, outputs: &Value) -> Value {
    json!({ "name": "cam", "dimension": 2, "gravity": [0, -9.81],
        "ground": { "markers": { "O": [0, 0], "G": { "position": [0, 0], "angle": "pi/2" } } },
        "bodies": [
            { "name": "cam", "type": "rigid", "mass": 1, "inertia": 0.01 },
            { "name": "follower", "type": "rigid", "mass": 2, "inertia": 0.001,
              "markers": { "F": { "position": [0, 0], "angle": "pi/2" } }, "initial": { "position": [0, 0.1] } }],
        "joints": [
            { "name": "shaft", "type": "revolute", "between": ["ground.O", "cam"] },
            { "name": "guide", "type": "prismatic", "between": ["ground.G", "follower.F"] },
            { "name": "motor", "type": "driver", "between": ["ground.O", "cam"], "coordinate": "angle", "value": "3*t" },
            { "name": "contact", "type": "equation", "expression": expression }],
        "outputs": outputs, "simulation": { "t_end": 1 } })
}

fn load(t: f64) -> f64 {
    2.0 * (9.81 - 0.9 * (3.0 * t).sin())
}

/// Tolerance of what comes from v' at rtol 1e-12: sizes are 20 N.
const CLOSE: f64 = 1e-9;

/// f + G^T (-lambda) = M v': of phi = y - lift the force on the follower is -lambda, in any order of the terms; of
/// -phi it is lambda.
#[test]
fn the_reaction_of_an_equation_is_its_multiplier() {
    let outputs = json!([
        { "name": "lambda", "measure": "reaction", "of": "contact" },
        { "name": "force", "measure": "reaction", "of": "contact", "on": "follower" },
        { "name": "up", "measure": "reaction", "of": "contact", "on": "follower", "component": "y" },
        { "name": "torque", "measure": "reaction", "of": "contact", "on": "cam", "component": "mz" },
        { "name": "pressure", "measure": "expression", "value": "lambda/2" }]);
    let orders = [
        ("follower.y - 0.1 - 0.1*sin(cam.angle)", -1.0),
        ("-0.1*sin(cam.angle) + follower.y - 0.1", -1.0),
        ("0.1*sin(cam.angle) + 0.1 - follower.y", 1.0),
    ];
    for (expression, sign) in orders {
        let run = parse(&cam(expression, &outputs).to_string()).tight(1e-12, 1.0, 0.1);
        let close = |name: &str, expected: fn(f64) -> f64, factor: f64| {
            let error = run.worst(name, |t| factor * expected(t));
            assert!(error < CLOSE, "{expression}: {name} is off by {error:e}");
        };
        close("lambda", load, sign);
        close("pressure", load, 0.5 * sign);
        close("force", load, 1.0);
        close("up", load, 1.0);
        // Virtual work: the torque on the cam times its rate is the power that the follower takes.
        close("torque", |t| -load(t) * 0.1 * (3.0 * t).cos(), 1.0);
        // No unit is known of an expression.
        let units = &run.record.trajectory.outputs;
        assert_eq!([&units[0].unit, &units[1].unit, &units[3].unit], ["", "N", "N m"]);
    }
}

fn refused(output: Value) -> String {
    let scene = Scene::parse(&cam("follower.y - 0.1 - 0.1*sin(cam.angle)", &json!([output])).to_string(), &[]);
    let prepared = scene.and_then(|scene| Model::new(scene, &Overrides::default()));
    prepared.err().map_or(String::new(), |error| error.to_string())
}

#[test]
fn a_component_of_an_equation_needs_its_body() {
    let message = refused(json!({ "name": "c", "measure": "reaction", "of": "contact", "component": "y" }));
    assert!(message.contains("outputs[0].on") && message.contains("`contact` acts on 2 markers"), "{message}");
    assert!(message.contains("name the body on which the force is meant"), "{message}");
    let message = refused(json!({ "name": "c", "measure": "reaction", "of": "contact", "on": "ground" }));
    assert!(message.contains("`contact` does not act on `ground`"), "{message}");
}

/// A winch lifts 3 kg with y'' = 2: the rope carries 3 (9.81 + 2) N, in tension.
#[test]
fn a_rope_that_is_wound_up_is_in_tension() {
    let ready: Ready = parse(
        &json!({ "name": "winch", "dimension": 2, "gravity": [0, -9.81], "ground": { "markers": { "O": [0, 0] } },
            "bodies": [{ "name": "load", "type": "point_mass", "mass": 3, "initial": { "position": [0, -4] } }],
            "joints": [{ "name": "rope", "type": "driver", "between": ["ground.O", "load"], "coordinate": "distance",
                         "value": "4 - t^2" }],
            "outputs": [{ "name": "tension", "measure": "reaction", "of": "rope", "component": "axial" },
                        { "name": "push", "measure": "reaction", "of": "rope" }],
            "simulation": { "t_end": 1 } })
        .to_string(),
    );
    let run = ready.tight(1e-12, 1.0, 0.1);
    for (name, expected) in [("tension", 3.0 * 11.81), ("push", -3.0 * 11.81)] {
        let error = run.worst(name, |_| expected);
        assert!(error < CLOSE, "{name} is off by {error:e}");
    }
}
