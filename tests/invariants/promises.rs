//! What a method promises of a motion of a quarter of a second, with speeds of some metres a second.

use crate::invariants::methods::Tried;

/// Whether constraints are held by springs: errors of 1/penalty.
pub fn is_soft(tried: &Tried) -> bool {
    matches!(tried.method.formulation.name.as_str(), "penalty" | "augmented_lagrangian")
}

/// Largest errors of coordinates and velocities against the reference, and of the energy balance over the kinetic energy.
/// Ten times what the worst of a dozen mechanisms showed: a method that lost an order, or an invariant, is far off.
pub fn accuracy(tried: &Tried) -> [f64; 2] {
    match tried.entry.name {
        // Second order in steps of 0.5 ms; and its error in a fast swing.
        "heun" | "ali3p" | "rattle" => [0.2, 2e-3],
        _ if is_soft(tried) => [6e-3, 8e-4],
        "hem3" => [2e-3, 4e-5],
        "rk4" | "hem4" | "hem5" => [1e-5, 1e-7],
        // Errors of 1e-7 of the motion, that fast swings enlarge.
        _ => [4e-4, 5e-6],
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
