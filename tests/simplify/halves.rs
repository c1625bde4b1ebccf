//! One of two symmetric halves.

use super::{found, left_out, promised, scene, settings, shipped};
use crate::scenes::model;
use holonom::prepared::Overrides;
use holonom::simplify::{Nearby, Run, Settings, Simplification, Source};
use serde_json::{Value, json};

/// The run of the half, if it was proposed.
fn half(found: &Simplification) -> Option<&Run> {
    let trial = found.trials.iter().find(|trial| trial.candidate == "symmetric_half" && trial.is_kept);
    trial.and_then(|trial| trial.run.as_ref())
}

fn gripper() -> Value {
    serde_json::from_str(&std::fs::read_to_string(model("symmetric_gripper")).unwrap()).unwrap()
}

/// Also with all numbers 10 % off, which both halves share.
#[test]
fn half_a_gripper_will_do() {
    let nearby = Some(Nearby { by: 0.1, samples: Some(20) });
    let source = Source::load(&model("symmetric_gripper"), &Overrides::default()).unwrap();
    let found = found(source, &Settings { nearby, ..settings(0.001, &[]) });
    assert_eq!(left_out(&found), ["of the two halves across y one is left"]);
    let run = half(&found).unwrap();
    // Both are integrated at rtol 1e-8, in as many steps: 18 of 32 unknowns.
    assert!(run.error() < 1e-7 && run.work < 0.6 * found.richest.work, "{:?}", run.outputs);
    assert_eq!((found.richest.velocities, found.richest.constraints), (18, 14));
    assert_eq!((run.velocities, run.constraints, run.outputs.len()), (10, 8, 8));
    let robustness = found.robustness.as_ref().unwrap();
    assert_eq!((robustness.counted, robustness.kept), (20, 20));
}

/// Bodies, springs or markers that differ by 1 %, what connects the halves, gravity across: no half is proposed. Loads
/// that differ are seen in the motion.
#[test]
fn what_is_not_symmetric_is_not_halved() {
    let none = |change: &dyn Fn(&mut Value)| {
        let mut own = gripper();
        change(&mut own);
        own["simulation"]["t_end"] = json!(0.1);
        let found = scene(own, &settings(0.001, &[]));
        let proposed = found.trials.iter().find(|trial| trial.candidate == "symmetric_half").cloned();
        assert!(half(&found).is_none(), "{proposed:?}");
        proposed
    };
    let changes: [&dyn Fn(&mut Value); 6] = [
        &|own| own["bodies"][4]["mass"] = json!("1.01*m_jaw"),
        &|own| own["forces"][3]["stiffness"][0] = json!("1.01*k_pad"),
        &|own| own["ground"]["markers"]["lower"] = json!(["1.01*hinge_x", "-hinge_y"]),
        &|own| own["gravity"] = json!([0, -9.81]),
        &|own| {
            let own = own["forces"].as_array_mut().unwrap();
            own.push(json!({ "name": "band", "type": "spring_damper", "between": ["upper_jaw.tip", "lower_jaw.tip"],
                             "law": "10*length" }));
        },
        &|own| {
            let own = own["forces"].as_array_mut().unwrap();
            own.push(json!({ "name": "wind", "type": "applied_force", "at": "upper_jaw.tip", "force": [0, "0.1*t"] }));
        },
    ];
    changes.iter().for_each(|change| assert!(none(*change).is_none(), "it is proposed"));
    let pushed = none(&|own| own["forces"][4]["force"][1] = json!("2*sin(omega*t)"));
    assert!(pushed.unwrap().estimated > 0.003);
}

