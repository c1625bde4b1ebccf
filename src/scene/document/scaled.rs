//! Numbers of a scene multiplied by a factor.

use super::edit::{changed, elements, elements_mut};
use serde_json::{Value, json};

/// Velocities of a body at the start.
const VELOCITIES: [&str; 3] = ["velocity", "angular_velocity", "elastic_velocity"];

/// Multiplies all numbers and expressions of a value.
pub fn multiply(value: &mut Value, factor: f64) {
    match value {
        Value::Number(number) => *value = json!(factor * number.as_f64().unwrap_or(0.0)),
        Value::String(text) => *text = format!("({text})*{factor:e}"),
        Value::Array(all) => all.iter_mut().for_each(|value| multiply(value, factor)),
        Value::Object(keys) => keys.values_mut().for_each(|value| multiply(value, factor)),
        _ => {}
    }
}

pub fn has_velocities(scene: &Value) -> bool {
    elements(scene, "bodies").iter().any(|body| VELOCITIES.iter().any(|key| body["initial"].get(key).is_some()))
        || scene["initial"].as_object().is_some_and(|given| given.keys().any(|name| is_rate(name)))
}

/// Multiplies all velocities at the start.
pub fn multiply_velocities(scene: &mut Value, factor: f64) {
    for start in elements_mut(scene, "bodies").filter_map(|body| body.get_mut("initial")) {
        VELOCITIES.iter().for_each(|key| start.get_mut(key).into_iter().for_each(|value| multiply(value, factor)));
    }
    let of_joints = scene.get_mut("initial").and_then(Value::as_object_mut).into_iter().flatten();
    of_joints.filter(|(name, _)| is_rate(name)).for_each(|(_, value)| multiply(value, factor));
}

/// True for the rate of a joint coordinate at the start.
fn is_rate(name: &str) -> bool {
    name.ends_with('\'')
}

/// Replaces the time `t` in an expression by `factor` times `t`.
pub fn faster(value: &mut Value, factor: f64) {
    match value {
        Value::Array(entries) => entries.iter_mut().for_each(|entry| faster(entry, factor)),
        Value::String(text) => {
            *text = changed(text, &mut |word, _| (word == "t").then(|| format!("(t*{factor:e})")));
        }
        _ => {}
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn expressions_are_wrapped() {
        let mut value = json!(["m*l^2", 2, [1e-3]]);
        multiply(&mut value, 1e-8);
        assert_eq!(value, json!(["(m*l^2)*1e-8", 2e-8, [1e-3 * 1e-8]]));
        let mut value = json!("height*sin(t/2)^2 + t_end*tan(t)");
        faster(&mut value, 100.0);
        assert_eq!(value, json!("height*sin((t*1e2)/2)^2 + t_end*tan((t*1e2))"));
    }
}
