//! Keys of elements, taken from their JSON, and errors of what is missing or wrong in them.

use super::names::check_name;
use crate::body::{ElementKind, Initial, parse, show};
use crate::error::{Error, Result, suggest};
use serde_json::{Map, Value};

/// Removes `initial` and `markers`, which all bodies share, and parses them.
pub fn start_and_markers(json: &mut Map<String, Value>) -> Result<(Initial, Map<String, Value>)> {
    let initial = json
        .remove("initial")
        .map_or_else(|| Ok(Initial::default()), |initial| parse(initial).map_err(|error| error.under("initial")))?;
    let markers = json
        .remove("markers")
        .map_or_else(|| Ok(Map::new()), |given| object(given).map_err(|error| error.under("markers")))?;
    Ok((initial, markers))
}

pub fn object(json: Value) -> Result<Map<String, Value>> {
    match json {
        Value::Object(map) => Ok(map),
        other => Err(Error::input(format!("expected an object {{...}}, found {}", show(&other)))),
    }
}

fn take_text(json: &mut Map<String, Value>, key: &str) -> Result<String> {
    match json.remove(key) {
        Some(Value::String(text)) => Ok(text),
        Some(other) => Err(Error::input(format!("expected text in quotes, found {}", show(&other))).under(key)),
        None => Err(missing(key, &format!("give a \"{key}\""))),
    }
}

/// Removes `type` and finds the kind of that name.
pub fn take_kind<'k, Make>(
    json: &mut Map<String, Value>,
    what: &str,
    known: &'k [ElementKind<Make>],
) -> Result<&'k ElementKind<Make>> {
    let names = || known.iter().map(|kind| kind.name);
    if !json.contains_key("type") {
        return Err(missing("type", &format!("give the {what} a type: {}", names().collect::<Vec<_>>().join(", "))));
    }
    let name = take_text(json, "type")?;
    known.iter().find(|kind| kind.name == name).ok_or_else(|| {
        Error::input(format!("there is no {what} of type `{name}`")).under("type").hint(suggest(&name, names()))
    })
}

pub fn take_name(json: &mut Map<String, Value>) -> Result<String> {
    let name = take_text(json, "name")?;
    check_name(&name).map_err(|error| error.under("name"))?;
    Ok(name)
}

/// The name is that of another element of its kind.
pub fn taken(name: &str, what: &str) -> Error {
    Error::input(format!("the name `{name}` is taken")).under("name").hint(format!("give each {what} its own"))
}

pub fn missing(key: &str, hint: &str) -> Error {
    Error::input(format!("the key `{key}` is missing")).hint(hint)
}

pub fn wrong_component(found: &str, known: &[&str]) -> Error {
    Error::input(format!("there is no component `{found}`"))
        .under("component")
        .hint(format!("choose one of {}", known.join(", ")))
}

/// Index of a component among the `known` ones.
pub fn named_component(name: &str, known: &[&str]) -> Result<usize> {
    known.iter().position(|known| *known == name).ok_or_else(|| wrong_component(name, known))
}

pub fn find<'a>(what: &str, name: &str, known: impl Iterator<Item = &'a str> + Clone) -> Result<usize> {
    crate::error::find(what, name, known).map_err(|error| error.under("of"))
}
