//! Bodies on which nothing depends.

use crate::error::{percent, short_list};
use crate::scene::document::{elements, mentions, text};
use crate::simplify::held::remove_body;
use crate::simplify::{Candidate, Facts, Proposal};
use serde_json::Value;
use std::collections::BTreeSet;

/// The bodies that one joint, or none, connects with the ground are left out with all that acts on them, by their share
/// of the kinetic energy.
pub struct Branch;

impl Candidate for Branch {
    fn name(&self) -> &'static str {
        "branch"
    }

    fn propose(&self, facts: &Facts) -> Vec<Proposal> {
        let joints = elements(facts.scene(), "joints");
        let graph = Graph::new(facts.scene());
        let loose = graph.beyond(None);
        let by_joint = (0..joints.len()).map(|joint| &graph.beyond(Some(joint)) - &loose);
        let mut sets: Vec<BTreeSet<&str>> = graph.components(&loose).into_iter().chain(by_joint).collect();
        sets.retain(|bodies| !bodies.is_empty());
        sets.sort();
        sets.dedup();
        sets.into_iter().map(|bodies| proposal(facts, &bodies)).collect()
    }
}

/// Bodies and the joints between them.
struct Graph<'a> {
    bodies: Vec<&'a str>,
    /// Bodies of each joint, and true where the ground is one of them.
    joints: Vec<(Vec<&'a str>, bool)>,
}

impl<'a> Graph<'a> {
    fn new(scene: &'a Value) -> Self {
        let bodies: Vec<&str> = elements(scene, "bodies").iter().map(|body| text(body, "name")).collect();
        let of = |joint: &Value| {
            let own = bodies.iter().copied().filter(|body| mentions(joint, body)).collect();
            (own, mentions(joint, "ground"))
        };
        let joints = elements(scene, "joints").iter().map(of).collect();
        Graph { bodies, joints }
    }

    /// Bodies that are not connected with the ground without the joint `cut`.
    fn beyond(&self, cut: Option<usize>) -> BTreeSet<&'a str> {
        let held = self.joints.iter().enumerate().filter(|(i, (_, is_ground))| *is_ground && Some(*i) != cut);
        let reached = self.reached(held.flat_map(|(_, (bodies, _))| bodies.clone()).collect(), cut);
        self.bodies.iter().copied().filter(|body| !reached.contains(body)).collect()
    }

    /// All that joints but `cut` connect with `reached`.
    fn reached(&self, mut reached: BTreeSet<&'a str>, cut: Option<usize>) -> BTreeSet<&'a str> {
        loop {
            let before = reached.len();
            for (i, (bodies, _)) in self.joints.iter().enumerate() {
                if Some(i) != cut && bodies.iter().any(|body| reached.contains(body)) {
                    reached.extend(bodies);
                }
            }
            if reached.len() == before {
                return reached;
            }
        }
    }

    /// Sets of bodies that joints connect with each other.
    fn components(&self, bodies: &BTreeSet<&'a str>) -> Vec<BTreeSet<&'a str>> {
        bodies.iter().map(|body| self.reached(BTreeSet::from([*body]), None)).collect()
    }
}

fn proposal(facts: &Facts, bodies: &BTreeSet<&str>) -> Proposal {
    let names: Vec<String> = bodies.iter().map(|name| name.to_string()).collect();
    let effect = names.iter().map(|name| facts.kinetic_share(name)).sum();
    let list = short_list(&names);
    let verb = if names.len() == 1 { "is" } else { "are" };
    Proposal {
        subject: names.join(", "),
        what: format!("{list} {verb} left out, with all that acts there"),
        why: format!("nothing depends on that but {} of the kinetic energy", percent(effect)),
        effect,
        edit: Box::new(move |scene| names.iter().try_for_each(|name| remove_body(scene, name))),
    }
}
