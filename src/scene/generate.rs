//! Scenes of any size, for measuring cost.

use serde_json::{Value, json};

type MakeScene = fn(usize) -> Value;

/// Every scalable scene: its name, and the scene for n loops or links.
pub fn registry() -> &'static [(&'static str, MakeScene)] {
    &[("n_four_bar", n_four_bar), ("chain", chain), ("flexible_chain", flexible_chain)]
}

/// N four-bar linkages side by side: 2N + 1 uniform links of 1 m and 1 kg, vertical ones up, v_x(B0) = 1 m/s.
/// IFToMM benchmark A02; one degree of freedom, N + 1 when flat. 6N + 3 coordinates, 6N + 2 constraints.
pub fn n_four_bar(n: usize) -> Value {
    let link = |name: String, position: [String; 2], angle: Value, markers: Value, motion: Value| {
        json!({ "name": name, "type": "rigid", "mass": "m", "inertia": "m*l^2/12", "markers": markers,
            "initial": { "position": position, "angle": angle, "velocity": motion[0], "angular_velocity": motion[1] } })
    };
    let ends = json!({ "A": ["-l/2", 0], "B": ["l/2", 0] });
    let mut bodies = Vec::new();
    let mut joints = Vec::new();
    let mut hinge = |name: String, a: String, b: String| {
        joints.push(json!({ "name": name, "type": "revolute", "between": [a, b] }));
    };
    for i in 0..=n {
        let turning = json!([["v0/2", 0], "-v0/l"]);
        let centre = [format!("{i}*l"), "l/2".to_string()];
        bodies.push(link(format!("bar{i}"), centre, json!("pi/2"), ends.clone(), turning));
        hinge(format!("A{i}"), format!("ground.A{i}"), format!("bar{i}.A"));
        if i > 0 {
            let k = i - 1;
            let sliding = json!([["v0", 0], 0]);
            let centre = [format!("{k}.5*l"), "l".to_string()];
            bodies.push(link(format!("coupler{k}"), centre, json!(0), ends.clone(), sliding));
            hinge(format!("B{k}"), format!("bar{k}.B"), format!("coupler{k}.A"));
            hinge(format!("C{i}"), format!("coupler{k}.B"), format!("bar{i}.B"));
        }
    }
    let supports: serde_json::Map<String, Value> =
        (0..=n).map(|i| (format!("A{i}"), json!([format!("{i}*l"), 0]))).collect();
    json!({
        "name": format!("n_four_bar_{n}"),
        "about": format!("{n} four-bar linkages in a row. One degree of freedom; singular when flat."),
        "references": ["IFToMM multibody benchmark A02"],
        "dimension": 2,
        "parameters": { "l": 1.0, "m": 1.0, "v0": 1.0 },
        "gravity": [0, -9.81],
        "ground": { "markers": supports },
        "bodies": bodies,
        "joints": joints,
        "outputs": [
            { "name": "B0_x", "measure": "position", "of": "bar0.B", "component": "x" },
            { "name": "B0_y", "measure": "position", "of": "bar0.B", "component": "y" }
        ],
        "simulation": { "t_end": 1.0, "output_step": 0.01, "integrator": "dop853", "rtol": 1e-9, "atol": 1e-9 }
    })
}

/// A chain of n uniform rods of total length 1 m and mass 1 kg, hanging from one end and released level.
/// 3n coordinates, 2n constraints, n degrees of freedom.
pub fn chain(n: usize) -> Value {
    let length = 1.0 / n as f64;
    let link = |i: usize| {
        json!({
            "name": format!("link{i}"), "type": "rigid", "mass": "m/n", "inertia": "m/n*(l/n)^2/12",
            "markers": { "A": ["-l/n/2", 0], "B": ["l/n/2", 0] },
            "initial": { "position": [(i as f64 + 0.5) * length, 0] }
        })
    };
    let about = format!("A chain of {n} rods, released level. {n} degrees of freedom; the motion is chaotic.");
    let parameters = json!({ "l": 1.0, "m": 1.0, "n": n });
    let simulation = json!({ "t_end": 1.0, "output_step": 0.01, "integrator": "dopri5", "rtol": 1e-8, "atol": 1e-8 });
    hanging(format!("chain_{n}"), about, n, link, parameters, simulation)
}

/// Beam elements in one link of a [`flexible_chain`].
const ELEMENTS: usize = 4;

/// A chain of n elastic beams on hinges of total length 1 m and mass 1 kg, hanging from one end and released level:
/// each four geometrically exact elements. 15n coordinates, 2n constraints.
pub fn flexible_chain(n: usize) -> Value {
    let link = |i: usize| {
        json!({
            "name": format!("link{i}"), "type": "flexible_beam", "frame": "absolute", "length": "l/n", "elements": ELEMENTS,
            "stiffness": { "EA": "EA", "EI": "EI" }, "inertia": { "rhoA": "m/l", "rhoI": "m/l*EI/EA" },
            "markers": { "A": [0, 0], "B": ["l/n", 0] },
            "initial": { "position": [format!("{i}*l/n"), 0] }
        })
    };
    let about = format!("A chain of {n} elastic beams of {ELEMENTS} elements each, released level.");
    let parameters = json!({ "l": 1.0, "m": 1.0, "n": n, "EA": 1e4, "EI": 1e-2 });
    let simulation = json!({ "t_end": 1.0, "output_step": 0.01, "formulation": "index3",
        "integrator": { "generalized_alpha": { "rho_inf": 0.7 } }, "step": 0.001 });
    hanging(format!("flexible_chain_{n}"), about, n, link, parameters, simulation)
}

/// Links on hinges in a row, from the ground on; the place of the last end is watched.
fn hanging(
    name: String,
    about: String,
    n: usize,
    link: impl Fn(usize) -> Value,
    parameters: Value,
    simulation: Value,
) -> Value {
    let joint = |i: usize| {
        let before = if i == 0 { "ground.A".to_string() } else { format!("link{}.B", i - 1) };
        json!({ "name": format!("J{i}"), "type": "revolute", "between": [before, format!("link{i}.A")] })
    };
    let end = format!("link{}.B", n - 1);
    json!({
        "name": name,
        "about": about,
        "dimension": 2,
        "parameters": parameters,
        "gravity": [0, -9.81],
        "ground": { "markers": { "A": [0, 0] } },
        "bodies": (0..n).map(link).collect::<Vec<Value>>(),
        "joints": (0..n).map(joint).collect::<Vec<Value>>(),
        "outputs": [
            { "name": "end_x", "measure": "position", "of": end, "component": "x" },
            { "name": "end_y", "measure": "position", "of": end, "component": "y" }
        ],
        "simulation": simulation
    })
}
