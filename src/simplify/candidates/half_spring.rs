//! A spring between the two halves of a symmetric mechanism.

use super::mirror::Mirror;
use super::planar_output::made_of;
use crate::simplify::edit::{pair, text};
use serde_json::{Map, Value, json};

/// A spring between a point and its mirror image. Its length is twice the distance s of the point from the plane, so that
///
/// ```text
/// k (l - l_0) + c l' = 2 k (s - l_0/2) + 2 c s'
/// ```
///
/// which a bushing across the plane, from where s = l_0/2, does to the point, with half the energy and power.
pub struct HalfSpring {
    /// Name of the spring.
    pub name: String,
    /// The point that stays.
    marker: String,
}

impl HalfSpring {
    /// The spring as one between a point and its image; `None` where it is none, and where its law is another.
    pub fn new(mirror: &Mirror, force: &Value) -> Option<HalfSpring> {
        let is_other = ["law", "preload"].iter().any(|key| force.get(key).is_some());
        if text(force, "type") != "spring_damper" || is_other {
            return None;
        }
        Some(HalfSpring { name: text(force, "name").to_string(), marker: stays(mirror, pair(force)?)? })
    }

    /// The bushing, and the marker of the ground from which it acts.
    pub fn bushing(&self, mirror: &Mirror, force: &Value) -> Option<(Value, (String, Value))> {
        let HalfSpring { name, marker } = self;
        let (axis, dimension) = (mirror.axis, mirror.facts.dimension());
        let times = |factor: f64, key: &str| match &force[key] {
            Value::Null => "0".to_string(),
            Value::String(text) => format!("{factor}*({text})"),
            number => format!("{factor}*{number}"),
        };
        let along = |key: &str| {
            let mut all = vec![json!(0); if dimension == 2 { 3 } else { 6 }];
            all[axis] = json!(times(2.0, key));
            all
        };
        let mut rest = vec![json!(0); dimension];
        rest[axis] = json!(format!("{} + {}", mirror.offset, times(0.5 * side(mirror), "free_length")));
        let own = format!("{name}_rest");
        let is_free = mirror.place(&format!("ground.{own}")).is_none();
        let between = [format!("ground.{own}"), marker.clone()];
        let bushing = json!({ "name": name, "type": "bushing", "between": between, "stiffness": along("stiffness"),
                              "damping": along("damping") });
        is_free.then_some((bushing, (own, json!(rest))))
    }

    /// An output of the spring, as one of the half.
    pub fn output(&self, mirror: &Mirror, output: &Value) -> Option<Vec<Value>> {
        match (text(output, "measure"), text(output, "component")) {
            ("power" | "work", _) => made_of(output, &[(2.0, None)], 0.0),
            // What acts on the point, where tension pulls it to the plane.
            ("force", "" | "axial") => {
                let keys = output
                    .as_object()?
                    .iter()
                    .filter(|(key, _)| !["component", "on", "relative_to"].contains(&key.as_str()));
                let own: Map<String, Value> = keys.map(|(key, value)| (key.clone(), value.clone())).collect();
                made_of(&json!(own), &[(-side(mirror), Some(["x", "y", "z"][mirror.axis]))], 0.0)
            }
            _ => gap(mirror, output, &self.marker),
        }
    }
}

/// A distance between a point and its mirror image, or its rate: twice what the point has from the plane, as long as it
/// does not come to the other side.
pub fn gap(mirror: &Mirror, output: &Value, marker: &str) -> Option<Vec<Value>> {
    let (measure, offset) = match text(output, "measure") {
        "distance" => ("position", -2.0 * side(mirror) * mirror.offset),
        "distance_rate" => ("velocity", 0.0),
        _ => return None,
    };
    let mut own = json!({ "name": output["name"], "measure": measure, "of": marker });
    if let Some(unit) = output.get("unit") {
        own["unit"] = unit.clone();
    }
    made_of(&own, &[(2.0 * side(mirror), Some(["x", "y", "z"][mirror.axis]))], offset)
}

/// The one of two points that stays, if they are images of each other on bodies that are.
pub fn stays(mirror: &Mirror, [a, b]: [&str; 2]) -> Option<String> {
    let stays = if mirror.goes(a) { b } else { a };
    let is_across = mirror.goes(a) != mirror.goes(b) && mirror.are_images(a, b);
    is_across.then(|| stays.to_string())
}

/// -1 where the lower half stays, 1 where the upper.
fn side(mirror: &Mirror) -> f64 {
    if mirror.upper_goes { -1.0 } else { 1.0 }
}
