//! Scenes that grow from the schema alone.

use crate::random::Random;
use crate::words;
use serde_json::{Map, Value, json};

/// Deeper, only what is required grows.
const DEPTH: usize = 7;

/// A value that the schema allows; names come from few, so that some of them meet.
pub fn grow(schema: &Value, random: &mut Random) -> Value {
    value(schema, schema, 0, random)
}

fn value(root: &Value, schema: &Value, depth: usize, random: &mut Random) -> Value {
    if let Some(reference) = schema.get("$ref").and_then(Value::as_str) {
        let named = root.pointer(reference.trim_start_matches('#')).unwrap_or(&Value::Null);
        return value(root, named, depth, random);
    }
    if let Some(constant) = schema.get("const") {
        return constant.clone();
    }
    for key in ["enum", "examples"] {
        if let Some(found) = schema.get(key).and_then(Value::as_array).and_then(|all| random.pick(all)) {
            return found.clone();
        }
    }
    for key in ["oneOf", "anyOf"] {
        if let Some(found) = schema.get(key).and_then(Value::as_array).and_then(|all| random.pick(all)) {
            return value(root, found, depth, random);
        }
    }
    let types: Vec<&str> = match &schema["type"] {
        Value::Array(all) => all.iter().filter_map(Value::as_str).collect(),
        one => one.as_str().into_iter().collect(),
    };
    match random.pick(&types).copied() {
        Some("object") => object(root, schema, depth, random),
        Some("array") => {
            let count = if depth > DEPTH { 0 } else { random.one([0, 1, 2, 2, 3, 3, 4]) };
            (0..count).map(|_| value(root, &schema["items"], depth + 1, random)).collect()
        }
        Some("string") => json!(random.one(["a", "b", "c", "a.P", "b.P", "b.Q", "ground.P", "a.x", "x", "rz"])),
        Some("number" | "integer") => {
            if random.is_one_in(10) {
                words::number(random)
            } else {
                json!(random.one([1, 2, 3]))
            }
        }
        Some("boolean") => json!(random.is_one_in(2)),
        _ => Value::Null,
    }
}

fn object(root: &Value, schema: &Value, depth: usize, random: &mut Random) -> Value {
    let required: Vec<&str> = schema["required"].as_array().into_iter().flatten().filter_map(Value::as_str).collect();
    let mut made = Map::new();
    for (key, of) in schema["properties"].as_object().into_iter().flatten() {
        let is_grown = required.contains(&key.as_str()) || depth == 0 || depth <= DEPTH && random.is_one_in(3);
        if is_grown && key != "$schema" {
            made.insert(key.clone(), value(root, of, depth + 1, random));
        }
    }
    if let Some(of) = schema.get("additionalProperties").filter(|of| of.is_object()) {
        for name in ["P", "Q", "a"].into_iter().take(random.below(4)) {
            made.insert(name.to_string(), value(root, of, depth + 1, random));
        }
    }
    Value::Object(made)
}
