//! Linear models against references, closed forms and each other.

mod agreement;
mod closed_forms;
#[path = "../common/mod.rs"]
mod common;
mod equilibria;
mod models;
mod moving;
mod penalties;
mod random;
mod reference;
mod refused;
#[path = "../scenes/mod.rs"]
mod scenes;
mod shipped;
mod steps;
mod systems;

use common::equations;
