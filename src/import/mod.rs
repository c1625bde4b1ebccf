//! Scenes from URDF, the Unified Robot Description Format (<http://wiki.ros.org/urdf/XML>), and from MJCF, the format of
//! MuJoCo (<https://mujoco.readthedocs.io/en/stable/XMLreference.html>).
//!
//! A link becomes a rigid body whose origin and axes are those of the link; what fixed joints hold together becomes one
//! body. Joints stand at the given positions, by default at those of the file. Loops are closed by [`Closure`]s.

mod close;
mod given;
pub mod mjcf;
mod names;
mod robot;
mod scene;
mod told;
mod transform;
mod tree;
pub mod urdf;
mod xml;

pub use close::Closure;
pub use given::Given;

use crate::error::{Result, excerpt};
use robot::Robot;
use serde_json::Value;

/// Choices that a file does not make.
#[derive(Clone, Debug, Default)]
pub struct Options {
    /// Link that is the ground; by default the root of the tree.
    pub base: Option<String>,
    /// True if the base moves freely.
    pub is_free: bool,
    /// Joints that close loops.
    pub closures: Vec<Closure>,
    /// Positions of joints; all others are those of the file, or follow those that they mimic.
    pub positions: Vec<Given>,
}

/// A scene with what was left out of it.
#[derive(Clone, Debug, PartialEq)]
pub struct Imported {
    /// The scene as JSON.
    pub scene: Value,
    /// What the scene does not have of the file, a sentence each.
    pub left_out: Vec<String>,
    /// What is doubtful in the file, and what the scene has in its place, a sentence each.
    pub warnings: Vec<String>,
}

/// The scene of a text in any of the formats; the root of the XML says which.
///
/// # Errors
/// As [`urdf::import`] and [`mjcf::import`].
pub fn import(text: &str, options: &Options) -> Result<Imported> {
    imported(text, &["robot", "mujoco"], options)
}

/// The scene of a text whose root is one of these.
fn imported(text: &str, roots: &[&str], options: &Options) -> Result<Imported> {
    let text = xml::without_late_declaration(text);
    let document = xml::document(&text)?;
    let root = document.root_element();
    let found = root.tag_name().name();
    match found {
        "robot" if roots.contains(&found) => of_robot(&urdf::read(root)?, options),
        "mujoco" if roots.contains(&found) => of_robot(&mjcf::read(root, options)?, options),
        _ => Err(xml::faulty(root, format!("expected a robot, found <{}>", excerpt(found)))
            .hint("a URDF file has the root <robot>, an MJCF file the root <mujoco>")),
    }
}

fn of_robot(robot: &Robot, options: &Options) -> Result<Imported> {
    let positions = given::positions(robot, &options.positions).map_err(|error| error.under("--at"))?;
    let tree = tree::Tree::of(robot, options.base.as_deref(), positions)?;
    scene::build(robot, &tree, options)
}
