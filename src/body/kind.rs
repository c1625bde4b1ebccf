//! Kinds of elements as scenes name them.

use crate::error::Error;
use schemars::{JsonSchema, Schema, SchemaGenerator};
use serde::Deserialize;

/// A kind of body, joint or force: its type name, its part of the schema, and the function that makes an element from JSON.
#[derive(Clone, Copy, Debug)]
pub struct ElementKind<Make> {
    /// Value of `type` in a scene.
    pub name: &'static str,
    /// JSON Schema of the kind's own keys.
    pub schema: fn(&mut SchemaGenerator) -> Schema,
    /// Makes the element from its JSON.
    pub build: Make,
}

impl<Make> ElementKind<Make> {
    /// The kind of this name, with the schema of `Spec`.
    pub fn of<Spec: JsonSchema>(name: &'static str, build: Make) -> Self {
        ElementKind { name, schema: |generator| generator.subschema_for::<Spec>(), build }
    }
}

/// Stands for one copy a value of a variable, such as {"i": "1..6"}: a range of whole numbers, both ends included, which
/// may be expressions over parameters; of several variables the last varies fastest. In text and names of the element
/// {EXPRESSION} is replaced by its value, as in "leg{i}" or "2*pi*{i}/6".
#[derive(Deserialize, JsonSchema)]
#[allow(dead_code, reason = "expanded before elements are read")]
pub struct Repeat(std::collections::BTreeMap<String, String>);

/// Error for an element that the code of its type has made wrongly: it has `what`.
pub(crate) fn mistaken(what: String) -> Error {
    Error::input(format!("its type makes an element that has {what}"))
        .under("type")
        .hint("this is a mistake in the code of the type, not in the scene")
}
