//! What names may be made of.

use crate::error::{Error, Result, excerpt};
use crate::math::expression::is_plain_name;

/// The name of a scene is that of its folder of results.
pub fn check_scene_name(name: &str) -> Result<()> {
    let fits = |c: char| c.is_alphanumeric() || "_-+ ()".contains(c) || c == '.';
    if !name.trim().is_empty() && !name.starts_with('.') && name.len() <= 200 && name.chars().all(fits) {
        Ok(())
    } else {
        Err(Error::input(format!("`{}` cannot name a scene", excerpt(name)))
            .under("name")
            .hint("its results go to a folder of this name: use letters, digits, `_` and `-`"))
    }
}

/// Names appear in expressions and columns: a letter, then letters, digits and underscores.
pub fn check_name(name: &str) -> Result<()> {
    if is_plain_name(name) {
        Ok(())
    } else {
        Err(Error::input(format!("`{}` cannot be a name", excerpt(name))).hint(if name.contains('{') {
            "braces need a \"repeat\" in the same element, and whole numbers from zero on in names"
        } else {
            "use a letter, then letters, digits and underscores"
        }))
    }
}