/// Torsion springs wound against each other, bands named from either end, and drives that turn against each other; a
/// block on the plane that stays there by its freedom.
#[test]
fn springs_and_drives_have_images() {
    let crank = |name: &str, x: f64| {
        json!({ "name": name, "type": "rigid", "mass": 1, "inertia": 0.1, "markers": { "A": [0, 0], "B": [0, 0.5] },
                "initial": { "position": [x, 0] } })
    };
    let driver = |name: &str, value: &str| {
        json!({ "name": format!("{name}_drive"), "type": "driver", "coordinate": "angle", "value": value,
                "between": [format!("ground.{name}"), format!("{name}.A")] })
    };
    let pin = |name: &str| json!({ "name": format!("{name}_pin"), "type": "revolute", "between": [format!("ground.{name}"), format!("{name}.A")] });
    let band = |name: &str, ends: [&str; 2]| json!({ "name": name, "type": "spring_damper", "between": ends, "stiffness": 100, "damping": 1, "free_length": 0.8 });
    let coil = |name: &str, angle: f64| {
        json!({ "name": format!("{name}_coil"), "type": "torsion_spring", "stiffness": 3, "free_angle": angle,
                "between": [format!("ground.{name}"), format!("{name}.A")] })
    };
    let own = |angle: f64| {
        json!({ "name": "press", "dimension": 2, "gravity": [0, -9.81],
            "ground": { "markers": { "left": [-1, 0], "right": [1, 0] } },
            "bodies": [crank("left", -1.0), crank("right", 1.0),
                       { "name": "block", "type": "point_mass", "mass": 2, "initial": { "position": [0, 0.4] } }],
            "joints": [pin("left"), pin("right"), driver("left", "0.3*sin(3*t)"), driver("right", "-0.3*sin(3*t)")],
            "forces": [band("one", ["left.B", "block"]), band("two", ["block", "right.B"]),
                       coil("left", 0.2), coil("right", angle)],
            "outputs": [{ "name": "y", "measure": "position", "of": "block", "component": "y" },
                        { "name": "x", "measure": "position", "of": "block", "component": "x" },
                        { "name": "tip", "measure": "position", "of": "right.B", "component": "x" },
                        { "name": "pull", "measure": "force", "of": "two" },
                        { "name": "coil", "measure": "force", "of": "left_coil" },
                        { "name": "torque", "measure": "reaction", "of": "left_drive" },
                        { "name": "pin", "measure": "reaction", "of": "right_pin", "component": "x" }],
            "simulation": { "t_end": 2, "output_step": 0.02, "rtol": 1e-9, "atol": 1e-11 } })
    };
    let found = scene(own(-0.2), &settings(0.001, &[]));
    let run = half(&found).unwrap_or_else(|| panic!("{:?}", found.trials));
    // Both are integrated at rtol 1e-9.
    assert!(run.error() < 1e-7, "{:?}", run.outputs);
    assert_eq!((run.velocities, run.constraints, run.outputs.len()), (4, 3, 7));
    assert!(scene(own(0.2), &settings(0.001, &[])).trials.iter().all(|trial| trial.candidate != "symmetric_half"));
}

/// With the bump of the left wheel under both, all outputs of both sides, and of the whole, follow from one.
#[test]
fn a_car_over_a_bump_is_half_a_car() {
    let bump = |width: f64| [("right_bump", 0.08), ("right_time", 0.5), ("right_width", width)];
    let same = shipped("full_axle", &bump(0.07), None, &settings(0.001, &[]));
    let run = half(&same).unwrap();
    // Both are integrated at rtol 1e-9: 12 of 24 unknowns, and a few steps more or less.
    assert!(run.error() < 1e-7 && run.work < 0.6 * same.richest.work, "{:?}", run.outputs);
    assert_eq!((run.velocities, run.constraints, run.outputs.len()), (7, 5, 13));
    assert!(half(&shipped("full_axle", &bump(0.0707), None, &settings(0.001, &[]))).is_none());
}

