//! Motions near the given one: what is moved, and that every model is moved the same.

use super::{damper, left_out, pendulum, pin, promised, scene, settings};
use holonom::simplify::{Nearby, Robustness, SimplificationSettings};
use serde_json::{Value, json};

fn near(json: Value, within: f64) -> Robustness {
    let nearby = Some(Nearby { by: 0.1, samples: Some(6) });
    scene(json, &SimplificationSettings { nearby, ..settings(within, &[]) }).robustness.unwrap()
}

/// The same samples in every run; a parameter that is a number of elements is not moved.
#[test]
fn a_promise_is_tried_on_motions_nearby() {
    let nearby = Some(Nearby { by: 0.1, samples: Some(6) });
    let own = || {
        let found = scene(
            pendulum(pin(), json!([damper("weak", 0.01)])),
            &SimplificationSettings { nearby, ..settings(0.05, &[]) },
        );
        let near = found.robustness.unwrap();
        assert_eq!((near.counted, near.kept, &near.parameters[..]), (6, 6, &["m".to_string(), "k".to_string()][..]));
        assert!(near.positions && !near.velocities && near.inputs.is_empty());
        let errors: Vec<_> = near.motions.into_iter().map(|motion| motion.worst).collect();
        assert!(errors[0] != errors[1]);
        (found.simplified, errors)
    };
    assert_eq!(own(), own());
}

/// A cart on a spring that follows a road, pushed by an input: both are moved. Where a driver says where it is, its start
/// is not.
#[test]
fn inputs_and_signals_are_moved() {
    let road: Vec<[f64; 2]> = (0..=100).map(|i| 0.04 * i as f64).map(|s| [s, 0.1 * s.sin()]).collect();
    let own = |joints: Value| {
        json!({ "name": "cart", "dimension": 2, "parameters": { "m": 2 },
                "ground": { "markers": { "O": [0, 0] } },
                "signals": [{ "name": "road", "points": road }],
                "bodies": [{ "name": "cart", "type": "rigid", "mass": "m", "free": ["x"], "markers": { "C": [0, 0] } }],
                "joints": joints,
                "forces": [{ "name": "spring", "type": "applied_force", "at": "cart", "force": ["30*(road(t) - cart.x)", 0] }],
                "inputs": [{ "name": "push", "force": "spring", "component": "x", "value": "sin(t)" }],
                "outputs": [{ "name": "x", "measure": "position", "of": "cart", "component": "x" },
                            { "name": "push", "measure": "force", "of": "spring", "component": "x" }],
                "simulation": { "t_end": 2, "output_step": 0.02, "rtol": 1e-7, "atol": 1e-9 } })
    };
    let free = near(own(json!([])), 0.05);
    assert_eq!(
        (free.inputs, free.positions, free.velocities),
        (vec!["push".to_string(), "road".to_string()], true, false)
    );
    let driver = json!([{ "name": "drive", "type": "driver", "between": ["ground.O", "cart.C"], "coordinate": "distance",
                          "value": "1 + 0.1*t" }]);
    let mut driven = own(driver);
    driven["bodies"][0]["initial"] = json!({ "position": [1, 0] });
    assert!(!near(driven, 0.05).positions);
}

/// A double pendulum that starts by the angles of its joints, with a weld that goes: the simpler model starts where the
/// richest does on every motion, so that both move the same.
#[test]
fn every_model_starts_where_the_richest_does() {
    let joints = json!([{ "name": "O", "type": "revolute", "between": ["ground.O", "rod.A"] },
                        { "name": "W", "type": "weld", "between": ["rod.B", "disc.C"] },
                        { "name": "P", "type": "revolute", "between": ["disc.C", "tail.A"] }]);
    let mut own = pendulum(joints, json!([]));
    let body = |name: &str, x: f64| {
        json!({ "name": name, "type": "rigid", "mass": 0.5, "inertia": 0.02, "markers": { "C": [0, 0], "A": [-0.2, 0] },
                "initial": { "position": [x, 0] } })
    };
    own["bodies"].as_array_mut().unwrap().extend([body("disc", 1.0), body("tail", 1.2)]);
    let bodies = promised(own.clone(), &settings(0.01, &[]));
    own["initial"] = json!({ "O.angle": 0.2, "P.angle": "0.1*m", "O.angle'": 0.5 });
    let by_joints = promised(own, &settings(0.01, &[]));
    for found in [bodies, by_joints] {
        assert_eq!(left_out(&found)[0], "rod and disc become one body", "{:?}", found.trials);
        let near = found.robustness.unwrap();
        let worst = near.worst().unwrap().error;
        // The motion is the same, but for the errors of a method of which a tenth of the promise is granted.
        assert!(near.positions && worst < 1e-3, "{worst:e}");
    }
}
