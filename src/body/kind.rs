//! Kinds of elements as scenes name them.

use crate::error::Error;
use schemars::{JsonSchema, Schema, SchemaGenerator};

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

/// Error for an element that the code of its type has made wrongly: it has `what`.
pub(crate) fn mistaken(what: String) -> Error {
    Error::input(format!("its type makes an element that has {what}"))
        .under("type")
        .hint("this is a mistake in the code of the type, not in the scene")
}