/// A beam that swings in a plane beside the origin across `n`, with a wing on each side and a bob on a spring, in the
/// plane of `f` and `g`.
fn bird([n, f, g]: [[f64; 3]; 3], support: &Value) -> Value {
    let at = |x: f64, y: f64, z: f64| -> [f64; 3] { std::array::from_fn(|i| x * n[i] + y * f[i] + z * g[i]) };
    let inertia = |all: f64, [a, b]: [[f64; 3]; 2], part: f64| -> Vec<f64> {
        let places = [(0, 0), (1, 1), (2, 2), (0, 1), (0, 2), (1, 2)];
        let moment = |(i, j): (usize, usize)| part * (a[i] * b[j] + a[j] * b[i]) + if i == j { all } else { 0.0 };
        places.map(moment).to_vec()
    };
    let pin = |position: [f64; 3]| json!({ "position": position, "z_axis": f, "x_axis": n });
    let wing = |name: &str, side: f64| {
        json!({ "name": name, "type": "rigid", "mass": "m", "inertia": inertia(0.02, [n, g], 0.004 * side),
                "markers": { "root": pin(at(-0.25 * side, 0.0, 0.0)), "mid": at(0.0, 0.05, 0.0),
                             "tip": at(0.3 * side, 0.0, 0.1) },
                "initial": { "position": at(0.3 + 0.45 * side, 0.0, -0.5) } })
    };
    let beam = json!({ "name": "beam", "type": "rigid", "mass": 2, "inertia": inertia(0.1, [f, g], 0.02),
        "markers": { "top": { "position": at(0.0, 0.0, 0.5), "z_axis": n, "x_axis": f }, "end": at(0.0, 0.1, -0.5),
                     "right": pin(at(0.2, 0.0, 0.0)), "left": pin(at(-0.2, 0.0, 0.0)),
                     "far": at(0.1, 0.0, -0.4), "near": at(-0.1, 0.0, -0.4) },
        "initial": { "position": at(0.3, 0.0, -0.5), "angular_velocity": n.map(|x| 1.5 * x) } });
    let bob =
        json!({ "name": "bob", "type": "point_mass", "mass": 0.5, "initial": { "position": at(0.3, 0.1, -1.2) } });
    let spring = |name: &str, a: &str, b: &str, length: f64| {
        json!({ "name": name, "type": "spring_damper", "between": [a, b], "stiffness": "k", "damping": 1,
                "free_length": length })
    };
    let root = |name: &str| {
        let between = [format!("beam.{name}"), format!("{name}.root")];
        json!({ "name": format!("{name}_root"), "type": "revolute", "between": between })
    };
    let mut outputs = vec![
        json!({ "name": "beat", "measure": "angular_velocity", "of": "left", "relative_to": "beam.left", "component": "z" }),
        json!({ "name": "pull", "measure": "force", "of": "left_muscle" }),
        json!({ "name": "swing", "measure": "angular_velocity", "of": "beam", "component": (["x", "y", "z"][axis(n)]) }),
        json!({ "name": "energy", "measure": "energy" }),
        json!({ "name": "span", "measure": "distance", "between": ["left.tip", "beam.near"] }),
        json!({ "name": "load", "measure": "force", "of": "string" }),
    ];
    for of in ["right.tip", "left.tip", "bob"] {
        for component in ["x", "y", "z"] {
            outputs
                .push(json!({ "name": format!("{of}_{component}").replace('.', "_"), "measure": "position", "of": of,
                                 "component": component }));
        }
    }
    let mut joints = vec![root("right"), root("left")];
    joints.extend(support["joints"].as_array().unwrap().clone());
    let mut forces = vec![
        spring("right_muscle", "right.mid", "beam.far", 0.3),
        spring("left_muscle", "left.mid", "beam.near", 0.3),
        spring("string", "beam.end", "bob", 0.15),
    ];
    forces.extend(support["forces"].as_array().unwrap().clone());
    json!({ "name": "bird", "dimension": 3, "gravity": g.map(|x| -9.81 * x), "parameters": { "m": 0.4, "k": 300 },
            "ground": { "markers": { "O": { "position": at(0.3, 0.0, 0.0), "z_axis": n, "x_axis": f },
                                     "a": at(0.8, 0.0, 0.0), "b": at(-0.2, 0.0, 0.0) } },
            "bodies": [beam, wing("right", 1.0), wing("left", -1.0), bob],
            "joints": joints, "forces": forces,
            "outputs": outputs,
            "simulation": { "t_end": 0.5, "output_step": 0.01, "rtol": 1e-9, "atol": 1e-11 } })
}

