//! Linear models against references, closed forms and each other.

#[path = "../equations/mod.rs"]
#[allow(dead_code)]
mod equations;
mod modal;
mod reference;
mod systems;
