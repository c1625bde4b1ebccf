//! What holds a body.

use crate::scene::document::{carrier, elements, mentions, pair, remove_all, remove_named, text};
use serde_json::Value;

/// A joint or force between a marker of a body and one of another.
pub struct Tie {
    /// As in the scene.
    pub element: Value,
    /// Marker of the body.
    pub own: String,
    /// Marker of the other.
    pub other: String,
    /// True if the body is the second one of the element.
    pub is_second: bool,
}

impl Tie {
    /// The joint or force as one on the body; `None` where it is not between that and another.
    pub fn new(element: &Value, body: &str) -> Option<Tie> {
        let markers = pair(element)?;
        let is_second = carrier(markers[1]) == body;
        let [own, other] = if is_second { [markers[1], markers[0]] } else { markers };
        (carrier(own) == body && carrier(other) != body).then(|| Tie {
            element: element.clone(),
            own: own.to_string(),
            other: other.to_string(),
            is_second,
        })
    }

    /// Name of the joint or force.
    pub fn name(&self) -> &str {
        text(&self.element, "name")
    }
}

/// The elements of a list that act on a body.
pub fn acting<'a>(scene: &'a Value, list: &str, body: &str) -> impl Iterator<Item = &'a Value> {
    elements(scene, list).iter().filter(move |element| mentions(element, body))
}

/// Removes a body with its joints and forces, and what refers to these.
///
/// # Errors
/// It is no longer there.
pub fn remove_body(scene: &mut Value, body: &str) -> Result<(), String> {
    for list in ["joints", "forces"] {
        remove_all(scene, list, |element| mentions(element, body));
    }
    remove_named(scene, "bodies", body)
}
