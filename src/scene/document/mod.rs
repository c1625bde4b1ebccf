//! A scene as written, and changes of it before its names and expressions are resolved.

mod budget;
mod edit;
mod include;
mod refine;
mod repeat;
mod scaled;

pub use edit::{
    add, carrier, change_names, drop_references, elements, elements_mut, find, find_mut, is_rigid, mentions, number,
    object, pair, remove, remove_all, remove_named, rename, rename_in_scene, take, text, value,
};
pub use include::complete;
pub use refine::refined;
pub use scaled::{faster, has_velocities, multiply, multiply_velocities};

pub use super::json::read;
