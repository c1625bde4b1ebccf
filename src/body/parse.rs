//! Types parsed from JSON, with errors that a user understands.

use crate::error::{Error, Result, excerpt, suggest};
use serde::de::DeserializeOwned;
use serde_json::Value;
use serde_path_to_error::{Path, Segment};
use std::borrow::Borrow;

/// Reads a type from JSON; errors carry the path within it and suggest the nearest key.
pub fn parse<T: DeserializeOwned>(json: impl Borrow<Value>) -> Result<T> {
    parse_among(json, &[])
}

/// Reads a type from an element whose other keys, `shared`, have been removed: a misspelled key may be meant as
/// one of them.
pub fn parse_among<T: DeserializeOwned>(json: impl Borrow<Value>, shared: &[&str]) -> Result<T> {
    let json = json.borrow();
    // Following the path takes as long as reading, and is needed for errors alone.
    T::deserialize(json).or_else(|_| serde_path_to_error::deserialize(json)).map_err(|error| {
        let found = at(json, error.path());
        let path = error.path().to_string();
        let error = explain(&error.inner().to_string(), found, shared);
        if path == "." || path == "?" { error } else { error.under(path.trim_end_matches(".?")) }
    })
}

/// The value at `path`, or the deepest one that exists.
fn at<'a>(json: &'a Value, path: &Path) -> &'a Value {
    let enter = |value: &'a Value, segment: &Segment| match segment {
        Segment::Map { key } => value.get(key),
        Segment::Seq { index } => value.get(index),
        Segment::Enum { variant } => value.get(variant),
        Segment::Unknown => None,
    };
    path.iter().try_fold(json, |value, segment| enter(value, segment).ok_or(value)).unwrap_or_else(|deepest| deepest)
}

/// Rewrites serde's message: what is expected, what was found, and the nearest known name.
fn explain(message: &str, found: &Value, shared: &[&str]) -> Error {
    let quoted: Vec<&str> = message.split('`').skip(1).step_by(2).collect();
    let (name, known) = quoted.split_first().unwrap_or((&"?", &[]));
    if message.starts_with("unknown field") {
        let known = known.iter().chain(shared).copied();
        return Error::input(format!("unknown key `{name}`")).hint(suggest(name, known));
    }
    if message.starts_with("unknown variant") {
        return Error::input(format!("`{name}` is none of the possible values"))
            .hint(suggest(name, known.iter().copied()));
    }
    if message.starts_with("missing field") {
        return Error::input(format!("the key `{name}` is missing"))
            .hint(format!("add \"{name}\": ...; `holonom schema` says what it means"));
    }
    if message.starts_with("invalid value: integer") {
        return Error::input(format!("{found} is out of range"));
    }
    if let Some((_, expected)) = message.strip_prefix("invalid ").and_then(|rest| rest.rsplit_once(", expected ")) {
        return Error::input(format!("expected {}, found {}", in_words(expected), show(found)));
    }
    match message.split_once("\n  help: ") {
        Some((message, hint)) => Error::input(message).hint(hint),
        None if message.starts_with("expected ") && !message.contains(", found ") => {
            Error::input(format!("{message}, found {}", show(found)))
        }
        None => Error::input(message),
    }
}

/// Plain name of what serde expects, such as `a whole number` for `u32`.
fn in_words(expected: &str) -> String {
    match expected {
        "u8" | "u32" | "u64" | "usize" | "i32" | "i64" => "a whole number".to_string(),
        "f64" => "a number".to_string(),
        "a boolean" => "true or false".to_string(),
        "a string" | "string" => "text in quotes".to_string(),
        "a sequence" => "a list [...]".to_string(),
        "fewer elements in array" => "a shorter list".to_string(),
        "a map" => "an object {...}".to_string(),
        other if other.starts_with("struct ") => "an object {...}".to_string(),
        other => match other.strip_prefix("an array of length ") {
            Some(length) => format!("a list of {length}"),
            None => other.to_string(),
        },
    }
}

/// A value, short enough for a message.
pub fn show(value: &Value) -> String {
    match value {
        Value::Object(_) => "an object".to_string(),
        Value::Array(items) if items.is_empty() => "an empty list".to_string(),
        Value::Array(items) => format!("a list of {}", items.len()),
        Value::String(text) => format!("\"{}\"", excerpt(text)),
        other => other.to_string(),
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::math::expression::Number;
    use serde::Deserialize;
    use serde_json::json;

    #[derive(Deserialize, Debug)]
    #[serde(deny_unknown_fields)]
    #[allow(dead_code)]
    struct Gear {
        between: [String; 2],
        teeth: Option<i32>,
        axis: Option<Vec<Number>>,
        side: Option<Side>,
        shape: Option<Shape>,
    }

    #[derive(Deserialize, Debug)]
    #[serde(rename_all = "snake_case")]
    #[allow(dead_code)]
    enum Shape {
        Ring { width: f64 },
    }

    #[derive(Deserialize, Debug)]
    #[serde(rename_all = "snake_case")]
    enum Side {
        Inner,
        Outer,
    }

    #[test]
    fn errors_are_in_words() {
        let table = [
            (json!({ "betwen": [] }), "at betwen: unknown key `betwen`\n  help: did you mean `between`?"),
            (json!({ "nmae": 1 }), "at nmae: unknown key `nmae`\n  help: did you mean `name`?"),
            (
                json!({ "teeth": 1 }),
                "the key `between` is missing\n  help: add \"between\": ...; `holonom schema` says what it means",
            ),
            (json!({ "between": ["a"] }), "at between: expected a list of 2, found a list of 1"),
            (json!({ "between": ["a", "b", "c"] }), "at between: expected a shorter list, found a list of 3"),
            (json!({ "between": "a" }), "at between: expected a list of 2, found \"a\""),
            (json!({ "between": ["a", 3] }), "at between[1]: expected text in quotes, found 3"),
            (json!({ "teeth": 1.5 }), "at teeth: expected a whole number, found 1.5"),
            (json!({ "teeth": 99999999999u64 }), "at teeth: 99999999999 is out of range"),
            (json!({ "axis": -9.81 }), "at axis: expected a list [...], found -9.81"),
            (
                json!({ "axis": [1, null] }),
                "at axis[1]: expected a number or an expression such as \"sqrt(2)*l\", found null",
            ),
            (
                json!({ "side": "iner" }),
                "at side: `iner` is none of the possible values\n  help: did you mean `inner`?",
            ),
            (json!({ "shape": { "ring": [1] } }), "at shape.ring: expected an object {...}, found a list of 1"),
            (json!([]), "expected an object {...}, found an empty list"),
        ];
        for (json, expected) in table {
            let error = parse_among::<Gear>(json, &["name"]).map(|_| ()).unwrap_err();
            assert_eq!(error.to_string(), expected);
        }
    }
}
