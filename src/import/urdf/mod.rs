//! Robots in URDF.

mod mimic;
mod read;

pub use super::{Closure, Given, Imported, Options};

pub(super) use read::read;

use crate::error::Result;

/// The scene of a URDF text.
///
/// # Errors
/// Text that is no XML or no URDF, joints that make no tree, names in `options` that the file does not have; with the
/// line and column in the text.
pub fn import(text: &str, options: &Options) -> Result<Imported> {
    super::imported(text, &["robot"], options)
}
