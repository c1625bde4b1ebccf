//! Derivatives of outputs and of the forces of inputs against differences.

#[path = "../scenes/differences.rs"]
mod differences;
#[path = "../scenes/examples.rs"]
mod examples;
#[path = "../scenes/mod.rs"]
mod scenes;

mod compare;
mod equations;
mod inputs;
mod measures;
mod shipped;
mod special;
mod units;
