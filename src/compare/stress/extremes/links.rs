//! Chains of many links.

use super::super::extreme::{Extreme, ladder};
use crate::error::{Error, Result};
use crate::scene::generate;
use serde_json::Value;
use std::sync::Arc;

/// The scene generated again with so many links or loops.
pub const EXTREME: Extreme = Extreme {
    name: "links",
    unit: "",
    about: "number of links or loops of a generated scene (n_four_bar, chain, flexible_chain)",
    keeps_motion: false,
    suits: |subject| kind(&subject.base.scene).is_ok(),
    values: |_| ladder(1.0, 200.0),
    apply: |case, n| {
        case.scene = Arc::new(kind(&case.scene)?(n.round().max(1.0) as usize));
        Ok(())
    },
};

/// What generates scenes of this name: `chain_10` is a `chain`.
fn kind(scene: &Value) -> Result<fn(usize) -> Value> {
    let name = scene.get("name").and_then(Value::as_str).unwrap_or_default();
    let kind = name.trim_end_matches(|c: char| c.is_ascii_digit()).trim_end_matches('_');
    let found = generate::registry().iter().find(|(known, _)| *known == kind);
    found.map(|(_, make)| *make).ok_or_else(|| Error::input(format!("`{name}` is no generated scene")))
}
