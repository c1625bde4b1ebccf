//! Joints that follow others.

use crate::error::{Error, Result, excerpt, short_list, suggest};
use crate::import::robot::{Coupling, Joint, JointType, Robot};
use crate::import::xml::{Element, all, attribute, child};
use roxmltree::Node;
use std::collections::HashMap;

/// The couplings of the joints that mimic others; what has no effect is told in `left_out`.
pub fn couplings(root: Node, robot: &Robot, left_out: &mut Vec<String>) -> Result<Vec<Coupling>> {
    let known = robot.joints.iter().enumerate().rev();
    let index: HashMap<&str, usize> = known.map(|(index, joint)| (joint.name.as_str(), index)).collect();
    let mut couplings = Vec::new();
    let mut fixed = Vec::new();
    for (own, node) in all(root, "joint").enumerate() {
        let Some(mimic) = child(node, "mimic") else { continue };
        let joint = &robot.joints[own];
        if joint.kind == JointType::Fixed {
            fixed.push(joint.name.clone());
        } else {
            let coupling = coupling(mimic, own, robot, &index);
            couplings.push(coupling.map_err(|error| robot.blame(error, &joint.name, joint.at))?);
        }
    }
    if !fixed.is_empty() {
        left_out.push(format!("mimic of the fixed joints {}", short_list(&fixed)));
    }
    let still = couplings.iter().filter(|coupling| coupling.leader.is_none());
    let still: Vec<String> = still.map(|coupling| robot.joints[coupling.follower].name.clone()).collect();
    if !still.is_empty() {
        left_out.push(format!("motion of {}: each mimics a fixed joint, so stands at its offset", short_list(&still)));
    }
    Ok(couplings)
}

/// coordinate = multiplier coordinate of the other joint + offset.
fn coupling(mimic: Node, own: usize, robot: &Robot, index: &HashMap<&str, usize>) -> Result<Coupling> {
    let name = attribute(mimic, "joint")?;
    let leader = *index.get(name).ok_or_else(|| {
        let hint = suggest(name, robot.joints.iter().map(|joint| joint.name.as_str()));
        Error::input(format!("it mimics `{}`, which is no joint", excerpt(name))).hint(hint)
    })?;
    if leader == own {
        return Err(Error::input("it mimics itself").hint("name another joint, or remove <mimic>"));
    }
    let is_fixed = robot.joints[leader].kind == JointType::Fixed;
    let ends = [&robot.joints[own], &robot.joints[leader]];
    if let Some(other) =
        ends.into_iter().find(|joint: &&Joint| !joint.has_coordinate() && joint.kind != JointType::Fixed)
    {
        let message = format!("it mimics another joint, and `{}` has no coordinate", other.name);
        return Err(Error::input(message).hint("joints that turn or slide mimic others of these"));
    }
    let follower = Element::plain(mimic);
    let coefficients = vec![follower.number_or("offset", 0.0)?, follower.number_or("multiplier", 1.0)?];
    Ok(Coupling { follower: own, leader: (!is_fixed).then_some(leader), coefficients, name: None })
}
