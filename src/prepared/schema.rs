//! The JSON Schema of scenes with the names of all methods.

use crate::method_spec::Listed;
use crate::scene::Elements;
use crate::{formulation, integrator, projection};
use serde_json::{Map, Value, json};

/// The JSON Schema of scenes of these elements, with the formulations, integrators and projections that they may name
/// and their options.
pub fn schema(elements: &Elements) -> Value {
    let mut root = elements.schema();
    let methods = [
        ("formulation", methods::<formulation::FormulationEntry>(elements)),
        ("integrator", methods::<integrator::IntegratorEntry>(elements)),
        ("projection", methods::<projection::ProjectionEntry>(elements)),
    ];
    for (key, names) in methods {
        let place = &mut root["$defs"]["Simulation"]["properties"][key];
        let description = place["description"].take();
        *place = json!({ "description": description, "anyOf": names });
    }
    if let Some(definitions) = root["$defs"].as_object_mut() {
        definitions.shift_remove("MethodSpec");
    }
    root
}

/// A name, a name with options, or an object {name: {option: value}}; hyphens count as underscores in text.
fn methods<E: Listed>(elements: &Elements) -> Value {
    let entries: Vec<&E> = E::registry().iter().chain(elements.methods.entries()).collect();
    let names: Vec<&str> = entries.iter().map(|entry| entry.name()).collect();
    let text = names.iter().map(|name| name.replace('_', "[-_]")).collect::<Vec<_>>().join("|");
    let value = json!({ "type": ["number", "string", "boolean"] });
    let options = |entry: &E| -> Map<String, Value> {
        let option = |option: &crate::method_spec::OptionDoc| {
            (option.name.to_string(), json!({ "description": option.about, "type": value["type"] }))
        };
        entry.options().iter().map(option).collect()
    };
    let one = |entry: &&E| {
        let options = json!({ "type": "object", "additionalProperties": false, "properties": options(entry) });
        (entry.name().to_string(), options)
    };
    let objects: Map<String, Value> = entries.iter().map(one).collect();
    json!([
        { "enum": names },
        { "type": "string", "pattern": format!("^({text})(:.*)?$") },
        { "type": "object", "minProperties": 1, "maxProperties": 1, "additionalProperties": false, "properties": objects },
        { "type": "null" },
    ])
}
