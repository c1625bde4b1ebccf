//! Bodies whose mass, or the inertia of whose deflection, does not matter, and scenes in which it does.

use super::{left_out, promised, scene, settings};
use crate::scenes::model;
use serde_json::{Value, json};

fn tried<'a>(found: &'a holonom::simplify::Simplification, what: &str) -> Option<&'a holonom::simplify::Trial> {
    found.trials.iter().find(|trial| trial.what == [what])
}

/// A block on two springs in line with an eye of mass `m` between them, where both pull the same.
fn coupled(m: f64) -> Value {
    let spring = |name: &str, ends: [&str; 2], k: f64, c: f64| json!({ "name": name, "type": "spring_damper", "between": ends, "stiffness": k, "damping": c, "free_length": 0.4 });
    let body = |name: &str, mass: Value, x: f64| {
        json!({ "name": name, "type": "rigid", "mass": mass, "inertia": 0.01, "markers": { "a": [-0.05, 0], "b": [0.05, 0] },
                "initial": { "position": [x, 0] } })
    };
    json!({ "name": "coupled", "dimension": 2, "parameters": { "m": m, "M": 2 },
            "ground": { "markers": { "O": [0, 0] } },
            "bodies": [body("eye", json!("m"), 0.5125), body("block", json!("M"), 1.2)],
            "forces": [spring("one", ["ground.O", "eye.a"], 300.0, 0.4), spring("two", ["block.a", "eye.b"], 100.0, 0.4)],
            "outputs": [{ "name": "x", "measure": "position", "of": "block", "component": "x" },
                        { "name": "pull", "measure": "force", "of": "two" }],
            "simulation": { "t_end": 2, "output_step": 0.01, "rtol": 1e-7, "atol": 1e-9 } })
}

/// Of 1e-4 of the mass it goes; of a tenth it does not.
#[test]
fn springs_in_line_are_one() {
    let what = "eye goes: one and two are one spring";
    let light = promised(coupled(2e-4), &settings(0.01, &[]));
    assert_eq!(left_out(&light)[0], what, "{:?}", light.trials);
    let run = tried(&light, what).unwrap().run.as_ref().unwrap();
    // The dampers in series are exact to the first order of the rate.
    assert!(run.error() > 1e-6 && run.error() < 5e-3 && run.velocities == 3, "{:?}", run.outputs);
    let heavy = scene(coupled(0.2), &settings(0.01, &[]));
    assert!(tried(&heavy, what).is_some_and(|trial| !trial.is_kept), "{:?}", heavy.trials);
    // Out of line it is no spring in line, and where another body depends on it there is none.
    let mut bent = coupled(2e-4);
    bent["ground"]["markers"]["O"] = json!([0, 0.5]);
    assert!(scene(bent, &settings(0.01, &[])).left_out().all(|trial| trial.what != [what]));
    let mut watched = coupled(2e-4);
    watched["outputs"][1] = json!({ "name": "y", "measure": "position", "of": "eye", "component": "x" });
    let refused = scene(watched, &settings(0.01, &[]));
    assert!(tried(&refused, what).unwrap().reason.contains("takes away the watched output"));
}

