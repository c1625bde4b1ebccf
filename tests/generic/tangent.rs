//! K, C, the derivatives of the constraints and those of outputs, at random states.

use super::{planar, spatial, with_generic_bodies, with_generic_joints};
use holonom::joint::{ClosedForm, Joint};
use holonom::scene::{Connection, Model};
use holonom::system::{MechanicalSystem, Mechanism, Need, OperatingPoint, OutputTangent, Scratch, Tangent, Terms};
use serde_json::{Value, json};

/// Sums of a few products of numbers up to 10.
const ROUND_OFF: f64 = 1e-13;

fn numbers(count: usize) -> Vec<f64> {
    let mut random = fastrand::Rng::with_seed(7);
    (0..count).map(|_| 2.0 * random.f64() - 1.0).collect()
}

/// Joints of a kind between two bodies and between each of three and the ground.
fn scene(dimension: usize, kinds: &[(&str, Value)]) -> Value {
    let at = |x: &[f64]| json!(x[..dimension]);
    let inertia = if dimension == 2 { json!(0.3) } else { json!([0.3, 0.4, 0.5, 0.02, 0.01, 0.03]) };
    let body = |name: &str, free: Value| {
        let p = at(&[0.3, -0.4, 0.7]);
        let r = at(&[-0.2, 0.5, 0.1]);
        let mut body = json!({ "name": name, "type": "rigid", "mass": 1.2, "inertia": inertia,
            "origin": at(&[0.1, 0.2, -0.3]), "markers": { "P": p, "R": r } });
        if !free.is_null() {
            body["free"] = free;
        }
        body
    };
    let guided = if dimension == 2 { json!(["x", "angle"]) } else { json!(["x", "z", "ry"]) };
    let ends = [["a.P", "b.R"], ["ground.G", "a.R"], ["b.P", "ground.G"], ["c.P", "a.P"], ["b.R", "c.R"]];
    let mut joints = Vec::new();
    for (kind, keys) in kinds {
        for (i, between) in ends.iter().enumerate() {
            let mut joint = json!({ "name": format!("{kind}{}", joints.len() + i), "type": kind, "between": between });
            keys.as_object().into_iter().flatten().for_each(|(key, value)| joint[key] = value.clone());
            joints.push(joint);
        }
    }
    json!({ "name": "random", "dimension": dimension, "gravity": vec![0.0; dimension],
        "ground": { "markers": { "G": at(&[0.4, 0.1, -0.2]) } }, "joints": joints,
        "bodies": [body("a", Value::Null), body("b", Value::Null), body("c", guided),
            { "name": "d", "type": "point_mass", "mass": 1.0 }] })
}

fn agree(one: &[f64], other: &[f64], what: &str) {
    assert_eq!(one.len(), other.len());
    assert!(one.iter().any(|x| x.abs() > 0.01), "{what}: only zeros agree");
    for (i, (x, y)) in one.iter().zip(other).enumerate() {
        assert!((x - y).abs() <= ROUND_OFF * (10.0 + x.abs()), "{what}, value {i}: {x} and {y}");
    }
}

/// Values of K or C, with zeros at the places that it does not have.
fn dense(mechanism: &dyn MechanicalSystem, values: &[f64]) -> Vec<f64> {
    let n = mechanism.dimensions().v;
    let mut all = vec![0.0; n * n];
    let places = &mechanism.structure().tangent.entries;
    places.iter().zip(values).for_each(|(&(i, j), value)| all[i * n + j] += value);
    all
}

