//! Link lengths towards a singular geometry.

use super::super::extreme::{Extreme, decades};
use crate::error::{Error, Result};
use serde_json::Value;

/// A crank of r whose slider runs on a line at the offset folds with its rod of l where r + offset = l:
/// r = (1 - gap) l - offset.
pub const EXTREME: Extreme = Extreme {
    name: "link_ratio",
    unit: "",
    about: "gap 1 - (r + offset)/l to the singular geometry of a planar crank r on a rod l (scenes with parameters r and l)",
    keeps_motion: false,
    suits: |subject| lengths(&subject.base.scene).is_ok(),
    values: |_| decades(-9, 0, 1).into_iter().map(|gap| 0.5 * gap).collect(),
    apply: |case, gap| {
        let given = |name: &str| case.set.iter().rev().find(|(known, _)| known == name).map(|(_, value)| *value);
        let [length, offset] = lengths(&case.scene)?;
        let [length, offset] = [given("l").unwrap_or(length), given("offset").unwrap_or(offset)];
        case.set.push(("r".to_string(), (1.0 - gap) * length - offset));
        Ok(())
    },
};

/// Of the rod, and the offset.
fn lengths(scene: &Value) -> Result<[f64; 2]> {
    let parameter = |name: &str| scene.get("parameters")?.get(name)?.as_f64();
    let is_planar = scene.get("dimension").and_then(Value::as_i64) == Some(2);
    let rod = parameter("l").filter(|_| is_planar && parameter("r").is_some());
    rod.map(|length| [length, parameter("offset").unwrap_or(0.0)]).ok_or_else(|| {
        Error::input("the scene is no planar one with parameters `r` and `l` that are numbers")
            .hint("name a parameter as the axis")
    })
}
