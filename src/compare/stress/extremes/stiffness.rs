//! Soft and stiff springs.

use super::super::extreme::{Extreme, decades};
use super::super::json::{elements, has, replace};
use crate::error::{Error, Result};
use serde_json::Value;
use std::sync::Arc;

pub const EXTREME: Extreme = Extreme {
    name: "stiffness",
    unit: "N/m",
    about: "stiffness of all springs (N/m, N m/rad), bushings and tyres",
    keeps_motion: false,
    suits: |subject| has(&subject.base.scene, "forces", &["stiffness"]),
    values: |_| decades(-2, 12, 2),
    apply: |case, value| set(Arc::make_mut(&mut case.scene), "stiffness", value),
};

/// Gives every force that has this coefficient the same.
pub(super) fn set(scene: &mut Value, key: &str, value: f64) -> Result<()> {
    let mut found = false;
    for coefficient in elements(scene, "forces").filter_map(|force| force.get_mut(key)) {
        replace(coefficient, value);
        found = true;
    }
    if found { Ok(()) } else { Err(Error::input(format!("no force of the scene has a {key} to change"))) }
}