fn axis(n: [f64; 3]) -> usize {
    n.iter().position(|x| *x != 0.0).unwrap()
}

/// In space, across each axis, with the beam on a hinge, or on two springs: then it needs its freedoms to stay in the
/// plane.
#[test]
fn halves_are_found_across_each_axis() {
    let (x, y, z) = ([1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]);
    let hinge = json!({ "joints": [{ "name": "hinge", "type": "revolute", "between": ["ground.O", "beam.top"] }], "forces": [] });
    let hung = |name: &str, from: &str| json!({ "name": name, "type": "spring_damper", "between": [from, "beam.top"], "stiffness": 800, "damping": 2 });
    let springs = json!({ "joints": [], "forces": [hung("one", "ground.a"), hung("two", "ground.b")] });
    for axes in [[x, y, z], [y, z, x], [z, x, y]] {
        let name = ["x", "y", "z"][axis(axes[0])];
        for (support, sizes) in [(&hinge, [21, 15, 14, 10]), (&springs, [21, 10, 11, 5])] {
            let own = bird(axes, support);
            let found = scene(own, &settings(0.001, &[]));
            let run = half(&found).unwrap_or_else(|| panic!("{name}: {:?}", found.trials));
            // Both are integrated at rtol 1e-9; positions along the normal in the plane are zero.
            assert!(run.error() < 1e-6, "{name}: {:?}", run.outputs);
            assert_eq!([found.richest.velocities, found.richest.constraints, run.velocities, run.constraints], sizes);
            assert_eq!(left_out(&found)[0], format!("of the two halves across {name} one is left"));
        }
    }
    let near = promised(bird([x, y, z], &hinge), &settings(0.01, &["bob_y", "left_tip_z"]));
    assert!(half(&near).is_some());
}

/// Two pendula that start `angle` to the outside, with a spring between their middles; the right one's frame is turned
/// by pi.
fn pendula(angle: f64, k: f64) -> Value {
    let pendulum = |name: &str, [x, side]: [f64; 2]| {
        let turned = side > 0.0;
        let along = |s: f64| if turned { [0.0, -s] } else { [0.0, s] };
        json!({ "name": name, "type": "rigid", "mass": 1, "inertia": 0.05,
                "markers": { "O": along(0.5), "mid": along(0.0), "tip": along(-0.5) },
                "initial": { "position": [x + side * 0.5 * angle.sin(), -0.5 * angle.cos()],
                             "angle": side * angle + if turned { std::f64::consts::PI } else { 0.0 } } })
    };
    let output = |name: &str, measure: &str, of: &str| json!({ "name": name, "measure": measure, "of": of });
    json!({ "name": "pendula", "dimension": 2, "gravity": [0, -9.81], "parameters": { "k": k, "l0": 0.7 },
            "ground": { "markers": { "A": [0.1, 0], "B": [1.1, 0] } },
            "bodies": [pendulum("left", [0.1, -1.0]), pendulum("right", [1.1, 1.0])],
            "joints": [{ "name": "A", "type": "revolute", "between": ["ground.A", "left.O"] },
                       { "name": "B", "type": "revolute", "between": ["ground.B", "right.O"] }],
            "forces": [{ "name": "band", "type": "spring_damper", "between": ["right.mid", "left.mid"],
                         "stiffness": "k", "damping": 1, "free_length": "l0" }],
            "outputs": [output("a", "angle", "left"), output("b", "angle", "right"),
                        output("hinge_a", "angle", "A"), output("hinge_b", "angle", "B"),
                        output("rate_b", "angular_velocity", "B"), output("pull", "force", "band"),
                        output("length", "distance", "band"), output("rate", "distance_rate", "band"),
                        json!({ "name": "gap", "measure": "distance", "between": ["right.tip", "left.tip"] }),
                        output("power", "power", "band"), json!({ "name": "energy", "measure": "energy" }),
                        json!({ "name": "pin", "measure": "reaction", "of": "B", "component": "x" })],
            "simulation": { "t_end": 2, "output_step": 0.01, "rtol": 1e-9, "atol": 1e-11 } })
}

