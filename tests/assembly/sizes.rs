//! Sizes far from a metre.

use super::{assembled, prepared};
use holonom::math::largest;
use serde_json::{Value, json};

/// Point masses on rods of this length, the first from the ground, at these angles.
fn pendulums(length: f64, angles: &[f64]) -> Value {
    let mut at = [0.0, 0.0];
    let mut bodies = Vec::new();
    let mut joints = Vec::new();
    for (i, angle) in angles.iter().enumerate() {
        at = [at[0] + length * angle.sin(), at[1] - length * angle.cos()];
        bodies.push(json!({ "name": format!("p{i}"), "type": "point_mass", "mass": 1, "initial": { "position": at } }));
        let from = if i == 0 { "ground.O".to_string() } else { format!("p{}", i - 1) };
        let between = [from, format!("p{i}")];
        joints.push(json!({ "name": format!("r{i}"), "type": "distance", "between": between, "length": length }));
    }
    json!({ "name": "pendulums", "dimension": 2, "gravity": [0, -9.81 * length],
        "ground": { "markers": { "O": [0, 0] } }, "bodies": bodies, "joints": joints,
        "simulation": { "t_end": 1, "output_step": 0.1 } })
}

/// Rods of any length close to the round-off of their coordinates, and run as those of a metre do, scaled.
#[test]
fn pendulums_of_any_length_are_the_same() {
    for length in [1e-6, 1e6, 1e9] {
        for seed in 0..12 {
            let angles = [1.0 + 0.7 * seed as f64, 0.3 * seed as f64];
            let [unit, scaled] = [1.0, length].map(|length| assembled(&pendulums(length, &angles)).unwrap());
            let off: Vec<f64> = unit.q.iter().zip(&scaled.q).map(|(unit, scaled)| scaled / length - unit).collect();
            // Some roundings of numbers of order 2.
            assert!(largest(&off) < 1e-14, "{length:e}, {seed}: {off:?}");
        }
        let chain: Vec<f64> = (0..8).map(|i| 0.2 * f64::from(i)).collect();
        assert!(assembled(&pendulums(length, &chain)).is_ok(), "{length:e}");
    }
}

#[test]
fn a_tether_in_orbit_is_assembled() {
    // Two satellites on a rod of 100.7 m, 7000 km from the centre: coordinates round by 1e-9 m.
    let satellite = |name: &str, sign: f64| {
        json!({ "name": name, "type": "point_mass", "mass": 100, "markers": { "C": [0, 0, 0] },
            "initial": { "position": [7e6 + sign * 50.35, 0, 0] } })
    };
    let scene = json!({ "name": "tether", "dimension": 3,
        "gravity": { "towards": "ground.Earth", "mu": 3.986e14 }, "ground": { "markers": { "Earth": [0, 0, 0] } },
        "bodies": [satellite("a", -1.0), satellite("b", 1.0)],
        "joints": [{ "name": "tether", "type": "distance", "between": ["a.C", "b.C"], "length": 100.7 }] });
    let prepared = prepared(&scene.to_string()).unwrap();
    assert!((prepared.system().facts().length / 100.7 - 1.0).abs() < 1e-15);
}
