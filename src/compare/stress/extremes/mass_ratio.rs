//! Light bodies on heavy ones, and heavy ones on light ones.

use super::super::extreme::{Extreme, decades};
use super::super::json::{elements, has, multiply};
use crate::error::{Error, Result};
use serde_json::Value;
use std::sync::Arc;

/// Mass and inertia of the last body of the list that has a mass, which in chains is the end.
pub const EXTREME: Extreme = Extreme {
    name: "mass_ratio",
    unit: "",
    about: "factor on mass and inertia of the last body",
    keeps_motion: false,
    suits: |subject| has(&subject.base.scene, "bodies", &["mass"]),
    values: |_| decades(-8, 8, 2),
    apply: |case, factor| scale(Arc::make_mut(&mut case.scene), factor),
};

fn scale(scene: &mut Value, factor: f64) -> Result<()> {
    let body = elements(scene, "bodies").filter(|body| body.get("mass").is_some()).last();
    let body = body.ok_or_else(|| Error::input("no body of the scene has a mass to change"))?;
    for key in ["mass", "inertia"] {
        body.get_mut(key).into_iter().for_each(|value| multiply(value, factor));
    }
    Ok(())
}
