//! A body that becomes a part of another one, or of the ground.

use crate::scene::document::{carrier, pair, remove_all, rename_in_scene, text};
use serde_json::Value;

/// A marker of the body.
pub struct Absorbed {
    /// Its name in the scene.
    pub from: String,
    /// Its name on the other body.
    pub name: String,
    /// Its place there.
    pub place: Value,
}

/// The markers of a body at their places on another one, its own frame last: its name begins those of the others.
pub fn markers(body: &Value, place: impl Fn(&str) -> Option<Value>) -> Option<Vec<Absorbed>> {
    let own = text(body, "name");
    let markers = body["markers"].as_object().into_iter().flatten();
    let names = markers.map(|(marker, _)| (format!("{own}.{marker}"), format!("{own}_{marker}")));
    let all = names.chain([(own.to_string(), own.to_string())]);
    all.map(|(from, name)| Some(Absorbed { place: place(&from)?, from, name })).collect()
}

/// Makes all that acts at the markers act on the other body; joints and forces within that go.
pub fn absorb(scene: &mut Value, markers: &[Absorbed], other: &str) {
    for Absorbed { from, name, .. } in markers {
        rename_in_scene(scene, from, &format!("{other}.{name}"));
    }
    for list in ["joints", "forces"] {
        remove_all(scene, list, |element| {
            pair(element).is_some_and(|pair| pair.iter().all(|marker| carrier(marker) == other))
        });
    }
}