/// K, d(phi')/dq and d(phi'')/dq.
fn of_joints<const D: usize>(model: Model<D>) -> [Vec<f64>; 3] {
    let mechanism = Mechanism::new(model);
    let mut scratch = Scratch::default();
    let n = mechanism.dimensions();
    let all = numbers(n.q + 2 * n.v + n.lambda);
    let [q, v] = [&all[..n.q], &all[n.q..][..n.v]];
    let (vdot, lambda) = all[n.q + n.v..].split_at(n.v);
    let at = OperatingPoint { t: 0.0, q, v, vdot, lambda };
    let mut tangent = Tangent::new(&mechanism.structure().tangent);
    assert!(mechanism.tangent(at, &mut tangent, &mut scratch));
    let mut terms = Terms::new(&mechanism);
    mechanism.evaluate(0.0, q, v, Need::L, &mut terms, &mut scratch);
    let mut gdd = terms.l.clone();
    assert!(mechanism.acceleration_gradient(at, &mut gdd, &mut scratch));
    [dense(&mechanism, &tangent.k), terms.l, gdd]
}

/// Compares joints between bodies, both with their closed forms, with generic ones: between the same bodies, and between
/// generic ones.
fn locked_joints<const D: usize>(model: impl Fn() -> Model<D>) {
    let is_lock =
        |joint: &Connection<Box<dyn Joint<D>>>| matches!(joint.element.closed_form(), Some(ClosedForm::Lock(_)));
    assert!(model().joints.iter().all(is_lock));
    let closed = of_joints(model());
    for generic in [with_generic_joints(model()), with_generic_bodies(with_generic_joints(model()))] {
        for ((closed, generic), what) in closed.iter().zip(&of_joints(generic)).zip(["K", "d(phi')/dq", "d(phi'')/dq"])
        {
            agree(closed, generic, what);
        }
    }
}

/// The scene without joints, with forces at all of its bodies, and with the motion of all of them as outputs.
fn loaded(dimension: usize) -> Value {
    let mut scene = scene(dimension, &[]);
    let at = |x: &[f64]| json!(x[..dimension]);
    let coefficients = |x: f64| (1..=3 * (dimension - 1)).map(|i| x + 0.3 * i as f64).collect::<Vec<f64>>();
    let spring = |name: &str, between: [&str; 2]| {
        json!({ "name": name, "type": "spring_damper", "between": between, "stiffness": 3, "damping": 0.2,
            "free_length": 0.1 })
    };
    let twist = match dimension {
        2 => json!({ "name": "twist", "type": "applied_torque", "at": "a.R", "torque": 0.9, "reaction_on": "b.P" }),
        _ => {
            json!({ "name": "twist", "type": "applied_torque", "at": "a.R", "torque": [0.1, 0.2, 0.3], "axes": "marker",
            "reaction_on": "b.P" })
        }
    };
    scene["gravity"] = at(&[0.3, -2.0, 1.0]);
    scene["forces"] = json!([
        spring("one", ["a.P", "b.R"]), spring("two", ["c.R", "ground.G"]), spring("three", ["d", "c.P"]), twist,
        { "name": "push", "type": "applied_force", "at": "b.P", "force": at(&[1.3, -0.7, 0.4]), "axes": "marker",
            "reaction_on": "c.R" },
        { "name": "pull", "type": "applied_force", "at": "d", "force": at(&[-0.2, 0.6, 0.9]), "reaction_on": "a.P" },
        { "name": "pad", "type": "bushing", "between": ["a.R", "c.P"], "stiffness": coefficients(1.0),
            "damping": coefficients(0.1) }
    ]);
    let axes = &["x", "y", "z"][..dimension];
    let mut names = Vec::new();
    for marker in ["a", "a.P", "a.R", "b", "b.P", "b.R", "c", "c.P", "c.R", "d"] {
        for rate in ["", "'", "''"] {
            names.extend(axes.iter().map(|axis| format!("{marker}.{axis}{rate}")));
        }
    }
    for body in ["a", "b", "c"] {
        match dimension {
            2 => names.extend(["", "'", "''"].map(|rate| format!("{body}.angle{rate}"))),
            _ => names.extend(["wx", "wy", "wz", "wx'", "wy'", "wz'"].map(|spin| format!("{body}.{spin}"))),
        }
    }
    let read = names.iter().map(|name| json!({ "measure": "expression", "value": name }));
    let pairs = [["b.P", "a.R"], ["c.R", "b.R"], ["d", "c.P"]];
    let measures = ["position", "velocity", "acceleration"];
    let relative = pairs.iter().flat_map(|[of, to]| {
        measures.into_iter().flat_map(move |measure| {
            let of_axis =
                move |axis: &&str| json!({ "measure": measure, "of": of, "relative_to": to, "component": axis });
            axes.iter().map(of_axis)
        })
    });
    let energies = ["kinetic", "potential"].map(|part| json!({ "measure": "energy", "component": part }));
    let outputs = read.chain(relative).chain(energies).enumerate().map(|(i, mut output)| {
        output["name"] = json!(format!("y{i}"));
        output
    });
    scene["outputs"] = outputs.collect();
    scene
}

