//! What a method promises of a motion of a quarter of a second, with speeds of some metres a second.

use crate::invariants::methods::Tried;

/// Largest errors of coordinates and velocities against the reference, and of the energy balance over the kinetic energy.
/// Ten times what the worst of some twenty mechanisms showed: a method that lost an order, or an invariant, is far off.
pub fn accuracy(tried: &Tried) -> [f64; 2] {
    match (tried.entry.name, tried.method.formulation.name.as_str()) {
        // Second order in steps of 0.5 ms; and its error in a fast swing.
        ("heun" | "generalized_alpha" | "ali3p" | "rattle", _) => [0.3, 5e-3],
        // The constraints are soft: errors of 1/penalty.
        (_, "penalty" | "augmented_lagrangian") => [2e-2, 2e-3],
        ("tr_bdf2" | "esdirk34" | "bdf", _) => [5e-2, 1e-3],
        ("hem3", _) => [5e-3, 2e-4],
        ("rk4" | "hem4" | "hem5", _) => [5e-5, 1e-6],
        // Errors of 1e-7 a step, that a hundred steps add up and fast swings enlarge.
        _ => [1e-2, 1e-4],
    }
}

/// Largest drift of positions and velocities over the scene's scale.
pub fn drift(tried: &Tried) -> [f64; 2] {
    let [motion, _] = accuracy(tried);
    match (tried.method.projection.name.as_str(), tried.method.formulation.name.as_str()) {
        // Round-off.
        ("exact", _) | (_, "null_space") => [1e-11, 1e-10],
        // One or two of Newton's steps from what a step has left.
        ("full", _) => [1e-9, 1e-8],
        ("manifold", _) => [1e-9, motion.min(1e-3)],
        ("position", _) => [1e-9, motion],
        ("velocity", _) => [motion, motion.min(2e-4)],
        // What is solved for, to the tolerance of Newton's method.
        (_, "index3") => [1e-6, motion],
        (_, "ggl" | "index2") => [1e-4, motion.min(1e-3)],
        _ => [motion, motion],
    }
}

/// Whether a refusal is one that the documentation knows.
pub fn is_known(reason: &str) -> bool {
    [
        "cannot integrate coordinates whose rates are not the velocities",
        "ggl cannot solve redundant constraints with this",
    ]
    .iter()
    .any(|known| reason.contains(known))
}
