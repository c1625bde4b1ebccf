//! Slow and fast motion.

use super::super::extreme::{Extreme, decades};
use super::super::json::{elements, faster, has, multiply};
use serde_json::Value;
use std::sync::Arc;

/// Velocities of the start and the time of drivers times the factor, and the simulated time divided by it: as much motion
/// in each case.
pub const EXTREME: Extreme = Extreme {
    name: "speed",
    unit: "",
    about: "factor on the velocities of the start and the time of drivers; the simulated time divided by it",
    keeps_motion: false,
    suits: |subject| moves(&subject.base.scene),
    values: |_| decades(-1, 4, 1),
    apply: |case, factor| {
        quicken(Arc::make_mut(&mut case.scene), factor);
        case.duration /= factor;
        Ok(())
    },
};

const VELOCITIES: [&str; 3] = ["velocity", "angular_velocity", "elastic_velocity"];
const DRIVEN: [&str; 2] = ["driver", "equation"];

fn moves(scene: &Value) -> bool {
    let bodies = scene.get("bodies").and_then(Value::as_array).into_iter().flatten();
    let starts = bodies.filter_map(|body| body.get("initial"));
    let joints = scene.get("joints").and_then(Value::as_array).into_iter().flatten();
    let mut kinds = joints.filter_map(|joint| joint.get("type")?.as_str());
    starts.into_iter().any(|start| VELOCITIES.iter().any(|key| start.get(key).is_some()))
        || has(scene, "bodies", &["motion"])
        || kinds.any(|kind| DRIVEN.contains(&kind))
}

fn quicken(scene: &mut Value, factor: f64) {
    for start in elements(scene, "bodies").filter_map(|body| body.get_mut("initial")) {
        for key in VELOCITIES {
            match start.get_mut(key) {
                Some(Value::Object(map)) => map.values_mut().for_each(|value| multiply(value, factor)),
                Some(value) => multiply(value, factor),
                None => {}
            }
        }
    }
    let is_driven =
        |joint: &&mut Value| joint.get("type").and_then(Value::as_str).is_some_and(|kind| DRIVEN.contains(&kind));
    for joint in elements(scene, "joints").filter(is_driven) {
        for key in ["value", "expression"] {
            joint.get_mut(key).into_iter().for_each(|value| faster(value, factor));
        }
    }
}
