//! Models in MJCF, the format of MuJoCo.
//!
//! Bodies become links, and a body without joints is held to its parent. Equalities, which are soft there, are exact
//! constraints here. Motors become inputs.

mod actuator;
mod bodies;
mod classes;
mod equality;
mod geom;
mod inertia;
mod joint;
mod place;
mod settings;

pub use super::{Closure, Given, Imported, Options};

use super::robot::{Link, Robot};
use super::told::Told;
use super::transform::Transform;
use super::xml::{all, faulty, unused};
use crate::error::{Error, Result, short_list};
use classes::Classes;
use roxmltree::Node;
use settings::MjcfSettings;
use std::collections::HashMap;

/// The scene of an MJCF text.
///
/// # Errors
/// Text that is no XML or no MJCF, parts in other files, names that the file does not have; with the line and column in
/// the text.
pub fn import(text: &str, options: &Options) -> Result<Imported> {
    super::imported(text, &["mujoco"], options)
}

/// What is read so far.
struct MjcfReader<'a, 'i> {
    root: Node<'a, 'i>,
    classes: Classes<'a, 'i>,
    settings: MjcfSettings,
    robot: Robot<'i>,
    /// Indices of bodies by name.
    bodies: HashMap<String, usize>,
    /// Links and frames of sites by name.
    sites: HashMap<String, (usize, Transform)>,
    told: Told,
}

pub(super) fn read<'i>(root: Node<'_, 'i>, options: &Options) -> Result<Robot<'i>> {
    refuse(root, options)?;
    let mut told = Told::default();
    let settings = MjcfSettings::read(root, &mut told)?;
    let mut robot = Robot::new(root, "MJCF", root.attribute("model").unwrap_or("model"));
    robot.gravity = settings.gravity;
    robot.links.push(Link::new("world".to_string(), root));
    let bodies = HashMap::new();
    let sites = HashMap::new();
    let mut reader = MjcfReader { root, classes: Classes::read(root), settings, robot, bodies, sites, told };
    reader.worldbody()?;
    reader.scale_masses();
    let joints = reader.robot.joints.iter().enumerate();
    let joints: HashMap<String, usize> = joints.map(|(index, joint)| (joint.name.clone(), index)).collect();
    reader.equalities(&joints)?;
    reader.actuators(&joints)?;
    let MjcfReader { mut robot, told, .. } = reader;
    let elements = unused(root, &["compiler", "option", "worldbody", "default", "equality", "actuator"]);
    robot.left_out.extend((!elements.is_empty()).then(|| format!("elements {}", short_list(&elements))));
    robot.left_out.extend(told.sentences());
    Ok(robot)
}

/// Refuses options that the format answers itself, and parts in other files.
fn refuse(root: Node, options: &Options) -> Result<()> {
    if options.base.is_some() || options.is_free {
        let option = if options.is_free { "--free" } else { "--base" };
        return Err(Error::input("an MJCF file says itself what is free").under(option).hint("remove the option"));
    }
    match root.descendants().find(|node| node.has_tag_name("include")) {
        None => Ok(()),
        Some(node) => {
            let file = node.attribute("file").unwrap_or_default();
            Err(faulty(node, format!("a part of the model is in `{file}`"))
                .hint("import that file, or put its elements in the place of <include>"))
        }
    }
}

/// The elements in the sections of this tag, with their names, or their tags with a number.
fn named<'a, 'i>(root: Node<'a, 'i>, section: &'static str) -> impl Iterator<Item = (Node<'a, 'i>, String)> {
    let nodes = all(root, section).flat_map(|section| section.children()).filter(Node::is_element);
    nodes.enumerate().map(|(number, node)| {
        let unnamed = || format!("{}_{}", node.tag_name().name(), number + 1);
        (node, node.attribute("name").map_or_else(unnamed, str::to_string))
    })
}
