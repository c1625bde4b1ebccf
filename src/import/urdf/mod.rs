//! Scenes from URDF, the Unified Robot Description Format (<http://wiki.ros.org/urdf/XML>).
//!
//! A link becomes a rigid body whose origin and axes are those of the link; what fixed joints hold together becomes one
//! body. Joints stand at the given positions, by default at zero. Loops, which URDF cannot describe, are closed by [`Closure`]s.

mod close;
mod given;
mod names;
mod read;
mod scene;
mod transform;
mod tree;

pub use close::Closure;
pub use given::Given;

use crate::error::Result;
use serde_json::Value;

/// Choices that a URDF file does not make.
#[derive(Clone, Debug, Default)]
pub struct Options {
    /// Link that is the ground; by default the root of the tree.
    pub base: Option<String>,
    /// True if the base moves freely.
    pub is_free: bool,
    /// Joints that close loops.
    pub closures: Vec<Closure>,
    /// Positions of joints; all others are zero, or follow those that they mimic.
    pub positions: Vec<Given>,
}

/// A scene with what was left out of it.
#[derive(Clone, Debug, PartialEq)]
pub struct Imported {
    /// The scene as JSON.
    pub scene: Value,
    /// What the scene does not have of the file, a sentence each.
    pub left_out: Vec<String>,
}

/// The scene of a URDF text.
///
/// # Errors
/// Text that is no XML or no URDF, joints that make no tree, names in `options` that the file does not have; with the
/// line and column in the text.
pub fn import(text: &str, options: &Options) -> Result<Imported> {
    let robot = read::robot(text)?;
    let positions = given::positions(&robot, &options.positions).map_err(|error| error.under("--at"))?;
    let tree = tree::Tree::of(&robot, options.base.as_deref(), positions)?;
    scene::build(&robot, &tree, options)
}
