//! A link between two pins, without mass.

use crate::body::{dot, norm, sub};
use crate::math::array::Each;
use crate::scene::document::{carrier, drop_references, elements, mentions, number, remove_named, take, text};
use crate::simplify::held::{Tie, acting};
use crate::simplify::{Candidate, Facts, Proposal};
use serde_json::{Value, json};

/// A rigid body that only two pins hold (`revolute` in the plane; in space `spherical`, or one of them `universal`), on
/// which nothing else acts, becomes a `distance` without mass, by its share of the kinetic energy. Reactions of its pins
/// that are watched become those of the distance.
pub struct TwoForceLink;

impl Candidate for TwoForceLink {
    fn name(&self) -> &'static str {
        "two_force_link"
    }

    fn propose(&self, facts: &Facts) -> Vec<Proposal> {
        elements(facts.scene(), "bodies").iter().filter_map(|body| proposal(facts, body)).collect()
    }
}

fn proposal(facts: &Facts, body: &Value) -> Option<Proposal> {
    let link = PinnedLink::new(facts, body)?;
    let edit = Box::new(move |scene: &mut Value| link.replace(scene));
    Some(Proposal::without_mass(facts, text(body, "name"), "becomes a distance without mass", edit))
}

/// A link with its two pins.
pub struct PinnedLink {
    name: String,
    /// Its ends.
    pub pins: [Tie; 2],
    /// Its length as an expression.
    pub length: String,
    /// Markers of the link, with the components of their axes along the line from the first pin to the second.
    axes: Vec<(String, [f64; 3])>,
}

impl PinnedLink {
    /// The rigid body as a link; `None` where it is none.
    pub fn new(facts: &Facts, body: &Value) -> Option<PinnedLink> {
        let is_free = text(body, "type") == "rigid" && body.get("free").is_none();
        is_free.then(|| PinnedLink::between_pins(facts, body)).flatten()
    }

    /// What two pins hold as a link; `None` where anything else acts on it.
    pub fn between_pins(facts: &Facts, body: &Value) -> Option<PinnedLink> {
        let scene = facts.scene();
        let name = text(body, "name");
        let joints: Vec<&Value> = acting(scene, "joints", name).collect();
        let kinds: Vec<&str> = joints.iter().map(|joint| text(joint, "type")).collect();
        let are_pins = match facts.dimension() {
            2 => kinds == ["revolute", "revolute"],
            _ => matches!(kinds[..], ["spherical", "spherical" | "universal"] | ["universal", "spherical"]),
        };
        if !are_pins || acting(scene, "forces", name).next().is_some() {
            return None;
        }
        let pins = [Tie::new(joints[0], name)?, Tie::new(joints[1], name)?];
        let [first, second] = [facts.place(&pins[0].own)?, facts.place(&pins[1].own)?];
        let gap = sub(&second.r, &first.r);
        let size = norm(&gap);
        let along = |axes: [[f64; 3]; 3]| axes.each(|axis| dot(&axis, &gap) / size);
        let markers = body["markers"].as_object()?.keys().map(|marker| format!("{name}.{marker}"));
        let axes =
            markers.map(|marker| Some((marker.clone(), along(facts.place(&marker)?.axes)))).collect::<Option<_>>()?;
        let length = length(body, [&pins[0].own, &pins[1].own])?;
        (size > 0.0 && carrier(&pins[0].other) != carrier(&pins[1].other)).then(|| PinnedLink {
            name: name.to_string(),
            pins,
            length,
            axes,
        })
    }

    /// Markers of the other bodies at its ends.
    pub fn others(&self) -> [&str; 2] {
        self.pins.each_ref().each(|pin| pin.other.as_str())
    }

    /// Puts a distance in its place.
    ///
    /// # Errors
    /// It is no longer what it was.
    pub fn replace(&self, scene: &mut Value) -> Result<(), String> {
        let [first, second] = &self.pins;
        let there = elements(scene, "joints").iter().filter(|joint| self.owns(text(joint, "name"))).count();
        if there != 2 {
            return Err(format!("`{}` no longer has its pins", self.name));
        }
        let outputs: Vec<Value> =
            elements(scene, "outputs").iter().filter_map(|output| self.translated(output)).collect();
        scene["outputs"] = json!([]);
        remove_named(scene, "bodies", &self.name)?;
        self.pins.iter().for_each(|pin| drop_references(scene, pin.name()));
        scene["outputs"] = json!(outputs);
        if let Some(joints) = scene["joints"].as_array_mut() {
            joints.retain(|joint| text(joint, "name") != second.name());
            for joint in joints.iter_mut().filter(|joint| text(joint, "name") == first.name()) {
                *joint = json!({ "name": self.name, "type": "distance", "between": self.others(),
                                 "length": self.length });
            }
        }
        Ok(())
    }

    fn owns(&self, joint: &str) -> bool {
        self.pins.iter().any(|pin| pin.name() == joint)
    }

    /// The output without the link; `None` where that has none.
    fn translated(&self, output: &Value) -> Option<Value> {
        let of = text(output, "of");
        let axes = text(output, "relative_to");
        let is_reaction = text(output, "measure") == "reaction" && self.owns(of);
        if !is_reaction {
            return (!mentions(output, &self.name)).then(|| output.clone());
        }
        let mut output = output.clone();
        output["of"] = json!(self.name);
        let Some(component) = output.get("component").and_then(Value::as_str) else { return Some(output) };
        let index = ["x", "y", "z"].iter().position(|axis| *axis == component)?;
        let is_at_second = of == self.pins[1].name();
        let pin = &self.pins[usize::from(is_at_second)];
        if carrier(axes) != self.name {
            // The reaction of the distance is on the body at the second pin: minus that on the link there, and equal to
            // that on the link at the first pin.
            return (is_at_second != pin.is_second).then_some(output);
        }
        // Tension pulls the link outwards at both pins.
        let along = self.axes.iter().find(|(marker, _)| marker == axes)?.1[index];
        let sign = if is_at_second == pin.is_second { along } else { -along };
        output["component"] = json!("axial");
        take(&mut output, "relative_to");
        ((sign - 1.0).abs() < ALIGNED).then_some(output)
    }
}

/// Cosine to 1 of the angle between the line of the link and the axis of a force along it.
const ALIGNED: f64 = crate::tolerances::SAME;

/// Distance of two markers of a body as an expression in the numbers of the scene.
fn length(body: &Value, markers: [&str; 2]) -> Option<String> {
    let position = |marker: &str| -> Option<&Vec<Value>> {
        let given = &body["markers"][marker.split_once('.')?.1];
        given.as_array().or_else(|| given["position"].as_array())
    };
    let [a, b] = [position(markers[0])?, position(markers[1])?];
    let squares = a.iter().zip(b).map(|(a, b)| format!("({} - ({}))^2", number(b), number(a)));
    Some(format!("sqrt({})", squares.collect::<Vec<_>>().join(" + ")))
}
