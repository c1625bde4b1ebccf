//! Springs and bushings that hardly give way.

use crate::error::percent;
use crate::scene::document::{add, elements, elements_mut, find_mut, pair, remove, text};
use crate::simplify::{Candidate, Facts, Proposal, Relative};
use serde_json::{Value, json};

/// A spring whose length hardly changes becomes a `distance` of its mean length; a bushing a `weld` or, where it turns, a
/// hinge. By the change of length, or of the angle that is locked, relative to the motion of the bodies.
pub struct StiffConnection;

impl Candidate for StiffConnection {
    fn name(&self) -> &'static str {
        "stiff_connection"
    }

    fn propose(&self, facts: &Facts) -> Vec<Proposal> {
        let forces = elements(facts.scene(), "forces").iter();
        forces
            .flat_map(|force| match text(force, "type") {
                "spring_damper" => spring(facts, force).into_iter().collect(),
                "bushing" => bushing(facts, force).unwrap_or_default(),
                _ => Vec::new(),
            })
            .collect()
    }
}

fn spring(facts: &Facts, force: &Value) -> Option<Proposal> {
    let [a, b] = pair(force)?;
    let [least, mean, largest] = facts.lengths(a, b)?;
    let effect = (largest - least) / facts.travel().shift;
    let joint = json!({ "type": "distance", "length": mean });
    (least > 0.0).then(|| proposal(force, "distance", joint, "axial", effect))
}

fn bushing(facts: &Facts, force: &Value) -> Option<Vec<Proposal>> {
    let [a, b] = pair(force)?;
    let motion = facts.relative(a, b)?;
    let travel = facts.travel();
    let hinges: &[(&str, f64)] = match facts.dimension() {
        2 => &[("weld", motion.turn), ("revolute", 0.0)],
        _ => &[("weld", motion.turn), ("revolute", motion.tilt), ("spherical", 0.0)],
    };
    let joint = |(kind, turn): &(&str, f64)| {
        let effect = Relative { turn: *turn, ..motion }.part(&travel);
        proposal(force, kind, json!({ "type": kind }), "", effect)
    };
    Some(hinges.iter().map(joint).collect())
}

/// The force as a joint of this kind, whose reaction has the component `component`, or the size, for an output of the force.
fn proposal(force: &Value, kind: &str, mut joint: Value, component: &'static str, effect: f64) -> Proposal {
    let name = text(force, "name").to_string();
    joint["name"] = json!(name);
    joint["between"] = force["between"].clone();
    Proposal {
        subject: name.clone(),
        what: format!("{name} becomes a joint ({kind})"),
        why: format!("what that locks moves by {} of what the bodies do", percent(effect)),
        effect,
        edit: Box::new(move |scene| {
            find_mut(scene, "forces", &name)?;
            remove(scene, "forces", |force| text(force, "name") == name);
            let outputs = elements_mut(scene, "outputs");
            for output in outputs.filter(|output| text(output, "measure") == "force" && text(output, "of") == name) {
                output["measure"] = json!("reaction");
                if !component.is_empty() {
                    output["component"] = json!(component);
                }
            }
            add(scene, "joints", joint.clone());
            Ok(())
        }),
    }
}
