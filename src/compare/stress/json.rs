//! Changes of a scene's JSON by expressions around its values.

use serde_json::Value;

/// Multiplies a number, an expression or each of a list of them.
pub fn multiply(value: &mut Value, factor: f64) {
    match value {
        Value::Array(entries) => entries.iter_mut().for_each(|entry| multiply(entry, factor)),
        Value::String(text) => *value = Value::String(format!("({text})*{factor:e}")),
        Value::Number(number) => *value = Value::String(format!("({number})*{factor:e}")),
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

/// Replaces the time `t` in an expression by `factor` times `t`.
pub fn faster(value: &mut Value, factor: f64) {
    match value {
        Value::Array(entries) => entries.iter_mut().for_each(|entry| faster(entry, factor)),
        Value::String(text) => *value = Value::String(with_time(text, factor)),
        _ => {}
    }
}

fn with_time(text: &str, factor: f64) -> String {
    let is_letter = |c: char| c.is_alphanumeric() || c == '_' || c == '.';
    let mut out = String::new();
    let mut word = String::new();
    let flush = |word: &mut String, out: &mut String| {
        if word == "t" {
            *out += &format!("(t*{factor:e})")
        } else {
            *out += word
        };
        word.clear();
    };
    for c in text.chars() {
        if is_letter(c) {
            word.push(c);
        } else {
            flush(&mut word, &mut out);
            out.push(c);
        }
    }
    flush(&mut word, &mut out);
    out
}

/// Returns the elements of a list of the scene.
pub fn elements<'a>(scene: &'a mut Value, list: &str) -> impl Iterator<Item = &'a mut Value> {
    scene.get_mut(list).and_then(Value::as_array_mut).into_iter().flatten()
}

/// True if some element of a list has one of these keys.
pub fn has(scene: &Value, list: &str, keys: &[&str]) -> bool {
    let elements = scene.get(list).and_then(Value::as_array).into_iter().flatten();
    elements.into_iter().any(|element| keys.iter().any(|key| element.get(key).is_some()))
}

#[cfg(test)]
mod tests {
    use super::*;
    use serde_json::json;

    #[test]
    fn expressions_are_wrapped() {
        let mut value = json!(["m*l^2", 2, [1e-3]]);
        multiply(&mut value, 1e-8);
        assert_eq!(value, json!(["(m*l^2)*1e-8", "(2)*1e-8", ["(0.001)*1e-8"]]));
        let mut value = json!("height*sin(t/2)^2 + t_end*tan(t)");
        faster(&mut value, 100.0);
        assert_eq!(value, json!("height*sin((t*1e2)/2)^2 + t_end*tan((t*1e2))"));
    }
}