/// A crank that swings with a rod, and a slider of mass `m` on a guide, pushed by a force.
fn crank(m: f64, is_free: bool) -> Value {
    let bar = |name: &str, length: f64, [x, y, angle]: [f64; 3]| {
        json!({ "name": name, "type": "rigid", "mass": length, "inertia": length.powi(3) / 12.0,
                "markers": { "A": [-0.5 * length, 0], "B": [0.5 * length, 0] },
                "initial": { "position": [x, y], "angle": angle } })
    };
    let (crank, rise) = (0.5f64, 0.8f64);
    let (x, y) = (crank * rise.cos(), crank * rise.sin());
    let lean = (y / 1.2).asin();
    let mut slider = json!({ "name": "slider", "type": "rigid", "mass": "m", "inertia": 0.01, "markers": { "pin": [0, 0] },
                             "initial": { "position": [x + 1.2 * lean.cos(), 0] } });
    let pin = |name: &str, a: &str, b: &str| json!({ "name": name, "type": "revolute", "between": [a, b] });
    let mut joints =
        vec![pin("O", "ground.O", "crank.A"), pin("P", "crank.B", "rod.A"), pin("Q", "rod.B", "slider.pin")];
    match is_free {
        true => slider["free"] = json!(["x"]),
        false => joints.push(json!({ "name": "guide", "type": "prismatic", "between": ["ground.O", "slider"] })),
    }
    let reaction = if is_free { "Q" } else { "guide" };
    json!({ "name": "crank", "dimension": 2, "gravity": [0, -9.81], "parameters": { "m": m },
            "ground": { "markers": { "O": [0, 0] } },
            "bodies": [bar("crank", crank, [0.5 * x, 0.5 * y, rise]), bar("rod", 1.2, [x + 0.6 * lean.cos(), 0.5 * y, -lean]), slider],
            "joints": joints,
            "forces": [{ "name": "gas", "type": "applied_force", "at": "slider.pin", "force": ["-1 - 0.2*slider.x'", 0] }],
            "outputs": [{ "name": "x", "measure": "position", "of": "slider", "component": "x" },
                        { "name": "speed", "measure": "expression", "value": "slider.pin.x'" },
                        { "name": "turn", "measure": "angle", "of": "crank" },
                        { "name": "side", "measure": "reaction", "of": reaction, "component": "y" }],
            "simulation": { "t_end": 1, "output_step": 0.005, "rtol": 1e-8, "atol": 1e-10 } })
}

#[test]
fn a_light_slider_is_a_point_on_a_line() {
    let what = "slider becomes a point on a line without mass";
    let light = promised(crank(1e-4, false), &settings(0.01, &[]));
    let run = tried(&light, what).and_then(|trial| trial.run.as_ref()).unwrap_or_else(|| panic!("{:?}", light.trials));
    // By the mass of the slider over that of the rod, and its weight over the load of the guide.
    assert!(run.error() < 3e-3 && (run.velocities, run.constraints) == (6, 5), "{:?}", run.outputs);
    assert!(left_out(&light).contains(&what));
    // By one freedom: the force at it keeps the reaction of its pin from following from that of the line.
    let free = scene(crank(1e-4, true), &settings(0.01, &["x", "speed", "turn"]));
    let run = tried(&free, what).and_then(|trial| trial.run.as_ref()).unwrap_or_else(|| panic!("{:?}", free.trials));
    assert!(run.error() < 3e-3 && (run.velocities, run.constraints) == (6, 5), "{:?}", run.outputs);
    let loaded = scene(crank(1e-4, true), &settings(0.01, &["side"]));
    assert!(tried(&loaded, what).unwrap().reason.contains("takes away the watched output"));
    let heavy = scene(crank(0.3, false), &settings(0.01, &[]));
    assert!(tried(&heavy, what).is_some_and(|trial| !trial.is_kept), "{:?}", heavy.trials);
    // Without a force the reaction of the pin is that of the line.
    let mut idle = crank(1e-4, true);
    idle["forces"] = json!([]);
    let idle = scene(idle, &settings(0.01, &[]));
    let run = tried(&idle, what).and_then(|trial| trial.run.as_ref()).unwrap_or_else(|| panic!("{:?}", idle.trials));
    assert!(run.error() < 3e-3, "{:?}", run.outputs);
}

/// In space, with a ball in the place of the fork, reactions of the guide are those of the line.
#[test]
fn a_light_slider_in_space_is_a_point_on_a_line() {
    let text = std::fs::read_to_string(model("spatial_slider_crank")).unwrap();
    let mut own: Value = serde_json::from_str(&text).unwrap();
    own["joints"][2]["type"] = json!("spherical");
    own["simulation"]["t_end"] = json!(0.5);
    for (name, value) in [("m_slider", 5e-4), ("i_slider", 1e-8)] {
        own["parameters"][name] = json!(value);
    }
    let found = scene(own, &settings(0.01, &[]));
    let what = "slider becomes a point on a line without mass";
    let run = tried(&found, what).and_then(|trial| trial.run.as_ref()).unwrap_or_else(|| panic!("{:?}", found.trials));
    // By its weight of 5 mN, 0.25 % of what the guide bears, and 1e-3 of the mass of the rod.
    assert!(run.error() < 5e-3 && (run.velocities, run.constraints) == (12, 10), "{:?}", run.outputs);
    assert!(run.outputs.len() == 8 && left_out(&found).contains(&what));
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
