//! Bodies in modal coordinates from the scene file to the motion: that of the beam they were exported from; what is
//! refused; where their files are looked for.

mod command;
mod export;
mod motion;
mod npz;
mod shipped;

use export::Beam;
use serde_json::{Value, json};
use std::fs;
use std::path::Path;

/// A beam that falls on a hinge, with a mass and a force at its tip.
fn swing<const D: usize>() -> Value {
    let planar = D == 2;
    let spatial = D == 3;
    let at = |x: f64| if planar { json!([x, 0]) } else { json!([x, 0, 0]) };
    let stiffness = if planar {
        json!({ "EA": 2e4, "EI": 30, "GA": 5e3 })
    } else {
        json!({ "EA": 2e4, "EI": [50, 30], "GA": [9e3, 7e3], "GJ": 2e-6 })
    };
    // As good as none: what sections turn at second order is not in the data of modal bodies.
    let inertia = if planar { json!(1e-10) } else { json!([2e-10, 1e-10]) };
    json!({
        "name": "swing", "dimension": D,
        "parameters": { "angle": 0.3 },
        "gravity": if spatial { json!([0, -9.81, 1]) } else { json!([0, -9.81]) },
        "ground": { "markers": { "O": at(0.0) } },
        "bodies": [
            { "name": "rod", "type": "flexible_beam", "frame": "floating", "length": 1.5, "elements": 6,
              "theory": "timoshenko", "modes": 2, "frame_conditions": if planar { "mean" } else { "tangent" },
              "damping": { "modal": 0.01 }, "stiffness": stiffness, "inertia": { "rhoA": 0.8, "rhoI": inertia },
              "markers": { "left": at(0.0), "tip": at(1.5) } },
            { "name": "bob", "type": "point_mass", "mass": 0.2, "initial": { "position": at(1.5) } },
        ],
        "joints": [
            { "name": "hinge", "type": "revolute", "between": ["ground.O", "rod.left"] },
            { "name": "tip", "type": if planar { "revolute" } else { "spherical" }, "between": ["rod.tip", "bob"] },
        ],
        "forces": [
            { "name": "push", "type": "applied_force", "at": "rod.tip",
              "force": if planar { json!(["2*sin(5*t)", 0]) } else { json!(["2*sin(5*t)", 0, "sin(3*t)"]) } },
        ],
        "outputs": [
            { "name": "tip_x", "measure": "position", "of": "rod.tip", "component": "x" },
            { "name": "tip_y", "measure": "position", "of": "rod.tip", "component": "y" },
            { "name": "hinge", "measure": "reaction", "of": "hinge" },
            { "name": "energy", "measure": "energy" },
        ],
        "simulation": { "t_end": 0.5, "output_step": 0.01, "integrator": "dop853", "rtol": 1e-10, "atol": 1e-10 },
    })
}

/// The scene with the beam's place taken by its modes from `file`, which is written beside it.
fn modal<const D: usize>(scene: &Value, folder: &Path, file: &str) -> Value {
    let beam = Beam::<D>::new(&scene["bodies"][0]);
    let all: Vec<usize> = (0..beam.modes()).collect();
    let data = beam.export(&all);
    if file.ends_with(".npz") {
        npz::write(&folder.join(file), &data)
    } else {
        fs::write(folder.join(file), serde_json::to_string(&data).unwrap()).unwrap()
    }
    let mut scene = scene.clone();
    let markers = scene["bodies"][0]["markers"].take();
    scene["bodies"][0] = json!({ "name": "rod", "type": "modal_body", "file": file, "markers": markers });
    scene
}

fn write(folder: &Path, scene: &Value) {
    fs::write(folder.join("scene.json"), serde_json::to_string_pretty(scene).unwrap()).unwrap();
}
