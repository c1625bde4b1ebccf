//! A controller from `ltv.npz` alone, by a script for Python: it runs where Python has NumPy.

use super::*;

fn has_numpy() -> bool {
    Command::new("python3").args(["-c", "import numpy"]).output().is_ok_and(|output| output.status.success())
}

/// Runs the script; returns how far the end is off the nominal motion, without and with the controller.
fn controlled(scene: &Value, times: &str, disturbance: &str) -> Option<[f64; 2]> {
    if !has_numpy() {
        println!("skipped: python3 with numpy is not installed");
        return None;
    }
    let place = Place::new(scene.to_string());
    let script = Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/examples/time_varying_lqr.py");
    let output = Command::new("python3")
        .arg(script)
        .args([env!("CARGO_BIN_EXE_holonom"), "scene.json", "out", times, disturbance])
        .current_dir(place.path("."))
        .output()
        .unwrap();
    assert!(output.status.success(), "{}", err(&output));
    let text = out(&output);
    let numbers: Vec<f64> = text.split_whitespace().filter_map(|word| word.parse().ok()).collect();
    Some([numbers[0], numbers[1]])
}

fn shipped(name: &str) -> Value {
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join(format!("models/{name}.json"));
    serde_json::from_str(&fs::read_to_string(path).unwrap()).unwrap()
}

/// Two rods with a motor at each, that start level.
#[test]
fn a_script_keeps_a_double_pendulum_on_its_motion() {
    let rod = |name: &str, x: &str, y: &str| {
        serde_json::json!({
            "name": name, "type": "rigid", "mass": 1, "inertia": "1/12", "markers": { "A": [-0.5, 0], "B": [0.5, 0] },
            "initial": { "position": [x, y], "angle": "a" }
        })
    };
    let motor =
        |name: &str, at: &str| serde_json::json!({ "name": name, "type": "applied_torque", "at": at, "torque": 0 });
    let scene = serde_json::json!({
        "name": "rods", "dimension": 2, "gravity": [0, -9.81], "parameters": { "a": 0 },
        "ground": { "markers": { "O": [0, 0] } },
        "bodies": [rod("upper", "0.5*cos(a)", "0.5*sin(a)"), rod("lower", "1.5*cos(a)", "1.5*sin(a)")],
        "joints": [
            { "name": "shoulder", "type": "revolute", "between": ["ground.O", "upper.A"] },
            { "name": "elbow", "type": "revolute", "between": ["upper.B", "lower.A"] }
        ],
        "forces": [motor("m1", "upper"), motor("m2", "lower")],
        "inputs": [{ "name": "first", "force": "m1" }, { "name": "second", "force": "m2" }],
        "simulation": { "t_end": 2 }
    });
    let Some([free, kept]) = controlled(&scene, "0..2:101", "a=0.05") else { return };
    assert!(free > 0.05 && kept < 1e-3 * free, "{free} {kept}");
}

/// The shipped robot arm, whose motion amplifies a change of its start, with a motor at the shoulder.
#[test]
fn a_script_keeps_the_robot_arm_on_its_motion() {
    let mut scene = shipped("robot_arm");
    scene["forces"] = serde_json::json!([{ "name": "motor", "type": "applied_torque", "at": "upper", "torque": 0 }]);
    scene["inputs"] = serde_json::json!([{ "name": "motor", "force": "motor" }]);
    scene["simulation"]["t_end"] = 5.into();
    let Some([free, kept]) = controlled(&scene, "0..5:401", "theta0=1.25") else { return };
    assert!(free > 0.05 && kept < 1e-4 * free, "{free} {kept}");
}
