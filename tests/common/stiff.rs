//! A stiff motion.

/// A slow mass on a soft spring carries a light one on a spring that is 1e8 times as stiff, which swings at 3e5 rad/s, or
/// creeps where there is damping.
pub const STIFF: &str = r#"{
    "name": "stiff", "dimension": 2, "parameters": { "k": 1, "stiff": 1e8, "damping": 0 },
    "ground": { "markers": { "O": [0, 0] } },
    "bodies": [
        { "name": "slow", "type": "point_mass", "mass": 1, "initial": { "position": [1.5, 0] } },
        { "name": "fast", "type": "point_mass", "mass": 1e-3, "initial": { "position": [2.5, 0] } }
    ],
    "joints": [
        { "name": "rail", "type": "equation", "expression": "slow.y" },
        { "name": "other", "type": "equation", "expression": "fast.y" }
    ],
    "forces": [
        { "name": "soft", "type": "spring_damper", "between": ["ground.O", "slow"], "stiffness": "k", "free_length": 1 },
        { "name": "hard", "type": "spring_damper", "between": ["slow", "fast"], "stiffness": "stiff", "damping": "damping",
          "free_length": 1 }
    ],
    "outputs": [{ "name": "x", "measure": "position", "of": "slow" }],
    "simulation": { "t_end": 10 }
}"#;

/// Where the slow mass is at 10 s: that of 1.001 kg on the soft spring.
pub fn slow_position() -> f64 {
    1.0 + 0.5 * ((1.0 / 1.001f64).sqrt() * 10.0).cos()
}
