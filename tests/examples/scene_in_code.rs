//! A scene built in code: a slider crank, simulated.

use holonom::parts::{Elements, SceneBuilder, json};
use holonom::prelude::*;

#[test]
fn a_slider_crank() -> Result<()> {
    let rod = |length: &str, start: [f64; 2], angle: f64| {
        json!({ "mass": 1, "inertia": format!("{length}^2/12"),
            "markers": { "A": [format!("-{length}/2"), 0], "B": [format!("{length}/2"), 0] },
            "initial": { "position": start, "angle": angle, "angular_velocity": 5 } })
    };
    let scene = SceneBuilder::new("slider_crank", 2)
        .with("gravity", [0.0, -9.81])
        .parameter("r", 0.2)
        .parameter("l", "3*r")
        .ground_marker("O", [0.0, 0.0])
        .body("crank", "rigid", rod("r", [0.1, 0.0], 0.0))
        .body("rod", "rigid", rod("l", [0.5, 0.0], 0.0))
        .body("piston", "point_mass", json!({ "mass": 0.5, "initial": { "position": [0.8, 0] } }))
        .joint("O", "revolute", json!({ "between": ["ground.O", "crank.A"] }))
        .joint("B", "revolute", json!({ "between": ["crank.B", "rod.A"] }))
        .joint("C", "revolute", json!({ "between": ["rod.B", "piston"] }))
        .joint("guide", "point_on_line", json!({ "between": ["ground.O", "piston"] }))
        .with("assembly", json!({ "hold": ["crank.angle"] }))
        .output("x", "position", json!({ "of": "piston" }))
        .output("angle", "angle", json!({ "of": "crank" }))
        .simulation("t_end", 1.0)
        .build(&Elements::default())?;

    let model = Model::new(scene, &Default::default())?;
    let mut run = model.run();
    run.to(1.0)?;
    let x = run.record().output("x")?;
    let angle = run.record().output("angle")?;
    for (x, angle) in x.iter().zip(angle.iter()) {
        let (sin, cos) = angle.sin_cos();
        // Projected positions are on the constraints to round-off.
        assert!((x - (0.2 * cos + (0.36 - 0.04 * sin * sin).sqrt())).abs() < 1e-14, "{x} at {angle}");
    }
    Ok(())
}
