//! A slider without mass.

use crate::error::percent;
use crate::simplify::edit::{
    carrier, drop_references, elements, find_mut, mentions, pair, remove, rename, text, words,
};
use crate::simplify::facts::product;
use crate::simplify::{Candidate, Facts, Placed, Proposal};
use crate::tolerances::SAME;
use serde_json::{Map, Value, json};
use std::array::from_fn;

/// A rigid body that a `prismatic` joint guides, or one freedom, and that one pin moves (`revolute` in the plane,
/// `spherical` in space), goes with its mass: the pin becomes a `point_on_line`, which leaves the others the same
/// freedoms, so that these move it as before. What acts on it at the pin acts on the other body there. By its share of
/// the kinetic energy.
pub struct MasslessSlider;

impl Candidate for MasslessSlider {
    fn name(&self) -> &'static str {
        "massless_slider"
    }

    fn propose(&self, facts: &Facts) -> Vec<Proposal> {
        elements(facts.scene(), "bodies").iter().filter_map(|body| proposal(facts, body)).collect()
    }
}

fn proposal(facts: &Facts, body: &Value) -> Option<Proposal> {
    let slider = Slider::new(facts, body)?;
    let effect = facts.kinetic_share(&slider.name);
    Some(Proposal {
        subject: slider.name.clone(),
        what: format!("{} becomes a point on a line without mass", slider.name),
        why: format!("it has {} of the kinetic energy", percent(effect)),
        effect,
        edit: Box::new(move |scene| slider.replace(scene)),
    })
}

struct Slider {
    name: String,
    /// Joints that go, the pin last.
    joints: Vec<Value>,
    /// True if the slider is the second body of each.
    is_second: Vec<bool>,
    /// Marker of the body that moves it.
    other: String,
    /// Names of its own markers at the pin, its frame last.
    at: Vec<String>,
    /// The joint that comes.
    joint: Value,
    /// A marker of the ground that comes with it.
    line: Option<(String, Value)>,
    /// True if forces act on it.
    is_loaded: bool,
}

impl Slider {
    fn new(facts: &Facts, body: &Value) -> Option<Slider> {
        let (scene, name) = (facts.scene(), text(body, "name"));
        let acts = |list| elements(scene, list).iter().filter(|element| mentions(element, name));
        let pin_kind = if facts.dimension() == 2 { "revolute" } else { "spherical" };
        let joints: Vec<&Value> = acts("joints").collect();
        let pin = *joints.iter().find(|joint| text(joint, "type") == pin_kind)?;
        let guides: Vec<&Value> = joints.into_iter().filter(|joint| *joint != pin).collect();
        let [own, other] = ends(pin, name)?;
        let mut joint = json!({ "name": pin["name"], "type": "point_on_line" });
        let (base, line) = match (guides[..].first(), guides.len()) {
            (Some(guide), 1) if text(guide, "type") == "prismatic" && body.get("free").is_none() => {
                joint["name"] = guide["name"].clone();
                if let Some(axis) = guide.get("axis") {
                    joint["axis"] = axis.clone();
                }
                (ends(guide, name)?[1].to_string(), None)
            }
            (None, _) => ground_line(facts, body, own)?,
            _ => return None,
        };
        joint["between"] = json!([base, other]);
        let own_place = facts.place(own)?;
        let is_on_line = line.is_some() || is_on(facts, &facts.place(&base)?, &own_place, guides[0].get("axis"))?;
        let markers = body["markers"].as_object().into_iter().flatten().map(|(marker, _)| format!("{name}.{marker}"));
        let length = SAME * facts.prepared.system().length();
        let is_there = |marker: &String| facts.lengths([own, marker]).is_some_and(|[.., most]| most <= length);
        let at: Vec<String> = markers.chain([name.to_string()]).filter(is_there).collect();
        let joints: Vec<Value> = guides.into_iter().chain([pin]).cloned().collect();
        let is_second = joints.iter().map(|joint| ends(joint, name).is_some_and(|ends| joint["between"][1] == ends[0]));
        let is_second = is_second.collect();
        let is_loaded = acts("forces").next().is_some();
        let is_moved = |force: &Value| {
            ["applied_force", "spring_damper"].contains(&text(force, "type"))
                && text(force, "axes") != "marker"
                && is_about(force, name, &at)
        };
        let acts_at_pin = acts("forces").all(is_moved) && acts("states").all(|state| is_about(state, name, &at));
        let is_plain = text(body, "type") == "rigid" && carrier(&base) != carrier(other);
        (is_on_line && acts_at_pin && is_plain).then(|| Slider {
            name: name.to_string(),
            joints,
            is_second,
            other: other.to_string(),
            at,
            joint,
            line,
            is_loaded,
        })
    }

    fn replace(&self, scene: &mut Value) -> Result<(), String> {
        let name = &self.name;
        let there = elements(scene, "joints").iter().filter(|joint| mentions(joint, name)).count();
        if there != self.joints.len() || !self.joints.iter().all(|joint| elements(scene, "joints").contains(joint)) {
            return Err(format!("`{name}` no longer has its joints"));
        }
        find_mut(scene, "bodies", name)?;
        let outputs: Vec<Value> = elements(scene, "outputs").iter().filter_map(|output| self.output(output)).collect();
        for list in ["forces", "states"] {
            let all = scene.get_mut(list).and_then(Value::as_array_mut).into_iter().flatten();
            all.filter(|element| mentions(element, name)).for_each(|element| self.to_other(element));
        }
        remove(scene, "bodies", |body| text(body, "name") == name);
        remove(scene, "joints", |joint| self.joints.contains(joint));
        self.joints.iter().for_each(|joint| drop_references(scene, text(joint, "name")));
        drop_references(scene, name);
        scene["outputs"] = json!(outputs);
        if let Some((marker, place)) = &self.line {
            scene["ground"]["markers"][marker] = place.clone();
        }
        if let Some(joints) = scene["joints"].as_array_mut() {
            joints.push(self.joint.clone());
        }
        Ok(())
    }

