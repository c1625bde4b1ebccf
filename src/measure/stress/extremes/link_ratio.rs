//! Link lengths towards a singular geometry.

use super::super::extreme::{Extreme, decades};
use crate::error::{Error, Result};
use serde_json::Value;

/// A crank of r on a rod of l folds where r = l: r = (1 - gap) l.
pub const EXTREME: Extreme = Extreme {
    name: "link_ratio",
    unit: "",
    about: "gap 1 - r/l to the singular geometry of a crank r on a rod l (scenes with parameters r and l)",
    keeps_motion: false,
    suits: |subject| length(&subject.base.scene).is_ok(),
    values: |_| decades(-9, 0, 1).into_iter().map(|gap| 0.5 * gap).collect(),
    apply: |case, gap| {
        let given = case.set.iter().rev().find(|(name, _)| name == "l").map(|(_, value)| *value);
        let length = given.map_or_else(|| length(&case.scene), Ok)?;
        case.set.push(("r".to_string(), (1.0 - gap) * length));
        Ok(())
    },
};

fn length(scene: &Value) -> Result<f64> {
    let parameter = |name: &str| scene.get("parameters")?.get(name)?.as_f64();
    let (crank, rod) = (parameter("r"), parameter("l"));
    rod.filter(|_| crank.is_some()).ok_or_else(|| {
        Error::input("the scene has no parameters `r` and `l` that are numbers").hint("name a parameter as the axis")
    })
}