/// It acts towards the plane, with twice the stiffness from half the length.
#[test]
fn a_spring_between_the_halves_acts_towards_the_plane() {
    let mut own = pendula(0.3, 8.0);
    let found = scene(own.clone(), &settings(0.001, &[]));
    let run = half(&found).unwrap_or_else(|| panic!("{:?}", found.trials));
    // Both are integrated at rtol 1e-9.
    assert!(run.error() < 1e-7, "{:?}", run.outputs);
    assert_eq!((run.velocities, run.constraints, run.outputs.len()), (3, 2, 12));
    // Off its image it is another one.
    own["forces"][0]["between"] = json!(["right.mid", "left.tip"]);
    let crossed = scene(own, &settings(0.001, &[]));
    assert!(crossed.trials.iter().all(|trial| trial.candidate != "symmetric_half"));
}

/// Hinges that name their bodies the other way are images all the same: angles, rates and reactions of one are minus
/// those of the other.
#[test]
fn hinges_named_the_other_way_are_images() {
    for (hinge, other) in [("A", "B"), ("B", "A")] {
        let mut own = pendula(0.3, 8.0);
        let joints = own["joints"].as_array_mut().unwrap();
        let turned = joints.iter_mut().find(|joint| joint["name"] == hinge).unwrap();
        turned["between"].as_array_mut().unwrap().reverse();
        let outputs = own["outputs"].as_array_mut().unwrap();
        for name in [hinge, other] {
            for component in ["x", "y"] {
                for on in ["first", "second"] {
                    outputs
                        .push(json!({ "name": format!("{name}_{component}_{on}"), "measure": "reaction", "of": name,
                                         "component": component, "on": on }));
                }
            }
        }
        let found = scene(own, &settings(0.001, &[]));
        let run = half(&found).unwrap_or_else(|| panic!("{hinge}: {:?}", found.trials));
        // Both are integrated at rtol 1e-9.
        assert!(run.error() < 1e-7, "{hinge}: {:?}", run.outputs);
        assert_eq!((run.velocities, run.constraints, run.outputs.len()), (3, 2, 20));
    }
}

/// Upright, in equilibrium, the spring keeps them from falling apart, and not from falling together to one side.
#[test]
fn an_unstable_mode_that_is_lost_is_told() {
    let upright = std::f64::consts::PI;
    let mut own = pendula(upright, 30.0);
    own["parameters"]["l0"] = json!(1.0);
    own["outputs"] = json!([{ "name": "a", "measure": "angle", "of": "left" }]);
    let push = |name: &str, side: f64| {
        json!({ "name": format!("push_{name}"), "type": "applied_force", "at": format!("{name}.mid"),
                "force": [format!("{side}*sin(3*t)"), 0] })
    };
    own["forces"].as_array_mut().unwrap().extend([push("left", -1.0), push("right", 1.0)]);
    let found = scene(own, &settings(0.01, &[]));
    assert!(half(&found).is_some(), "{:?}", found.trials);
    let lost = found.warnings.iter().find(|warning| warning.text.contains("lost modes")).unwrap();
    // That which decays as fast is not.
    assert!(lost.text.matches("Hz").count() == 1 && lost.text.contains("unstable"), "{}", lost.text);
}

/// Of two pendula apart from each other any two shapes are modes; one half has that of both together.
#[test]
fn of_two_modes_with_one_frequency_one_is_lost() {
    let mut own = pendula(0.3, 0.0);
    own["forces"] = json!([]);
    own["outputs"] = json!([{ "name": "a", "measure": "angle", "of": "left" },
                            { "name": "b", "measure": "angle", "of": "right" }]);
    let found = scene(own, &settings(0.01, &[]));
    assert!(half(&found).is_some(), "{:?}", found.trials);
    let lost = found.warnings.iter().find(|warning| warning.text.contains("lost modes")).unwrap();
    assert_eq!(lost.text.matches("Hz").count(), 1, "{}", lost.text);
}
