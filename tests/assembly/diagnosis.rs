//! Each mistake has a text of its own.

use super::{assembled, prepared};
use serde_json::{Value, json};

/// A four-bar with these lengths, its guess with all bars along the ground.
fn four_bar(ground: f64, lengths: [f64; 3], angles: [f64; 3]) -> Value {
    let mut at = [0.0, 0.0];
    let mut bodies = Vec::new();
    let mut joints = Vec::new();
    for (i, (length, angle)) in lengths.iter().zip(angles).enumerate() {
        bodies.push(json!({ "name": format!("b{i}"), "type": "rigid", "mass": 1, "inertia": length * length / 12.0,
            "origin": [-0.5 * length, 0], "markers": { "A": [0, 0], "B": [length, 0] },
            "initial": { "position": at, "angle": angle } }));
        at = [at[0] + length * angle.cos(), at[1] + length * angle.sin()];
        let from = if i == 0 { "ground.O".to_string() } else { format!("b{}.B", i - 1) };
        joints.push(json!({ "name": format!("j{i}"), "type": "revolute", "between": [from, format!("b{i}.A")] }));
    }
    joints.push(json!({ "name": "close", "type": "revolute", "between": ["ground.D", "b2.B"] }));
    json!({ "name": "four_bar", "dimension": 2, "ground": { "markers": { "O": [0, 0], "D": [ground, 0] } },
        "bodies": bodies, "joints": joints })
}

fn message(scene: &Value) -> String {
    assembled(scene).unwrap_err().to_string()
}

/// G has lost rank where all bars are on one line: the assembly begins again beside it, and says so.
#[test]
fn a_guess_on_one_line_is_left() {
    let scene = four_bar(1.0, [0.5, 0.9, 0.7], [0.0; 3]);
    let prepared = prepared(&scene.to_string()).unwrap();
    assert!(prepared.assembly.after.phi < 1e-10);
    let doubts: Vec<String> = prepared.doubts.iter().map(|doubt| doubt.text.clone()).collect();
    assert!(doubts.iter().any(|text| text.contains("singular") && text.contains("`b")), "{doubts:?}");
}

#[test]
fn a_bar_that_is_too_short_is_named_with_the_gap() {
    let message = message(&four_bar(2.5, [0.5, 0.9, 0.7], [0.4, -0.2, 0.1]));
    assert!(message.contains("is out of reach, by 0.4 m"), "{message}");
}

#[test]
fn millimetres_among_metres_are_named() {
    let message = message(&four_bar(1.0, [0.5, 900.0, 0.7], [0.4, 0.2, -1.0]));
    // From the centre to the farthest marker.
    let told = message.contains("the longest part, `b1` with 450 m, is 1800 times as long as `b0` with 0.25 m");
    assert!(told && message.contains("millimetres"), "{message}");
}

#[test]
fn a_driver_that_asks_for_too_much_is_named_with_what_it_reaches() {
    let mut scene = four_bar(1.0, [0.5, 0.6, 0.55], [1.0, 0.19, -1.3]);
    let driver = json!({ "name": "drive", "type": "driver", "between": ["ground.O", "b0.A"], "coordinate": "angle",
        "value": "1.9 + 0.1*t" });
    scene["joints"].as_array_mut().unwrap().push(driver);
    let message = message(&scene);
    // cos(a) = (g^2 + a^2 - (c + d)^2)/(2 g a)
    assert!(message.contains("the driver `drive` asks for 1.9 rad, and the joints reach 1.643"), "{message}");
}

/// A bar held by a pin and a rod, and by a second rod that does not fit.
#[test]
fn a_joint_too_many_is_named() {
    let x = 0.6f64.cos();
    let y = 0.6f64.sin();
    let rod = |name: &str, from: &str, length: f64| json!({ "name": name, "type": "distance", "between": [from, "bar.B"], "length": length });
    let scene = json!({ "name": "bar", "dimension": 2,
        "ground": { "markers": { "O": [0, 0], "P": [0, 2], "Q": [2, 0] } },
        "bodies": [{ "name": "bar", "type": "rigid", "mass": 1, "inertia": 0.1, "origin": [-0.5, 0],
            "markers": { "O": [0, 0], "B": [1, 0] }, "initial": { "position": [0, 0], "angle": 0.6 } }],
        "joints": [{ "name": "pin", "type": "revolute", "between": ["ground.O", "bar.O"] },
            rod("first", "ground.P", x.hypot(2.0 - y)), rod("second", "ground.Q", (2.0 - x).hypot(y) + 0.25)] });
    let message = message(&scene);
    let told =
        message.contains("`second` is one joint too many: the others leave no freedom to close its gap of 0.25 m");
    assert!(told && message.contains("(4 equations, 3 velocities)"), "{message}");
}

/// A door whose upper hinge is 30 degrees off the axis of the lower one.
#[test]
fn an_axis_that_does_not_fit_is_named() {
    let marker = |z: f64, angle: f64| json!({ "position": [0, 0, z], "rotation": [angle, 0, 0] });
    let scene = json!({ "name": "door", "dimension": 3,
        "ground": { "markers": { "low": marker(0.0, 0.0), "high": marker(2.0, std::f64::consts::FRAC_PI_6) } },
        "bodies": [{ "name": "door", "type": "rigid", "mass": 1, "inertia": [1, 1, 1],
            "markers": { "low": [0, 0, -1], "high": [0, 0, 1] }, "initial": { "position": [0, 0, 1] } }],
        "joints": [
            { "name": "low", "type": "revolute", "between": ["ground.low", "door.low"] },
            { "name": "high", "type": "revolute", "between": ["ground.high", "door.high"] }] });
    let message = message(&scene);
    assert!(message.contains("do not fit: they stay 30 degrees apart"), "{message}");
}
