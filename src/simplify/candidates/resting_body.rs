//! A body that hardly moves.

use super::absorbed::{Absorbed, absorb, markers};
use crate::error::percent;
use crate::scene::document::{elements, find_mut, is_rigid, remove, text};
use crate::simplify::held::acting;
use crate::simplify::{Candidate, Facts, Proposal, Relative};
use serde_json::Value;

/// A body that hardly moves becomes a part of the ground, where it is at the start: joints between the two go.
pub struct RestingBody;

impl Candidate for RestingBody {
    fn name(&self) -> &'static str {
        "resting_body"
    }

    fn propose(&self, facts: &Facts) -> Vec<Proposal> {
        let bodies = elements(facts.scene(), "bodies").iter().filter(|body| is_rigid(body));
        let travel = facts.travel();
        bodies.filter_map(|body| proposal(facts, body, &travel)).collect()
    }
}

fn proposal(facts: &Facts, body: &Value, travel: &Relative) -> Option<Proposal> {
    let name = text(body, "name").to_string();
    let effect = facts.relative("ground", &name)?.part(travel);
    let markers = markers(body, |marker| Some(facts.place(marker)?.marker(facts.dimension())))?;
    Some(Proposal {
        subject: name.clone(),
        what: format!("{name} becomes a part of the ground"),
        why: format!("it moves by {} of what others do", percent(effect)),
        effect,
        edit: Box::new(move |scene| ground(scene, &name, &markers)),
    })
}

fn ground(scene: &mut Value, body: &str, markers: &[Absorbed]) -> Result<(), String> {
    find_mut(scene, "bodies", body)?;
    remove(scene, "bodies", |element| text(element, "name") == body);
    markers.iter().for_each(|marker| scene["ground"]["markers"][&marker.name] = marker.place.clone());
    absorb(scene, markers, "ground");
    match acting(scene, "joints", body).next() {
        Some(joint) => Err(format!("the joint `{}` is not between two markers", text(joint, "name"))),
        None => Ok(()),
    }
}
