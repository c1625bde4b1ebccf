//! Bodies whose mass, or the inertia of whose deflection, does not matter, and scenes in which it does.

use super::{left_out, promised, scene, settings};
use serde_json::{Value, json};

fn tried<'a>(found: &'a holonom::simplify::Simplification, what: &str) -> Option<&'a holonom::simplify::Trial> {
    found.trials.iter().find(|trial| trial.what == [what])
}

/// A beam with these keys between the ground and a heavy ball, on joints. Its length is an expression, which motions
/// nearby do not move: the ball starts at a place of its own.
fn beam(more: Value, joints: Value, ball: Value) -> Value {
    let mut rod = json!({ "name": "rod", "type": "flexible_beam", "length": "L", "elements": 4,
                          "stiffness": { "EA": "EA", "EI": "EI" }, "inertia": { "rhoA": "rho" },
                          "damping": { "rayleigh": { "stiffness": 1e-3 } },
                          "markers": { "root": [0, 0], "tip": ["L", 0] } });
    rod.as_object_mut().unwrap().extend(more.as_object().unwrap().clone());
    json!({ "name": "ball", "dimension": 2, "gravity": [0, -9.81],
            "parameters": { "L": "1", "EA": 2e4, "EI": 300, "rho": 0.01, "m": 5 },
            "ground": { "markers": { "O": [0, 0] } }, "bodies": [rod, ball], "joints": joints,
            "outputs": [{ "name": "y", "measure": "position", "of": "ball", "component": "y" }],
            "simulation": { "t_end": 1, "output_step": 0.005, "formulation": "ggl", "integrator": "radau_iia",
                            "projection": "none", "rtol": 1e-7, "atol": 1e-9 } })
}

/// A ball on a cantilever bends it as a load at rest does, for what its mass is; in absolute coordinates, too.
#[test]
fn a_light_cantilever_bends_as_at_rest() {
    let joints = json!([{ "name": "wall", "type": "weld", "between": ["ground.O", "rod.root"] },
                        { "name": "end", "type": "weld", "between": ["rod.tip", "ball.C"] }]);
    let ball = json!({ "name": "ball", "type": "rigid", "mass": "m", "inertia": 0.02, "markers": { "C": [0, 0] },
                       "initial": { "position": [1, 0] } });
    let of = |frame: &str, within| {
        scene(beam(json!({ "frame": frame }), joints.clone(), ball.clone()), &settings(within, &[]))
    };
    let what = "rod deflects as at rest";
    let floating = of("floating", 0.01);
    let run =
        tried(&floating, what).and_then(|trial| trial.run.as_ref()).unwrap_or_else(|| panic!("{:?}", floating.trials));
    // 33/140 of the mass of the beam is that of the Rayleigh quotient with its static shape: exact but for the modes of
    // the beam alone.
    assert!(run.error() < 1e-3 && left_out(&floating).contains(&what), "{:?}", floating.trials);
    assert_eq!((floating.richest.velocities, run.velocities), (18, 9));
    // Large displacements of 0.1 of the length count at 0.1 %, where a floating frame is refused.
    let fine = of("absolute", 1e-3);
    let floats = ["rod bends in a floating frame", what].map(|what| tried(&fine, what).unwrap());
    assert!(floats.iter().all(|trial| !trial.is_kept), "{:?}", fine.trials);
    let coarse = of("absolute", 0.1);
    assert!(
        coarse.is_simpler() && coarse.simplified["bodies"][0]["type"] == "rigid" || left_out(&coarse).contains(&what),
        "{:?}",
        coarse.trials
    );
}

/// Between two pins it is a spring, whose tension is the axial force.
#[test]
fn a_light_beam_between_pins_is_a_spring() {
    let joints = json!([{ "name": "A", "type": "revolute", "between": ["ground.O", "rod.root"] },
                        { "name": "B", "type": "revolute", "between": ["rod.tip", "ball"] }]);
    let ball = json!({ "name": "ball", "type": "point_mass", "mass": "m", "initial": { "position": [0, -1], "velocity": [0.5, 0] } });
    let mut own = beam(
        json!({ "frame": "floating", "frame_conditions": "chord", "initial": { "angle": "-pi/2" } }),
        joints,
        ball,
    );
    own["outputs"].as_array_mut().unwrap().extend([
        json!({ "name": "tension", "measure": "axial_force", "of": "rod", "at": "L/2" }),
        json!({ "name": "x", "measure": "position", "of": "ball", "component": "x" }),
    ]);
    let found = promised(own.clone(), &settings(0.02, &[]));
    let what = "rod becomes a spring without mass";
    let run = tried(&found, what).and_then(|trial| trial.run.as_ref()).unwrap_or_else(|| panic!("{:?}", found.trials));
    // rho L over 3 m of inertia.
    assert!(run.error() < 5e-3 && (run.velocities, run.constraints) == (2, 0), "{:?}", run.outputs);
    assert_eq!(left_out(&found)[0], what);
    own["parameters"]["rho"] = json!(3);
    let heavy = scene(own, &settings(0.02, &[]));
    assert!(tried(&heavy, what).is_some_and(|trial| !trial.is_kept), "{:?}", heavy.trials);
}
