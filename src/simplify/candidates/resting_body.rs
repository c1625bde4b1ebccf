//! A body that hardly moves.

use crate::error::percent;
use crate::simplify::edit::{carrier, drop_references, elements, find_mut, mentions, pair, remove, rename, text};
use crate::simplify::{Candidate, Facts, Proposal, Relative};
use serde_json::Value;

/// A body that hardly moves becomes a part of the ground, where it is at the start: joints between the two go.
pub struct RestingBody;

impl Candidate for RestingBody {
    fn name(&self) -> &'static str {
        "resting_body"
    }

    fn propose(&self, facts: &Facts) -> Vec<Proposal> {
        let bodies = elements(facts.scene(), "bodies").iter();
        let bodies = bodies.filter(|body| ["rigid", "point_mass"].contains(&text(body, "type")));
        let travel = facts.travel();
        bodies.filter_map(|body| proposal(facts, body, &travel)).collect()
    }
}

fn proposal(facts: &Facts, body: &Value, travel: &Relative) -> Option<Proposal> {
    let name = text(body, "name").to_string();
    let effect = facts.relative(["ground", &name])?.part(travel);
    let own = body["markers"].as_object().into_iter().flatten().map(|(marker, _)| marker.as_str());
    let mut markers = Vec::new();
    for marker in own {
        let (from, to) = (format!("{name}.{marker}"), format!("{name}_{marker}"));
        let place = facts.place(&from)?;
        markers.push((from, to, place.marker(facts.dimension())));
    }
    let frame = facts.place(&name)?.marker(facts.dimension());
    // The body's own frame comes last: its name begins those of the markers.
    markers.push((name.clone(), name.clone(), frame));
    Some(Proposal {
        subject: name.clone(),
        what: format!("{name} becomes a part of the ground"),
        why: format!("it moves by {} of what others do", percent(effect)),
        effect,
        edit: Box::new(move |scene| ground(scene, &name, &markers)),
    })
}

fn ground(scene: &mut Value, body: &str, markers: &[(String, String, Value)]) -> Result<(), String> {
    find_mut(scene, "bodies", body)?;
    remove(scene, "bodies", |element| text(element, "name") == body);
    for (from, to, place) in markers {
        scene["ground"]["markers"][to] = place.clone();
        for list in ["joints", "forces", "states", "outputs"] {
            let elements = scene.get_mut(list).and_then(Value::as_array_mut).into_iter().flatten();
            elements.for_each(|element| rename(element, from, &format!("ground.{to}")));
        }
    }
    for list in ["joints", "forces"] {
        let gone: Vec<String> = elements(scene, list).iter().filter(|element| is_still(element)).map(name_of).collect();
        remove(scene, list, |element| gone.contains(&name_of(element)));
        gone.iter().for_each(|name| drop_references(scene, name));
    }
    match elements(scene, "joints").iter().find(|joint| mentions(joint, body)) {
        Some(joint) => Err(format!("the joint `{}` is not between two markers", text(joint, "name"))),
        None => Ok(()),
    }
}

fn name_of(element: &Value) -> String {
    text(element, "name").to_string()
}

/// True if both markers are on the ground.
fn is_still(element: &Value) -> bool {
    pair(element).is_some_and(|pair| pair.iter().all(|marker| carrier(marker) == "ground"))
}
