//! M, f, the constraints and G.

use super::{planar, spatial, with_generic_bodies, with_generic_joints};
use holonom::scene::Model;
use holonom::system::{MechanicalSystem, Mechanism, Need, Scratch, Terms};
use serde_json::{Map, Value, json};

const AXIS: [f64; 3] = [0.2, -0.5, 0.7];

/// Keys of every joint with a closed formula, beside its markers.
fn joints(dimension: usize) -> Vec<Value> {
    let mut all = vec![
        json!({ "type": "revolute" }),
        json!({ "type": "prismatic" }),
        json!({ "type": "prismatic", "axis": AXIS[..dimension] }),
        json!({ "type": "weld" }),
        json!({ "type": "point_on_line" }),
        json!({ "type": "point_on_line", "axis": AXIS[..dimension] }),
        json!({ "type": "distance", "length": 0.7 }),
    ];
    if dimension == 3 {
        all.push(json!({ "type": "revolute", "axis": AXIS }));
        for kind in ["cylindrical", "planar"] {
            all.extend([json!({ "type": kind }), json!({ "type": kind, "axis": AXIS })]);
        }
        all.extend([json!({ "type": "universal" }), json!({ "type": "spherical" })]);
    }
    all
}

/// Three bodies, free and partly free, and a point mass, with forces and a joint without a closed formula between them.
fn scene(dimension: usize, joint: &Value, between: [&str; 2]) -> Value {
    let place = |x: f64| json!([0.3 + x, -0.4 * x, 0.5 - x][..dimension]);
    let marker = |x: f64| match dimension {
        2 => json!({ "position": place(x), "angle": x }),
        _ => json!({ "position": place(x), "rotation": [x, 0.4, -0.8] }),
    };
    let body = |name: &str, x: f64, free: Option<&[&str]>| {
        let inertia = if dimension == 2 { json!(0.4) } else { json!([0.4, 0.5, 0.6, 0.02, 0.01, -0.03]) };
        let mut body = json!({ "name": name, "type": "rigid", "mass": 1.3, "inertia": inertia,
            "markers": { "p": marker(x), "r": place(-x) } });
        if let Some(free) = free {
            body["free"] = json!(free);
        }
        if free.is_some() && dimension == 3 {
            body["initial"] = json!({ "rotation": [0.3, x, -0.2] });
        }
        body
    };
    let partly: &[&str] = if dimension == 2 { &["y", "angle"] } else { &["x", "z", "ry"] };
    let torque = if dimension == 2 { json!(0.9) } else { json!([0.1, 0.2, "0.3*t"]) };
    let mut joint = joint.clone();
    (joint["name"], joint["between"]) = (json!("joint"), json!(between));
    json!({
        "name": "closed_formulas", "dimension": dimension, "gravity": place(1.0),
        "ground": { "markers": { "p": marker(0.7) } },
        "bodies": [body("A", 0.2, None), body("B", -0.6, None), body("C", 0.5, Some(partly)),
            { "name": "D", "type": "point_mass", "mass": 0.7, "markers": { "p": vec![0.0; dimension] } }],
        "joints": [joint, { "name": "drive", "type": "driver", "between": ["C.r", "A.p"], "coordinate": "y", "value": "t^2" }],
        "forces": [
            { "name": "spring", "type": "spring_damper", "between": ["C.p", "B.r"], "stiffness": 3, "damping": 0.2, "free_length": 0.1 },
            { "name": "push", "type": "applied_force", "at": "B.p", "force": place(0.3), "axes": "marker", "reaction_on": "D.p" },
            { "name": "motor", "type": "applied_torque", "at": "A.r", "torque": torque, "reaction_on": "C.r" }
        ],
        "simulation": { "t_end": 1 }
    })
}

/// Numbers in (-2, 2), the same for the same seed.
fn numbers(count: usize, seed: usize) -> Vec<f64> {
    (0..count).map(|i| 2.0 * (1.0 + 1.7 * i as f64 + 2.3 * seed as f64).sin()).collect()
}

fn terms<const D: usize>(mechanism: &Mechanism<D>, q: &[f64], v: &[f64]) -> Map<String, Value> {
    let mut terms = Terms::new(mechanism);
    for stale in [&mut terms.mass, &mut terms.f, &mut terms.phi_t, &mut terms.g] {
        stale.fill(f64::NAN);
    }
    mechanism.evaluate(0.3, q, v, Need::DYNAMICS, &mut terms, &mut Scratch::default());
    let Terms { mass, f, phi, phi_dot, phi_t, gamma, g, power, .. } = terms;
    let all = json!({ "mass": mass, "f": f, "phi": phi, "phi'": phi_dot, "phi_t": phi_t, "gamma": gamma, "G": g, "power": [power] });
    all.as_object().cloned().unwrap_or_default()
}

/// Compares both ways at some states, on the constraints and off.
fn agree<const D: usize>(model: impl Fn() -> Model<D>, case: &str) {
    let closed = Mechanism::new(model());
    assert!(closed.model().joints[0].element.closed_form().is_some(), "{case}");
    let generic = Mechanism::new(with_generic_bodies(with_generic_joints(model())));
    let n = closed.dimensions();
    for seed in 0..4 {
        let q = numbers(n.q, seed);
        let v = numbers(n.v, seed + 7);
        let found = terms(&closed, &q, &v);
        let expected = terms(&generic, &q, &v);
        // Sums of some tens of products of numbers up to the largest, each rounded.
        let largest = expected.values().flat_map(values).fold(1.0, |size: f64, x| size.max(x.abs()));
        let tolerance = 50.0 * f64::EPSILON * largest;
        for (name, expected) in &expected {
            let found = values(&found[name]);
            assert_eq!(found.len(), values(expected).len(), "{case}: {name}");
            for (i, (x, y)) in found.into_iter().zip(values(expected)).enumerate() {
                assert!((x - y).abs() <= tolerance, "{case}: {name}[{i}] is {x}, not {y}");
            }
        }
    }
}

fn values(all: &Value) -> Vec<f64> {
    all.as_array().into_iter().flatten().map(|x| x.as_f64().unwrap_or(f64::NAN)).collect()
}

#[test]
fn closed_formulas_give_what_the_kernels_give() {
    for dimension in [2, 3] {
        for joint in joints(dimension) {
            let kind = joint["type"].as_str().unwrap_or("");
            let points_only = ["distance", "spherical", "point_on_line"].contains(&kind);
            let has_rotations = !(points_only || dimension == 2 && kind == "revolute");
            let mut pairs =
                vec![["A.p", "B.p"], ["A.p", "ground.p"], ["ground.p", "B.p"], ["C.p", "A.p"], ["B.r", "C.p"]];
            if !has_rotations && joint["type"] != "point_on_line" {
                pairs.extend([["D.p", "A.p"], ["C.p", "D.p"]]);
            }
            for between in pairs {
                let scene = scene(dimension, &joint, between);
                let case = format!("{joint} between {between:?}");
                match dimension {
                    2 => agree(|| planar(&scene), &case),
                    _ => agree(|| spatial(&scene), &case),
                }
            }
        }
    }
}
