//! Flexible beams in absolute coordinates: the element, its statics against closed forms, frequencies, large motions, and
//! what is refused.

#[path = "../scenes/mod.rs"]
mod scenes;

mod element;
mod large;
mod statics;
