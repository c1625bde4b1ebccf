//! What mechanisms are made of: bodies, joints, forces, outputs, and shipped scenes.

mod absolute_beam;
mod assembly;
mod closed_forms;
mod common;
mod elements;
mod equilibrium;
mod events;
mod examples;
mod flexible;
mod floating;
mod flyball_governor;
mod language;
mod measures;
mod mechanisms;
mod modal_body;
mod models;
mod outside;
mod own_elements;
mod reactions;
mod scenes;
mod section_forces;
mod signals;
mod suspension;
mod tangent;
mod turns;
