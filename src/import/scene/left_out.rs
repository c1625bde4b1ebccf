//! What a scene does not have of its file.

use super::Draft;
use crate::error::short_list;
use crate::import::Options;
use crate::import::robot::{Joint, JointType, Robot};
use crate::import::tree::Tree;

/// The text about the scene.
pub fn about(robot: &Robot, options: &Options) -> String {
    let meshes = robot.links.iter().filter(|link| !link.meshes.is_empty());
    let meshes: Vec<String> = meshes.map(|link| format!("{}: {}", link.name, link.meshes.join(", "))).collect();
    let told = if meshes.is_empty() { String::new() } else { format!(" Meshes, not used: {}.", meshes.join("; ")) };
    let given: Vec<String> =
        options.positions.iter().map(|given| format!("{} = {}", given.joint, given.value)).collect();
    let at = if given.is_empty() { String::new() } else { format!(" but {}", given.join(", ")) };
    let zero = if robot.format == "URDF" { "position zero" } else { "the positions of the file" };
    format!("The robot {} from its {}, joints at {zero}{at}.{told}", robot.name, robot.format)
}

/// What the scene does not have.
pub fn left_out(robot: &Robot, tree: &Tree, draft: &Draft) -> Vec<String> {
    let joints = |test: &dyn Fn(&Joint) -> bool| -> Vec<String> {
        robot.joints.iter().filter(|joint| test(joint)).map(|joint| joint.name.clone()).collect()
    };
    let is_damped = |joint: &Joint| joint.has_coordinate() || joint.kind == JointType::Spherical;
    let fixed = robot.joints.iter().filter(|joint| joint.kind == JointType::Fixed);
    let fixed: Vec<String> = fixed.map(|joint| robot.links[joint.child].name.clone()).collect();
    let mut told = [
        told(joints(&|joint| joint.damping != 0.0 && !is_damped(joint)), "damping of the joints"),
        told(joints(&|joint| joint.stiffness != 0.0 && !joint.has_coordinate()), "stiffness of the joints"),
        told(joints(&|joint| joint.armature != 0.0 && !joint.has_coordinate()), "armature of the joints"),
        told(draft.massless.clone(), "mass, which the file does not give, of the links"),
        told(fixed, "fixed joints: what they hold is one body, with markers for the links"),
        mass_of_ground(robot, tree, draft),
    ]
    .into_iter()
    .flatten()
    .collect::<Vec<String>>();
    told.extend(robot.left_out.iter().cloned());
    told
}

fn told(names: Vec<String>, text: &str) -> Option<String> {
    (!names.is_empty()).then(|| format!("{text} {}", short_list(&names)))
}

/// Names of the links with mass that do not move.
fn mass_of_ground(robot: &Robot, tree: &Tree, draft: &Draft) -> Option<String> {
    let has_mass = |link: &&usize| robot.links[**link].mass.as_ref().is_some_and(|mass| mass.mass != 0.0);
    let members = tree.members[tree.base].iter().filter(|_| !draft.is_free);
    told(
        members.filter(has_mass).map(|link| robot.links[*link].name.clone()).collect(),
        "mass of links that are the ground:",
    )
}

/// What is taken as it is, though it is doubtful.
pub fn doubts(robot: &Robot) -> Option<String> {
    let fed = robot.joints.iter().filter(|joint| joint.damping < 0.0);
    told(fed.map(|joint| joint.name.clone()).collect(), "damping below zero, which feeds energy, is kept: joints")
}
