//! Scenes written in code.

use super::document::object;
use super::{Elements, Scene, folder};
use crate::error::Result;
use serde_json::{Map, Value, json};

/// A scene written in code: the keys of a scene file, with the same checks, and errors that name the same places.
///
/// ```
/// use holonom::parts::{Elements, SceneBuilder, json};
///
/// let scene = SceneBuilder::new("pendulum", 2)
///     .with("gravity", [0.0, -9.81])
///     .parameter("l", 0.5)
///     .ground_marker("O", [0.0, 0.0])
///     .body("bob", "point_mass", json!({ "mass": 1, "initial": { "position": ["l", 0] } }))
///     .joint("rod", "distance", json!({ "between": ["ground.O", "bob"], "length": "l" }))
///     .output("height", "position", json!({ "of": "bob", "component": "y" }))
///     .simulation("t_end", 2.0)
///     .build(&Elements::default())?;
/// assert_eq!(scene.q, [0.5, 0.0]);
/// # Ok::<(), holonom::Error>(())
/// ```
///
/// Values are those of JSON: numbers, or expressions over the parameters as text. A key that is given again replaces
/// what it was; bodies, joints, forces, inputs and outputs are added in their order.
#[derive(Clone, Debug)]
pub struct SceneBuilder {
    keys: Map<String, Value>,
}

impl SceneBuilder {
    /// An empty scene in the plane (2) or in space (3).
    pub fn new(name: &str, dimension: usize) -> Self {
        SceneBuilder { keys: Map::new() }.with("name", name).with("dimension", dimension).with("bodies", json!([]))
    }

    /// Any key of a scene, such as `gravity`.
    pub fn with(mut self, key: &str, value: impl Into<Value>) -> Self {
        self.keys.insert(key.to_string(), value.into());
        self
    }

    /// A number, or an expression over other parameters.
    pub fn parameter(self, name: &str, value: impl Into<Value>) -> Self {
        self.within(&["parameters"], name, value.into())
    }

    /// A marker of the ground: its position, or an object with an orientation.
    pub fn ground_marker(self, name: &str, marker: impl Into<Value>) -> Self {
        self.within(&["ground", "markers"], name, marker.into())
    }

    /// A body of type `kind` with its other keys, an object.
    pub fn body(self, name: &str, kind: &str, keys: Value) -> Self {
        self.element("bodies", name, Some(("type", kind)), keys)
    }

    /// A joint of type `kind` with its other keys, an object.
    pub fn joint(self, name: &str, kind: &str, keys: Value) -> Self {
        self.element("joints", name, Some(("type", kind)), keys)
    }

    /// A force of type `kind` with its other keys, an object.
    pub fn force(self, name: &str, kind: &str, keys: Value) -> Self {
        self.element("forces", name, Some(("type", kind)), keys)
    }

    /// An input with its other keys, an object.
    pub fn input(self, name: &str, keys: Value) -> Self {
        self.element("inputs", name, None, keys)
    }

    /// An output of the quantity `measure`, such as `position`, with its other keys, an object.
    pub fn output(self, name: &str, measure: &str, keys: Value) -> Self {
        self.element("outputs", name, Some(("measure", measure)), keys)
    }

    /// One setting of the simulation, such as `t_end`.
    pub fn simulation(self, key: &str, value: impl Into<Value>) -> Self {
        self.within(&["simulation"], key, value.into())
    }

    /// The scene as a file would have it.
    pub fn json(&self) -> Value {
        Value::Object(self.keys.clone())
    }

    /// The scene, resolved; files that it names are in the current folder.
    ///
    /// # Errors
    /// As [`Scene::parse`].
    pub fn build(&self, elements: &Elements) -> Result<Scene> {
        elements.resolve(folder(None), self.json(), &[])
    }

    fn within(mut self, path: &[&str], key: &str, value: Value) -> Self {
        if let Some(object) = object(&mut self.keys, path) {
            object.insert(key.to_string(), value);
        }
        self
    }

    fn element(mut self, list: &str, name: &str, kind: Option<(&str, &str)>, keys: Value) -> Self {
        let mut element = keys;
        if let Value::Object(map) = &mut element {
            map.extend([("name".to_string(), name.into())]);
            map.extend(kind.map(|(key, kind)| (key.to_string(), kind.into())));
        }
        // The checks refuse `keys` that are no object and a list that is no list.
        if let Value::Array(all) = self.keys.entry(list).or_insert_with(|| json!([])) {
            all.push(element);
        }
        self
    }
}
