//! Joints that lock what others lock already.

use crate::scene::document::find_mut;
use crate::simplify::candidate::removal;
use crate::simplify::{Candidate, Edit, Facts, Proposal};
use crate::system::Group;
use serde_json::{Value, json};

/// A joint with redundant rows is left out where all are redundant; a `revolute` becomes a joint with so many
/// rows less. The motion stays the same, reactions do not.
pub struct RedundantJoint;

impl Candidate for RedundantJoint {
    fn name(&self) -> &'static str {
        "redundant_joint"
    }

    fn propose(&self, facts: &Facts) -> Vec<Proposal> {
        let groups = facts.prepared.system().facts().groups();
        groups.iter().filter_map(|group| proposal(facts, group)).collect()
    }
}

fn proposal(facts: &Facts, group: &Group) -> Option<Proposal> {
    let Group { name, kind, rows } = group;
    let redundant: Vec<usize> =
        facts.redundant.iter().filter(|row| rows.contains(row)).map(|row| row - rows.start).collect();
    let (what, edit) = match (redundant.len(), kind.as_str(), facts.dimension()) {
        (0, ..) => return None,
        (all, ..) if all == rows.len() => (format!("the joint {name} is left out"), removal("joints", name)),
        (_, "revolute", 2) => replaced(name, "point_on_line", Some([1 - redundant[0], redundant[0]])),
        (3, "revolute", _) => replaced(name, "point_on_line", None),
        (2, "revolute", _) => replaced(name, "spherical", None),
        (1, "revolute", _) => replaced(name, "cylindrical", None),
        _ => return None,
    };
    let why = format!("{} of its {} rows follow from other joints", redundant.len(), rows.len());
    Some(Proposal { subject: name.clone(), what, why, effect: 0.0, edit })
}

/// The joint as another kind, free along `axis` if that is given.
fn replaced(name: &str, kind: &'static str, axis: Option<[usize; 2]>) -> (String, Edit) {
    let what = format!("{name} becomes a joint ({kind}) with fewer rows");
    let name = name.to_string();
    let edit = move |scene: &mut Value| {
        let joint = find_mut(scene, "joints", &name)?;
        joint["type"] = json!(kind);
        if let Some(axis) = axis {
            joint["axis"] = json!(axis);
        }
        Ok(())
    };
    (what, Box::new(edit))
}
