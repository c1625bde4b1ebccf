//! Linear models against references, closed forms and each other.

mod agreement;
mod along;
mod closed_forms;
mod equilibria;
mod inputs;
mod modal;
mod models;
mod motion;
mod moving;
mod penalties;
mod reference;
mod refused;
mod scene_states;
mod shipped;
mod steps;
mod sure;
mod systems;
mod thresholds;
