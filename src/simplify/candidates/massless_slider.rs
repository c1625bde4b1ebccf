//! A slider without mass.

use crate::body::{dot, norm, sub};
use crate::simplify::edit::{add, carrier, elements, elements_mut, is_about, mentions, rename, text};
use crate::simplify::held::{Tie, acting, are_all, remove_body};
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
    let edit = Box::new(move |scene: &mut Value| slider.replace(scene));
    Some(Proposal::without_mass(facts, text(body, "name"), "becomes a point on a line without mass", edit))
}

struct Slider {
    name: String,
    /// The joint that guides it; none where one freedom does.
    guide: Option<Tie>,
    /// The joint to the body that moves it.
    pin: Tie,
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
        let pin_kind = if facts.dimension() == 2 { "revolute" } else { "spherical" };
        let (pins, guides): (Vec<_>, Vec<_>) =
            acting(scene, "joints", name).partition(|joint| text(joint, "type") == pin_kind);
        let [pin] = pins[..] else { return None };
        let pin = Tie::new(pin, name)?;
        let (guide, base, line) = match guides[..] {
            [guide] => {
                let guide =
                    Tie::new(guide, name).filter(|guide| is_guide(facts, body, guide, &pin).unwrap_or(false))?;
                let base = guide.other.clone();
                (Some(guide), base, None)
            }
            [] => {
                let (base, line) = ground_line(facts, body, &pin.own)?;
                (None, base, Some(line))
            }
            _ => return None,
        };
        let at = at(facts, body, &pin.own);
        let is_moved = |force: &Value| {
            ["applied_force", "spring_damper"].contains(&text(force, "type"))
                && text(force, "axes") != "marker"
                && is_about(force, name, &at)
        };
        let acts_at_pin = acting(scene, "forces", name).all(is_moved)
            && acting(scene, "states", name).all(|state| is_about(state, name, &at));
        let is_plain = text(body, "type") == "rigid" && carrier(&base) != carrier(&pin.other);
        let joint = point_on_line(guide.as_ref(), &base, &pin);
        let is_loaded = acting(scene, "forces", name).next().is_some();
        (acts_at_pin && is_plain).then(|| Slider { name: name.to_string(), guide, pin, at, joint, line, is_loaded })
    }

    fn joints(&self) -> impl Iterator<Item = &Tie> + Clone {
        self.guide.iter().chain([&self.pin])
    }

    fn replace(&self, scene: &mut Value) -> Result<(), String> {
        let name = &self.name;
        if !are_all(self.joints(), scene, "joints", name) {
            return Err(format!("`{name}` no longer has its joints"));
        }
        let outputs: Vec<Value> = elements(scene, "outputs").iter().filter_map(|output| self.output(output)).collect();
        for list in ["forces", "states"] {
            let all = elements_mut(scene, list).filter(|element| mentions(element, name));
            all.for_each(|element| self.to_other(element));
        }
        remove_body(scene, name)?;
        scene["outputs"] = json!(outputs);
        if let Some((marker, place)) = &self.line {
            scene["ground"]["markers"][marker] = place.clone();
        }
        add(scene, "joints", self.joint.clone());
        Ok(())
    }

    /// What is at the pin, of the body there.
    fn to_other(&self, element: &mut Value) {
        self.at.iter().for_each(|marker| rename(element, marker, &self.pin.other));
    }

    /// The output without the slider; `None` where it has none.
    fn output(&self, output: &Value) -> Option<Value> {
        let (measure, of) = (text(output, "measure"), text(output, "of"));
        let mut own = output.clone();
        if let Some(tie) = self.joints().find(|tie| tie.name() == of) {
            // What the line does to the other body it did to the slider, and that, if nothing else acts on it, to the
            // body at the pin.
            let is_pin = tie.name() == self.pin.name();
            let is_vector = ["x", "y", "z"].contains(&text(output, "component"));
            let is_known = measure == "reaction" && is_vector && output.get("on").is_none();
            own["of"] = self.joint["name"].clone();
            if is_pin == tie.is_second {
                own["on"] = json!("first");
            }
            return (is_known && !mentions(&output["relative_to"], &self.name) && !(is_pin && self.is_loaded))
                .then_some(own);
        }
        let joints = self.joints().any(|tie| mentions(output, tie.name()));
        if joints || !mentions(output, &self.name) {
            return (!joints).then_some(own);
        }
        let kinds = ["position", "velocity", "acceleration", "distance", "distance_rate", "expression"];
        let is_turned = mentions(&output["relative_to"], &self.name);
        self.to_other(&mut own);
        (kinds.contains(&measure) && !is_turned && is_about(output, &self.name, &self.at)).then_some(own)
    }
}

/// True if a joint lets the body slide along a line through the pin.
fn is_guide(facts: &Facts, body: &Value, guide: &Tie, pin: &Tie) -> Option<bool> {
    let is_slider = text(&guide.element, "type") == "prismatic" && body.get("free").is_none();
    let (base, place) = (facts.place(&guide.other)?, facts.place(&pin.own)?);
    Some(is_slider && is_on(facts, &base, &place, guide.element.get("axis")))
}

/// Markers of the body that stay at its pin.
fn at(facts: &Facts, body: &Value, pin: &str) -> Vec<String> {
    let name = text(body, "name");
    let markers = body["markers"].as_object().into_iter().flatten().map(|(marker, _)| format!("{name}.{marker}"));
    let length = SAME * facts.prepared.system().length();
    let is_there = |marker: &String| facts.lengths([pin, marker]).is_some_and(|[.., most]| most <= length);
    markers.chain([name.to_string()]).filter(is_there).collect()
}

/// The pin as a point on the line through `base`, with the axis of the guide.
fn point_on_line(guide: Option<&Tie>, base: &str, pin: &Tie) -> Value {
    let mut joint = json!({ "name": guide.unwrap_or(pin).name(), "type": "point_on_line" });
    if let Some(axis) = guide.and_then(|guide| guide.element.get("axis")) {
        joint["axis"] = axis.clone();
    }
    joint["between"] = json!([base, pin.other]);
    joint
}

/// A marker of the ground on the line along which a body may move by one freedom, at its pin.
fn ground_line(facts: &Facts, body: &Value, pin: &str) -> Option<(String, (String, Value))> {
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
    facts.place(&line).is_none().then_some((line, (name, Value::Object(marker))))
}

/// True if a place is on the line through another along its axis.
fn is_on(facts: &Facts, base: &Placed, place: &Placed, axis: Option<&Value>) -> bool {
    let own = |i: usize| match axis {
        Some(axis) => facts.number(&axis[i]).unwrap_or(0.0),
        None => f64::from(u8::from(i == if facts.dimension() == 2 { 0 } else { 2 })),
    };
    let along: [f64; 3] = from_fn(|i| (0..3).map(|k| own(k) * base.axes[k][i]).sum());
    let gap = sub(&place.r, &base.r);
    let part = dot(&along, &gap) / dot(&along, &along);
    let off: [f64; 3] = from_fn(|i| gap[i] - part * along[i]);
    norm(&off) <= SAME * facts.prepared.system().length()
}
