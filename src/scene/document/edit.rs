//! Elements of a scene, and the names by which they refer to each other.

use crate::math::expression::{Number, Parameters, with_names, words};
use serde::Deserialize;
use serde_json::{Map, Value, json};
use std::convert::Infallible;

/// The elements of a list of the scene, such as `bodies`; none where it is missing.
pub fn elements<'a>(scene: &'a Value, list: &str) -> &'a [Value] {
    scene[list].as_array().map_or(&[], Vec::as_slice)
}

/// The elements of a list of the scene, to change them.
pub fn elements_mut<'a>(scene: &'a mut Value, list: &str) -> impl Iterator<Item = &'a mut Value> {
    scene.get_mut(list).and_then(Value::as_array_mut).into_iter().flatten()
}

/// Text at a key of an element; empty where there is none.
pub fn text<'a>(element: &'a Value, key: &str) -> &'a str {
    element[key].as_str().unwrap_or("")
}

/// The element of this name in a list of the scene.
pub fn find<'a>(scene: &'a Value, list: &str, name: &str) -> Option<&'a Value> {
    elements(scene, list).iter().find(|element| text(element, "name") == name)
}

/// A number or expression as text.
pub fn number(value: &Value) -> String {
    value.as_str().map_or_else(|| value.to_string(), str::to_string)
}

/// The object at these keys, one in the other, made where it is missing; `None` if another type of value is there, which
/// the checks then refuse.
pub fn object<'a>(map: &'a mut Map<String, Value>, keys: &[&str]) -> Option<&'a mut Map<String, Value>> {
    keys.iter().try_fold(map, |map, key| map.entry(*key).or_insert_with(|| json!({})).as_object_mut())
}

/// Value of a number or expression over parameters.
pub fn value(number: &Value, parameters: &Parameters) -> Option<f64> {
    Number::deserialize(number).ok()?.evaluate(parameters).ok()
}

/// Takes a key of an object away.
pub fn take(object: &mut Value, key: &str) -> Option<Value> {
    object.as_object_mut()?.shift_remove(key)
}

/// The element of this name in a list of the scene, to change it.
///
/// # Errors
/// There is none, as after an earlier change.
pub fn find_mut<'a>(scene: &'a mut Value, list: &str, name: &str) -> Result<&'a mut Value, String> {
    let found = elements_mut(scene, list).find(|element| text(element, "name") == name);
    found.ok_or_else(|| format!("`{name}` is no longer there"))
}

pub fn add(scene: &mut Value, list: &str, element: Value) {
    match scene[list].as_array_mut() {
        Some(all) => all.push(element),
        None => scene[list] = json!([element]),
    }
}

/// Removes the elements of a list for which `is_gone` is true.
pub fn remove(scene: &mut Value, list: &str, is_gone: impl Fn(&Value) -> bool) {
    if let Some(all) = scene.get_mut(list).and_then(Value::as_array_mut) {
        all.retain(|element| !is_gone(element));
    }
}

/// Removes the elements of a list for which `is_gone` is true, with what refers to them.
pub fn remove_all(scene: &mut Value, list: &str, is_gone: impl Fn(&Value) -> bool) {
    let gone = elements(scene, list).iter().filter(|element| is_gone(element));
    let names: Vec<String> = gone.map(|element| text(element, "name").to_string()).collect();
    remove(scene, list, is_gone);
    names.iter().for_each(|name| drop_references(scene, name));
}

/// Removes the element of this name, with what refers to it.
///
/// # Errors
/// There is none, as after an earlier change.
pub fn remove_named(scene: &mut Value, list: &str, name: &str) -> Result<(), String> {
    find_mut(scene, list, name)?;
    remove_all(scene, list, |element| text(element, "name") == name);
    Ok(())
}

/// Removes outputs, inputs and entries of `hold` and `initial` that refer to an element that is gone.
pub fn drop_references(scene: &mut Value, name: &str) {
    remove(scene, "outputs", |output| mentions(output, name));
    remove(scene, "inputs", |input| text(input, "force") == name);
    let hold = scene.get_mut("assembly").and_then(|assembly| assembly.get_mut("hold"));
    if let Some(names) = hold.and_then(Value::as_array_mut) {
        names.retain(|held| !mentions(held, name));
    }
    if let Some(starts) = scene.get_mut("initial").and_then(Value::as_object_mut) {
        starts.retain(|coordinate, _| carrier(coordinate) != name);
    }
}