/// K, C, and the derivatives of the outputs with respect to q, v and v'.
fn of_bodies<const D: usize>(model: Model<D>) -> [Vec<f64>; 5] {
    let mechanism = Mechanism::new(model);
    let mut scratch = Scratch::default();
    let n = mechanism.dimensions();
    let state = numbers(n.q + 2 * n.v);
    let (q, rates) = state.split_at(n.q);
    let (v, vdot) = rates.split_at(n.v);
    let at = OperatingPoint { t: 0.0, q, v, vdot, lambda: &[] };
    let mut tangent = Tangent::new(&mechanism.structure().tangent);
    assert!(mechanism.tangent(at, &mut tangent, &mut scratch));
    let mut outputs = OutputTangent::new(mechanism.facts().outputs.len(), n.v, 0, 0);
    assert!(mechanism.output_tangent(at, &mut outputs, &mut scratch));
    let [k, c] = [&tangent.k, &tangent.c].map(|values| dense(&mechanism, values));
    let [q, v, vdot] = [outputs.q, outputs.v, outputs.vdot].map(|matrix| matrix.as_slice().to_vec());
    [k, c, q, v, vdot]
}

fn rigid_bodies<const D: usize>(model: impl Fn() -> Model<D>) {
    let closed = of_bodies(model());
    let generic = of_bodies(with_generic_bodies(model()));
    for ((closed, generic), what) in closed.iter().zip(&generic).zip(["K", "C", "dy/dq", "dy/dv", "dy/dv'"]) {
        agree(closed, generic, what);
    }
}

#[test]
fn locked_joints_agree_with_their_kernel() {
    let axis = json!({ "axis": [0.3, -0.8, 0.5] });
    let turned = ["revolute", "prismatic", "cylindrical", "point_on_line"].map(|kind| (kind, axis.clone()));
    let plain = ["revolute", "prismatic", "cylindrical", "point_on_line", "universal", "spherical", "planar", "weld"];
    let in_space = plain.map(|kind| (kind, Value::Null)).into_iter().chain(turned);
    for kind in in_space {
        locked_joints(|| spatial(&scene(3, std::slice::from_ref(&kind))));
    }
    let axis = json!({ "axis": [0.6, -0.8] });
    let slides = ["prismatic", "point_on_line"].map(|kind| (kind, axis.clone()));
    let in_plane = ["revolute", "prismatic", "point_on_line", "weld"].map(|kind| (kind, Value::Null));
    for kind in in_plane.into_iter().chain(slides) {
        locked_joints(|| planar(&scene(2, std::slice::from_ref(&kind))));
    }
}

/// The places of K are those that it can have: of hinges in the plane the angles of their bodies.
#[test]
fn reactions_of_planar_hinges_change_with_angles_alone() {
    let mechanism = Mechanism::new(planar(&scene(2, &[("revolute", Value::Null)])));
    let names = mechanism.facts().names.v.clone();
    let tangent = mechanism.structure().tangent;
    assert!(!tangent.entries.is_empty());
    assert!(tangent.entries.iter().all(|&(i, j)| i == j && names[i].contains("angle")), "{:?}", tangent.entries);
}

#[test]
fn rigid_bodies_move_along_their_velocities_as_over_dual_numbers() {
    rigid_bodies(|| planar(&loaded(2)));
    rigid_bodies(|| spatial(&loaded(3)));
}
