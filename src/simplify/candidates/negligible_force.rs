//! Forces, dampers and gravity that hardly do any work.

use crate::error::percent;
use crate::scene::document::{elements, find_mut, take, text};
use crate::simplify::candidate::removal;
use crate::simplify::{Candidate, Edit, Facts, Proposal};
use serde_json::Value;

/// A force, the damping of a force or of a beam, or gravity is left out, by its work on the motion. What an input drives
/// stays.
pub struct NegligibleForce;

impl Candidate for NegligibleForce {
    fn name(&self) -> &'static str {
        "negligible_force"
    }

    fn propose(&self, facts: &Facts) -> Vec<Proposal> {
        let scene = facts.scene();
        let is_driven =
            |force: &Value| elements(scene, "inputs").iter().any(|input| text(input, "force") == text(force, "name"));
        let forces = elements(scene, "forces").iter().filter(|force| !is_driven(force));
        let left_out = forces.flat_map(|force| {
            let name = text(force, "name");
            let damper = undamped("forces", force).filter(|_| force.get("stiffness").is_some());
            [Some((name.to_string(), format!("the force {name} is left out"), removal("forces", name))), damper]
        });
        let beams = elements(scene, "bodies").iter().map(|body| undamped("bodies", body));
        let gravity = scene.get("gravity").is_some().then(gravity);
        let all = left_out.chain(beams).chain([gravity]).flatten();
        all.filter_map(|(subject, what, edit)| proposal(facts, subject, what, edit)).collect()
    }
}

fn proposal(facts: &Facts, subject: String, what: String, edit: Edit) -> Option<Proposal> {
    let mut scene = facts.scene().clone();
    edit(&mut scene).ok()?;
    // A damper of zero is no simplification, and what acts on bodies at rest is not told by its work.
    let effect = facts.work_share(&scene).filter(|share| *share > 0.0)?;
    let why = format!("its work comes to {} of the energy converted", percent(effect));
    Some(Proposal { subject, what, why, effect, edit })
}

type ProposedEdit = (String, String, Edit);

fn undamped(list: &'static str, element: &Value) -> Option<ProposedEdit> {
    element.get("damping")?;
    let name = text(element, "name").to_string();
    let subject = name.clone();
    let what = format!("{name} is not damped");
    let edit = move |scene: &mut Value| {
        take(find_mut(scene, list, &name)?, "damping").map(|_| ()).ok_or(format!("`{name}` has no damping"))
    };
    Some((subject, what, Box::new(edit)))
}

fn gravity() -> ProposedEdit {
    let edit = |scene: &mut Value| take(scene, "gravity").map(|_| ()).ok_or("no gravity".to_string());
    ("gravity".to_string(), "gravity is left out".to_string(), Box::new(edit))
}