/// The two markers of a joint or force, if it has two.
pub fn pair(element: &Value) -> Option<[&str; 2]> {
    let between = element["between"].as_array().filter(|between| between.len() == 2)?;
    Some([between[0].as_str()?, between[1].as_str()?])
}

/// True if a body is where its frame is: no other place strains it.
pub fn is_rigid(body: &Value) -> bool {
    ["rigid", "point_mass"].contains(&text(body, "type"))
}

/// Name of the body that carries a marker, or of the element that has a coordinate.
pub fn carrier(name: &str) -> &str {
    name.split(['.', '\'']).next().unwrap_or(name)
}

/// Keys whose text refers to nothing: what an element is, words of the format, and files.
const ASIDE: [&str; 12] = [
    "name",
    "file",
    "type",
    "measure",
    "component",
    "coordinate",
    "unit",
    "free",
    "frame",
    "columns",
    "interpolation",
    "beyond",
];

/// True if a text of `value` refers to the element `name`, or to a marker or coordinate of it.
pub fn mentions(value: &Value, name: &str) -> bool {
    match value {
        Value::String(text) => words(text).any(|(word, _)| carrier(word) == name),
        Value::Array(all) => all.iter().any(|value| mentions(value, name)),
        Value::Object(keys) => keys.iter().any(|(key, value)| !ASIDE.contains(&key.as_str()) && mentions(value, name)),
        _ => false,
    }
}

/// Replaces the marker or body `from` by `to` in what is on bodies, and what is measured there.
pub fn rename_in_scene(scene: &mut Value, from: &str, to: &str) {
    for list in ["joints", "forces", "states", "outputs"] {
        elements_mut(scene, list).for_each(|element| rename(element, from, to));
    }
}

/// Replaces the marker or body `from`, also where a quantity of it follows, by `to` in all texts of `value`.
pub fn rename(value: &mut Value, from: &str, to: &str) {
    change_names(value, &mut |word, _| match word.strip_prefix(from) {
        Some(tail) if tail.is_empty() || tail.starts_with(['.', '\'']) => Some(format!("{to}{tail}")),
        _ => None,
    });
}

/// Changes names in the texts of `value`; `change` is given each with its primes and what follows it, and returns `None`
/// where it stays.
pub fn change_names(value: &mut Value, change: &mut impl FnMut(&str, &str) -> Option<String>) {
    match value {
        Value::String(text) => *text = changed(text, change),
        Value::Array(all) => all.iter_mut().for_each(|value| change_names(value, change)),
        Value::Object(keys) => {
            let others = keys.iter_mut().filter(|(key, _)| !ASIDE.contains(&key.as_str()));
            others.for_each(|(_, value)| change_names(value, change));
        }
        _ => {}
    }
}

/// As [`change_names`] for one text.
pub fn changed(text: &str, change: &mut impl FnMut(&str, &str) -> Option<String>) -> String {
    let Ok(text) = with_names(text, |word, after| Ok::<_, Infallible>(change(word, after)));
    text
}

#[cfg(test)]
mod tests {
    use super::*;
    use serde_json::json;

    #[test]
    fn names_are_told_from_parts_of_names() {
        let force = json!({ "name": "rod", "type": "rod", "value": "2*rod1.A.x' + sin(arm.rod)" });
        assert!(mentions(&force, "rod1") && mentions(&force, "arm") && !mentions(&force, "rod"));
    }

    #[test]
    fn markers_are_renamed_with_their_quantities() {
        let mut output = json!({ "name": "rod.A", "value": "rod.A.x - rod.AB.x + rod.angle" });
        rename(&mut output, "rod.A", "ground.rod_A");
        assert_eq!(output, json!({ "name": "rod.A", "value": "ground.rod_A.x - rod.AB.x + rod.angle" }));
        rename(&mut output, "rod", "ground");
        assert_eq!(output["value"], "ground.rod_A.x - ground.AB.x + ground.angle");
    }
}
