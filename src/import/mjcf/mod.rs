//! Models in MJCF, the format of MuJoCo.
//!
//! Bodies become links, and a body without joints is held to its parent. Equalities, which are soft there, are exact
//! constraints here. Motors become inputs.

mod actuator;
mod bodies;
mod element;
mod equality;
mod geom;
mod inertia;
mod joint;
mod place;
mod settings;
mod told;

pub use super::{Closure, Given, Imported, Options};

use super::robot::{Link, Robot};
use super::transform::Transform;
use super::xml::{faulty, unused};
use crate::error::{Error, Result, short_list};
use element::Classes;
use roxmltree::Node;
use settings::Settings;
use std::collections::HashMap;
use told::Told;

/// The scene of an MJCF text.
///
/// # Errors
/// Text that is no XML or no MJCF, parts in other files, names that the file does not have; with the line and column in
/// the text.
pub fn import(text: &str, options: &Options) -> Result<Imported> {
    super::imported(text, &["mujoco"], options)
}

/// What is read so far.
struct Reader<'a, 'i> {
    root: Node<'a, 'i>,
    classes: Classes<'a, 'i>,
    settings: Settings,
    robot: Robot<'i>,
    /// Indices of bodies by name.
    bodies: HashMap<String, usize>,
    /// Links and frames of sites by name.
    sites: HashMap<String, (usize, Transform)>,
    told: Told,
}

/// Reads a model.
pub(super) fn read<'i>(root: Node<'_, 'i>, options: &Options) -> Result<Robot<'i>> {
    refuse(root, options)?;
    let mut told = Told::default();
    let settings = Settings::read(root, &mut told)?;
    let robot = empty(root, settings.gravity);
    let bodies = HashMap::new();
    let sites = HashMap::new();
    let mut reader = Reader { root, classes: Classes::read(root), settings, robot, bodies, sites, told };
    reader.worldbody()?;
    reader.scale_masses();
    let joints = reader.robot.joints.iter().enumerate();
    let joints: HashMap<String, usize> = joints.map(|(index, joint)| (joint.name.clone(), index)).collect();
    reader.equalities(&joints)?;
    reader.actuators(&joints)?;
    let Reader { mut robot, told, .. } = reader;
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

fn empty<'i>(root: Node<'_, 'i>, gravity: [f64; 3]) -> Robot<'i> {
    let world = Link {
        name: "world".to_string(),
        at: root.range().start,
        mass: None,
        markers: Vec::new(),
        meshes: Vec::new(),
        is_between: false,
    };
    Robot {
        text: root.document().input_text(),
        format: "MJCF",
        name: root.attribute("model").unwrap_or("model").to_string(),
        gravity,
        links: vec![world],
        joints: Vec::new(),
        couplings: Vec::new(),
        loops: Vec::new(),
        motors: Vec::new(),
        left_out: Vec::new(),
    }
}
