//! Numbers of a scene as JSON.

use serde_json::{Value, json};

/// Multiplies all numbers and expressions of a value.
pub fn scale(value: &mut Value, factor: f64) {
    match value {
        Value::Number(number) => *value = json!(factor * number.as_f64().unwrap_or(0.0)),
        Value::String(text) => *text = format!("{factor:e}*({text})"),
        Value::Array(all) => all.iter_mut().for_each(|value| scale(value, factor)),
        Value::Object(keys) => keys.values_mut().for_each(|value| scale(value, factor)),
        _ => {}
    }
}

/// Replaces a number or an expression, or each of a list of them that is not zero.
pub fn replace(value: &mut Value, by: f64) {
    match value {
        Value::Array(entries) => {
            entries.iter_mut().filter(|entry| entry.as_f64() != Some(0.0)).for_each(|entry| replace(entry, by))
        }
        _ => *value = Value::from(by),
    }
}

/// Velocities in the `initial` of a body.
const VELOCITIES: [&str; 3] = ["velocity", "angular_velocity", "elastic_velocity"];

/// True if a scene gives a velocity at the start.
pub fn has_velocities(scene: &Value) -> bool {
    let bodies = scene.get("bodies").and_then(Value::as_array).into_iter().flatten();
    let mut starts = bodies.filter_map(|body| body.get("initial"));
    let mut coordinates = scene.get("initial").and_then(Value::as_object).into_iter().flatten();
    starts.any(|start| VELOCITIES.iter().any(|key| start.get(key).is_some()))
        || coordinates.any(|(name, _)| is_rate(name))
}

/// Multiplies all velocities at the start.
pub fn faster(scene: &mut Value, factor: f64) {
    if factor == 1.0 {
        return;
    }
    for initial in elements(scene, "bodies").filter_map(|body| body.get_mut("initial")) {
        VELOCITIES.iter().filter_map(|key| initial.get_mut(key).map(|value| scale(value, factor))).for_each(drop);
    }
    let of_joints = scene.get_mut("initial").and_then(Value::as_object_mut).into_iter().flatten();
    of_joints.filter(|(name, _)| is_rate(name)).for_each(|(_, value)| scale(value, factor));
}

/// True for the rate of a joint coordinate at the start.
fn is_rate(coordinate: &str) -> bool {
    coordinate.ends_with('\'')
}

/// Replaces the time `t` in an expression, or in each of a list, by `factor` times `t`.
pub fn quicken(value: &mut Value, factor: f64) {
    match value {
        Value::Array(entries) => entries.iter_mut().for_each(|entry| quicken(entry, factor)),
        Value::String(text) => *text = with_time(text, factor),
        _ => {}
    }
}

fn with_time(text: &str, factor: f64) -> String {
    let is_letter = |c: char| c.is_alphanumeric() || c == '_' || c == '.';
    let time = format!("(t*{factor:e})");
    let mut out = String::new();
    for part in text.split_inclusive(|c: char| !is_letter(c)) {
        let word = part.trim_end_matches(|c: char| !is_letter(c));
        out += if word == "t" { time.as_str() } else { word };
        out += &part[word.len()..];
    }
    out
}

/// Returns the elements of a list of the scene.
pub fn elements<'a>(scene: &'a mut Value, list: &str) -> impl Iterator<Item = &'a mut Value> {
    scene.get_mut(list).and_then(Value::as_array_mut).into_iter().flatten()
}

/// True if some element of a list has one of these keys.
pub fn has(scene: &Value, list: &str, keys: &[&str]) -> bool {
    let mut elements = scene.get(list).and_then(Value::as_array).into_iter().flatten();
    elements.any(|element| keys.iter().any(|key| element.get(key).is_some()))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn expressions_are_wrapped() {
        let mut value = json!(["m*l^2", 2, [1e-3]]);
        scale(&mut value, 1e-8);
        assert_eq!(value, json!(["1e-8*(m*l^2)", 2e-8, [1e-8 * 1e-3]]));
        let mut value = json!("height*sin(t/2)^2 + t_end*tan(t)");
        quicken(&mut value, 100.0);
        assert_eq!(value, json!("height*sin((t*1e2)/2)^2 + t_end*tan((t*1e2))"));
    }
}