    /// What is at the pin, of the body there.
    fn to_other(&self, element: &mut Value) {
        self.at.iter().for_each(|marker| rename(element, marker, &self.other));
    }

    /// The output without the slider; `None` where it has none.
    fn output(&self, output: &Value) -> Option<Value> {
        let (measure, of) = (text(output, "measure"), text(output, "of"));
        let mut own = output.clone();
        if let Some(i) = self.joints.iter().position(|joint| text(joint, "name") == of) {
            // What the line does to the other body it did to the slider, and that, if nothing else acts on it, to the
            // body at the pin.
            let is_pin = i + 1 == self.joints.len();
            let is_vector = ["x", "y", "z"].contains(&text(output, "component"));
            let is_known = measure == "reaction" && is_vector && output.get("on").is_none();
            own["of"] = self.joint["name"].clone();
            if is_pin == self.is_second[i] {
                own["on"] = json!("first");
            }
            return (is_known && !mentions(&output["relative_to"], &self.name) && !(is_pin && self.is_loaded))
                .then_some(own);
        }
        let joints = self.joints.iter().any(|joint| mentions(output, text(joint, "name")));
        if joints || !mentions(output, &self.name) {
            return (!joints).then_some(own);
        }
        let kinds = ["position", "velocity", "acceleration", "distance", "distance_rate", "expression"];
        let is_turned = mentions(&output["relative_to"], &self.name);
        self.to_other(&mut own);
        (kinds.contains(&measure) && !is_turned && is_about(output, &self.name, &self.at)).then_some(own)
    }
}

/// Markers of a joint: that of the body, and that of the other one.
fn ends<'a>(joint: &'a Value, body: &str) -> Option<[&'a str; 2]> {
    let [a, b] = pair(joint)?;
    Some(if carrier(a) == body { [a, b] } else { [b, a] })
}

/// A marker of the ground on the line along which a body may move by one freedom, at its pin.
fn ground_line(facts: &Facts, body: &Value, pin: &str) -> Option<(String, Option<(String, Value)>)> {
    let free = body["free"].as_array().filter(|free| free.len() == 1)?[0].as_str()?;
    let axis = ["x", "y", "z"].iter().position(|name| *name == free)?;
    let name = format!("{}_line", text(body, "name"));
    let at = facts.place(pin)?;
    let is_origin = pin == text(body, "name");
    let position = match body["initial"].get("position").filter(|_| is_origin) {
        Some(given) => given.clone(),
        None => json!(at.r[..facts.dimension()]),
    };
    let mut marker: Map<String, Value> = Map::from_iter([("position".to_string(), position)]);
    match facts.dimension() {
        2 => marker.insert("angle".to_string(), json!(if axis == 0 { "0" } else { "pi/2" })),
        _ => marker.insert("z_axis".to_string(), json!(from_fn::<f64, 3, _>(|i| f64::from(u8::from(i == axis))))),
    };
    let line = format!("ground.{name}");
    facts.place(&line).is_none().then_some((line, Some((name, Value::Object(marker)))))
}

/// True if a place is on the line through another along its axis.
fn is_on(facts: &Facts, base: &Placed, place: &Placed, axis: Option<&Value>) -> Option<bool> {
    let own = |i: usize| match axis {
        Some(axis) => facts.number(&axis[i]).unwrap_or(0.0),
        None => f64::from(u8::from(i == if facts.dimension() == 2 { 0 } else { 2 })),
    };
    let along: [f64; 3] = from_fn(|i| (0..3).map(|k| own(k) * base.axes[k][i]).sum());
    let gap: [f64; 3] = from_fn(|i| place.r[i] - base.r[i]);
    let part = product(&along, &gap) / product(&along, &along);
    let off: [f64; 3] = from_fn(|i| gap[i] - part * along[i]);
    Some(product(&off, &off).sqrt() <= SAME * facts.prepared.system().length())
}

/// True if all that an element says of a body is about these markers of it, or their coordinates.
fn is_about(element: &Value, body: &str, markers: &[String]) -> bool {
    let is_one = |name: &str| markers.iter().any(|marker| marker == name);
    let is_coordinate = |word: &str| {
        word.rsplit_once('.').is_some_and(|(marker, name)| ["x", "y", "z"].contains(&name) && is_one(marker))
    };
    let is_known = |word: &str| carrier(word) != body || is_one(word) || is_coordinate(word);
    match element {
        Value::String(text) => words(text).all(is_known),
        Value::Array(all) => all.iter().all(|value| is_about(value, body, markers)),
        Value::Object(keys) => {
            let values = keys.iter().filter(|(key, _)| !["name", "type", "measure"].contains(&key.as_str()));
            values.map(|(_, value)| value).all(|value| is_about(value, body, markers))
        }
        _ => true,
    }
}
