//! A beam whose bending the axial force does not stiffen.

use crate::error::percent;
use crate::scene::document::{elements, find_mut, text};
use crate::simplify::{Candidate, Facts, Proposal};
use serde_json::{Value, json};

/// `geometric_stiffening` of a beam is left out, by the work of its forces on the motion.
pub struct GeometricStiffening;

impl Candidate for GeometricStiffening {
    fn name(&self) -> &'static str {
        "geometric_stiffening"
    }

    fn propose(&self, facts: &Facts) -> Vec<Proposal> {
        let has = |beam: &&Value| !matches!(beam["geometric_stiffening"], Value::Null | Value::Bool(false));
        let beams = elements(facts.scene(), "bodies").iter().filter(has);
        beams.filter_map(|beam| proposal(facts, text(beam, "name").to_string())).collect()
    }
}

fn proposal(facts: &Facts, name: String) -> Option<Proposal> {
    let subject = name.clone();
    let what = format!("{name} bends without geometric stiffening");
    let edit = move |scene: &mut Value| {
        let law = find_mut(scene, "bodies", &name)?.get_mut("geometric_stiffening");
        law.map(|law| *law = json!(false)).ok_or(format!("`{name}` no longer bends"))
    };
    let mut scene = facts.scene().clone();
    edit(&mut scene).ok()?;
    let effect = facts.work_share(&scene)?;
    let why = format!("its forces do {} of the work", percent(effect));
    Some(Proposal { subject, what, why, effect, edit: Box::new(edit) })
}
