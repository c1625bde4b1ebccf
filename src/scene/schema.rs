//! The JSON Schema of the format, generated from the types and the registries.

use super::elements::Elements;
use super::format::{BodyPlace, ForcePlace, JointPlace, SceneFile};
use super::measures::MeasureKind;
use super::units::{Dimension, spellings};
use crate::body::ElementKind;
use schemars::generate::SchemaSettings;
use schemars::{JsonSchema, Schema, SchemaGenerator};
use serde_json::{Value, json};

impl Elements {
    /// The JSON Schema of scenes of these elements, for editors.
    pub fn schema(&self) -> Value {
        let mut generator = SchemaSettings::draft2020_12().into_generator();
        let bodies = one_of::<BodyPlace, _>(&self.spatial.bodies, &mut generator);
        let joints = one_of::<JointPlace, _>(&self.spatial.joints, &mut generator);
        let forces = one_of::<ForcePlace, _>(&self.spatial.forces, &mut generator);
        let mut root = generator.into_root_schema_for::<SceneFile>().to_value();
        for (key, items) in [("bodies", bodies), ("joints", joints), ("forces", forces)] {
            root["properties"][key]["items"] = items;
        }
        root["$defs"]["OutputSpec"]["allOf"] = units_of_measures(&root["$defs"]["MeasureKind"]);
        root
    }
}

/// For the measures of each dimension its units.
fn units_of_measures(kinds: &Value) -> Value {
    let kinds: Vec<MeasureKind> = kinds["oneOf"]
        .as_array()
        .into_iter()
        .flatten()
        .filter_map(|kind| serde_json::from_value(kind["const"].clone()).ok())
        .collect();
    let mut groups: Vec<(&[Dimension], Vec<MeasureKind>)> = Vec::new();
    for kind in kinds.into_iter().filter(|kind| !kind.dimensions().is_empty()) {
        match groups.iter_mut().find(|(known, _)| *known == kind.dimensions()) {
            Some((_, kinds)) => kinds.push(kind),
            None => groups.push((kind.dimensions(), vec![kind])),
        }
    }
    let rules = groups.into_iter().map(|(dimensions, kinds)| {
        let units: Vec<&str> = dimensions.iter().flat_map(|dimension| dimension.units()).collect();
        // An editor offers the names themselves first.
        let others = units.iter().flat_map(|name| spellings(name).into_iter().skip(1));
        let all: Vec<Value> = units.iter().map(|name| json!(name)).chain(others.map(Value::from)).collect();
        json!({ "if": { "properties": { "measure": { "enum": kinds } } },
                "then": { "properties": { "unit": { "enum": all } } } })
    });
    rules.collect()
}

/// The definition that a reference points to.
fn resolved(schema: Schema, generator: &SchemaGenerator) -> Value {
    let schema = schema.to_value();
    let name = schema.get("$ref").and_then(Value::as_str).and_then(|path| path.rsplit('/').next());
    match name.and_then(|name| generator.definitions().get(name)) {
        Some(definition) => definition.clone(),
        None => schema,
    }
}

/// One alternative for each kind: the shared keys with `type` fixed, and the kind's own keys.
fn one_of<Place: JsonSchema, Make>(kinds: &[ElementKind<Make>], generator: &mut SchemaGenerator) -> Value {
    let own = |ElementKind { name, schema, .. }: &ElementKind<Make>| (*name, resolved(schema(generator), generator));
    let kinds: Vec<_> = kinds.iter().map(own).collect();
    let place = generator.subschema_for::<Place>();
    let place = resolved(place, generator);
    let alternatives = kinds.into_iter().map(|(name, mut kind)| {
        for (key, value) in place["properties"].as_object().into_iter().flatten() {
            kind["properties"][key] = value.clone();
        }
        kind["properties"]["type"] = json!({ "const": name });
        let own = kind["required"].as_array().cloned().unwrap_or_default();
        let required: Vec<Value> = [json!("name"), json!("type")].into_iter().chain(own).collect();
        kind["required"] = Value::Array(required);
        kind
    });
    json!({ "oneOf": alternatives.collect::<Vec<_>>() })
}
