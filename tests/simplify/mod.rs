//! Only what a motion requires: what is left out, what stays, and that the promise is what is measured.

mod figure;
mod light_bodies;
mod nearby;
mod promise;

use crate::scenes::model;
use holonom::clock;
use holonom::prepared::Overrides;
use holonom::simplify::{Nearby, Simplification, SimplificationSettings, Source, registry, simplify};
use serde_json::{Value, json};

/// Counted time decides which models and methods are too slow.
fn settings(within: f64, outputs: &[&str]) -> SimplificationSettings {
    clock::count_readings();
    let outputs = outputs.iter().map(|name| name.to_string()).collect();
    SimplificationSettings { within, outputs, ..SimplificationSettings::default() }
}

fn found(source: Source, settings: &SimplificationSettings) -> Simplification {
    let found = simplify(&source, settings, registry(), &|| false, &mut |_, _| ()).unwrap();
    assert!(found.chosen.error() <= settings.within && found.runs <= settings.at_most, "{:?}", found.trials);
    // What is written is what was measured.
    let written = Source { scene: found.simplified.clone(), ..source };
    let prepared = written.prepare(&written.scene).unwrap();
    assert_eq!(prepared.system().dimensions().v, found.chosen.velocities);
    assert_eq!(prepared.method, found.chosen.method);
    found
}

fn shipped(name: &str, set: &[(&str, f64)], until: Option<f64>, settings: &SimplificationSettings) -> Simplification {
    let set = set.iter().map(|(name, value)| (name.to_string(), (*value).into())).collect();
    found(Source::load(&model(name), &Overrides { set, until, ..Overrides::default() }).unwrap(), settings)
}

fn scene(json: Value, settings: &SimplificationSettings) -> Simplification {
    found(Source::new(json, &Overrides::default()).unwrap(), settings)
}

/// Found with the promise kept on at least 95 % of 20 motions nearby, for the work of 15 runs of the full model at
/// most.
fn promised(json: Value, settings: &SimplificationSettings) -> Simplification {
    let nearby = Some(Nearby { by: 0.1, samples: Some(20) });
    let found = scene(json, &SimplificationSettings { nearby, ..settings.clone() });
    let robustness = found.robustness.as_ref().unwrap();
    assert!(robustness.counted == 20 && robustness.kept >= 19, "{:?}", robustness.motions);
    assert!(robustness.motions.iter().filter_map(|motion| motion.worst.as_ref()).any(|worst| worst.error > 0.0));
    assert!(found.cost <= 15.0, "{}", found.cost);
    found
}

/// What was left out.
fn left_out(found: &Simplification) -> Vec<&str> {
    found.left_out().flat_map(|trial| &trial.what).map(String::as_str).collect()
}

#[test]
fn a_crank_needs_one_mode_of_its_rod_and_none_for_the_slider() {
    let of = |within, outputs: &[&str]| {
        shipped("flexible_slider_crank_fe", &[("n", 8.0)], Some(0.05), &settings(within, outputs))
    };
    let all = of(0.1, &[]);
    assert!(left_out(&all).contains(&"rod keeps 1 of its modes"), "{:?}", left_out(&all));
    assert!(all.chosen.error() > 1e-3 && all.richest.velocities == 39 && all.chosen.velocities <= 12);
    let slider = of(1e-4, &["x3"]);
    assert!(left_out(&slider).contains(&"rod becomes rigid"), "{:?}", left_out(&slider));
    // The mass of the rod is that of the mesh: the mechanism has no freedom, but its reactions need it.
    let parameters = ["crank", "rod", "slider"].map(|name| slider.simplified.to_string().contains(name));
    assert_eq!((slider.chosen.velocities, parameters), (7, [true; 3]));
}

#[test]
fn rods_of_a_suspension_go_at_five_per_cent_and_stay_at_a_tenth() {
    let of = |within| shipped("five_link_suspension_rods", &[], None, &settings(within, &[]));
    let coarse = of(0.05);
    assert_eq!((coarse.richest.velocities, coarse.chosen.velocities, coarse.chosen.constraints), (37, 7, 5));
    // The reactions of the rods are watched on: as tension of the distances.
    assert!(coarse.chosen.outputs.iter().any(|output| output.name == "rod5_force" && output.error > 1e-4));
    assert!(coarse.simplified["about"].as_str().unwrap().contains("rod3 becomes a distance without mass"));
    let fine = of(0.001);
    assert_eq!(fine.chosen.velocities, 37);
}

#[test]
fn a_spinning_beam_needs_its_stiffening() {
    let lag = shipped("spin_up_beam", &[], Some(12.0), &settings(0.1, &["lag"]));
    // diffsol takes a thousand times as long as the run that it confirms.
    let opinion = lag.second_opinion.as_ref().unwrap();
    assert!(opinion.difference.is_none() && opinion.about.contains("longer than the 5 s"), "{opinion}");
    let kept = left_out(&lag);
    assert!(!kept.iter().any(|what| what.contains("rigid") || what.contains("stiffening")), "{kept:?}");
    let beam = &lag.simplified["bodies"][0];
    assert_eq!((&beam["type"], &beam["geometric_stiffening"]), (&json!("flexible_beam"), &json!(true)));
    let refused = |what: &str| lag.trials.iter().any(|trial| trial.what[0].contains(what) && !trial.is_kept);
    assert!(refused("becomes rigid") && refused("without geometric stiffening"), "{:?}", lag.trials);
}

#[test]
fn nothing_can_be_left_out_of_a_robot_arm() {
    let arm = shipped("robot_arm", &[], Some(3.0), &settings(0.1, &[]));
    assert!(!arm.is_simpler(), "{:?}", left_out(&arm));
    assert!(arm.simplified["about"].as_str().unwrap().contains("nothing can be left out"));
}

/// Work is compared with what is converted, not with the kinetic energy of a car that rolls on: to run it without the
/// dampers of its struts, which is off by 90 %, is hopeless.
#[test]
fn what_a_car_rolls_with_is_no_measure_of_work() {
    let car = shipped("half_car", &[], None, &settings(0.01, &[]));
    let struts: Vec<_> = car.trials.iter().filter(|trial| trial.what[0].ends_with("_strut is not damped")).collect();
    assert!(struts.len() == 2 && struts.iter().all(|trial| trial.run.is_none()), "{struts:?}");
    assert!(car.runs < 12, "{}", car.runs);
}

/// A pendulum with these joints and forces.
fn pendulum(joints: Value, forces: Value) -> Value {
    json!({ "name": "pendulum", "dimension": 2, "gravity": [0, -9.81], "parameters": { "m": 1, "k": 1e6 },
            "ground": { "markers": { "O": [0, 0], "far": [0, 2] } },
            "bodies": [{ "name": "rod", "type": "rigid", "mass": "m", "inertia": "m/12",
                         "markers": { "A": [-0.5, 0], "B": [0.5, 0] }, "initial": { "position": [0.5, 0] } }],
            "joints": joints, "forces": forces,
            "outputs": [{ "name": "theta", "measure": "angle", "of": "rod" }],
            "simulation": { "t_end": 1, "output_step": 0.01, "rtol": 1e-8, "atol": 1e-10 } })
}

fn pin() -> Value {
    json!([{ "name": "O", "type": "revolute", "between": ["ground.O", "rod.A"] }])
}

fn damper(name: &str, damping: f64) -> Value {
    json!({ "name": name, "type": "spring_damper", "between": ["ground.far", "rod.B"], "damping": damping })
}

/// Of two dampers either may go, but not both.
#[test]
fn what_is_harmless_alone_may_be_wrong_together() {
    let forces = |which: &[&str]| -> Value { which.iter().map(|name| damper(name, 0.06)).collect() };
    let mut scene = pendulum(pin(), forces(&["one", "other"]));
    // So many steps that one more without the dampers is not a tenth of the work.
    (scene["simulation"]["rtol"], scene["simulation"]["atol"]) = (json!(1e-9), json!(1e-11));
    let off = |within| promised(scene.clone(), &settings(within, &[]));
    let both = off(0.02);
    let of = |name: &str| both.trials.iter().find(|trial| trial.what == [format!("the force {name} is left out")]);
    let error = |name: &str| of(name).unwrap().run.as_ref().unwrap().error();
    let kept = ["one", "other"].map(|name| of(name).is_some_and(|trial| trial.is_kept));
    assert!(kept == [true, false] && error("one") < 0.02 && error("other") > 0.02, "{:?}", both.trials);
    // The two together were tried first.
    assert!(both.trials.iter().any(|trial| trial.subjects == ["one", "other"] && !trial.is_kept));
    assert_eq!(left_out(&off(0.1)), ["the force one is left out", "the force other is left out"]);
}

/// A four-bar linkage with a hammer on its coupler, and 26 bodies of no account: bolts on the crank, hangers on the
/// rocker, covers on rubber.
fn machine() -> Value {
    let bar = |name: &str, length: f64, [x, y, angle]: [f64; 3]| {
        json!({ "name": name, "type": "rigid", "mass": format!("rho*{length}"), "inertia": format!("rho*{length}^3/12"),
                "markers": { "A": [-0.5 * length, 0], "B": [0.5 * length, 0], "C": [0, 0] },
                "initial": { "position": [x, y], "angle": angle } })
    };
    let small = |name: String, x: f64, y: f64| {
        json!({ "name": name, "type": "rigid", "mass": 1e-5, "inertia": 1e-7, "markers": { "M": [0, 0] },
                "initial": { "position": [x, y] } })
    };
    let (sine, cosine) = 1.2f64.sin_cos();
    let [mut crank, coupler, rocker] = [
        bar("crank", 1.0, [0.5 * cosine, 0.5 * sine, 1.2]),
        bar("coupler", 2.0, [1.21, 1.47, 0.563]),
        bar("rocker", 2.0, [2.03, 1.0, 1.544]),
    ];
    let place = |i: usize| 0.05 * (i as f64 + 1.0);
    let hammer = json!({ "name": "hammer", "type": "rigid", "mass": "rho", "inertia": "rho/50", "markers": { "A": [0, 0.3] },
                         "initial": { "position": [1.21, 1.17] } });
    let mut bodies = vec![coupler, rocker, hammer];
    let mut joints: Vec<Value> = [
        ("O", "ground.O", "crank.A"),
        ("P", "crank.B", "coupler.A"),
        ("D", "ground.D", "rocker.A"),
        ("Q", "rocker.B", "coupler.B"),
        ("H", "coupler.C", "hammer.A"),
    ]
    .map(|(name, a, b)| json!({ "name": name, "type": "revolute", "between": [a, b] }))
    .to_vec();
    let mut ground = json!({ "O": [0, 0], "D": [2, 0] });
    let mut forces = Vec::new();
    for i in 0..10 {
        crank["markers"][format!("bolt{i}")] = json!([place(i), 0]);
        let out = 0.5 + place(i);
        bodies.push(small(format!("bolt{i}"), out * cosine, out * sine));
        joints.push(json!({ "name": format!("thread{i}"), "type": "weld",
                            "between": [format!("crank.bolt{i}"), format!("bolt{i}.M")] }));
        bodies.push(json!({ "name": format!("hanger{i}"), "type": "point_mass", "mass": 1e-5,
                            "initial": { "position": [2.05, 2.0 - place(i)] } }));
        joints.push(json!({ "name": format!("string{i}"), "type": "distance", "length": place(i),
                            "between": ["rocker.B", format!("hanger{i}")] }));
    }
    for i in 0..6 {
        ground[format!("cover{i}")] = json!([place(i), -1]);
        bodies.push(small(format!("cover{i}"), place(i), -1.0));
        forces.push(json!({ "name": format!("rubber{i}"), "type": "bushing", "stiffness": [10, 10, 0.1],
                            "damping": [0.01, 0.01, 1e-4], "between": [format!("ground.cover{i}"), format!("cover{i}.M")] }));
    }
    bodies.insert(0, crank);
    json!({ "name": "machine", "dimension": 2, "gravity": [0, "-g"], "parameters": { "rho": 1, "g": 9.81 },
            "ground": { "markers": ground }, "bodies": bodies, "joints": joints, "forces": forces,
            "outputs": [
                { "name": "crank", "measure": "angle", "of": "crank" },
                { "name": "hammer", "measure": "position", "of": "hammer", "component": "y" },
                { "name": "bearing", "measure": "reaction", "of": "O", "component": "y" } ],
            "simulation": { "t_end": 1, "output_step": 0.01, "rtol": 1e-7, "atol": 1e-9 } })
}

#[test]
fn four_of_thirty_bodies_matter() {
    let found = promised(machine(), &settings(0.02, &[]));
    assert_eq!((found.richest.velocities, found.chosen.velocities), (80, 12), "{:?}", left_out(&found));
    let names: Vec<&str> =
        found.simplified["bodies"].as_array().unwrap().iter().filter_map(|body| body["name"].as_str()).collect();
    assert_eq!(names, ["crank", "coupler", "rocker", "hammer"]);
    assert!(found.cost <= 8.0, "{}", found.cost);
}

#[test]
fn a_stiff_bushing_is_a_joint() {
    let bushing = json!([{ "name": "rubber", "type": "bushing", "between": ["ground.O", "rod.A"],
                           "stiffness": ["k", "k", 0] }]);
    let found = promised(pendulum(json!([]), bushing), &settings(0.01, &[]));
    assert_eq!(left_out(&found), ["rubber becomes a joint (revolute)"], "{:?}", found.trials);
}

/// A pendulum with a disc on a pin at its end, which does not turn.
#[test]
fn a_disc_on_a_pin_is_a_point() {
    let pins = json!([{ "name": "O", "type": "revolute", "between": ["ground.O", "rod.A"] },
                      { "name": "P", "type": "revolute", "between": ["rod.B", "disc.C"] }]);
    let mut scene = pendulum(pins, json!([]));
    let disc = json!({ "name": "disc", "type": "rigid", "mass": "m", "inertia": 0.02, "markers": { "C": [0, 0] },
                       "initial": { "position": [1, 0] } });
    scene["bodies"].as_array_mut().unwrap().push(disc);
    let found = promised(scene, &settings(0.001, &[]));
    assert_eq!((left_out(&found), found.chosen.velocities), (vec!["disc becomes a point mass"], 5));
    let run = found.left_out().next().unwrap().run.as_ref().unwrap();
    // The motion is the same, at rtol 1e-8.
    assert!(run.error() < 1e-6, "{:?}", run.outputs);
}

/// Two bodies that turn freely, welded askew.
#[test]
fn welded_bodies_are_one() {
    let body = |name: &str, inertia: Value, marker: Value, spin: [f64; 3]| {
        json!({ "name": name, "type": "rigid", "mass": 2, "inertia": inertia, "origin": [0.1, 0, 0],
                "markers": { "W": marker }, "initial": { "angular_velocity": spin } })
    };
    let own = body("own", json!([1, 2, 2.5]), json!([0.5, 0, 0]), [1.0, 2.0, 0.5]);
    let askew = json!({ "position": [-0.3, 0.1, 0], "rotation": [0.2, 0.3, 0.7] });
    let other = body("other", json!([0.3, 0.4, 0.5, 0.05, 0, 0.02]), askew, [0.0; 3]);
    let at = |name: &str, of: &str| json!({ "name": name, "measure": "position", "of": of, "component": name });
    let found = scene(
        json!({ "name": "askew", "dimension": 3, "bodies": [own, other],
                "joints": [{ "name": "weld", "type": "weld", "between": ["own.W", "other.W"] }],
                "outputs": [at("x", "own.W"), at("y", "other"), at("z", "other.W")],
                "simulation": { "t_end": 2, "output_step": 0.02, "rtol": 1e-9, "atol": 1e-11 } }),
        &settings(0.01, &[]),
    );
    let merged = found.left_out().next().unwrap();
    assert_eq!((&merged.what[..], found.chosen.velocities), (&["own and other become one body".to_string()][..], 6));
    assert!(merged.run.as_ref().unwrap().error() < 1e-7, "{:?}", merged.run);
}

/// A swinging rod with a disc welded to its end and a tail on that, of which the scene says only that the rod moves:
/// assembly gives all of them rates. One body of the first two is assembled otherwise.
#[test]
fn a_simpler_model_starts_where_the_richest_does() {
    let joint = |name: &str, kind: &str, a: &str, b: &str| json!({ "name": name, "type": kind, "between": [a, b] });
    let joints = json!([
        joint("O", "revolute", "ground.O", "rod.A"),
        joint("W", "weld", "rod.B", "disc.C"),
        joint("P", "revolute", "disc.C", "tail.A")
    ]);
    let mut own = pendulum(joints, json!([]));
    own["bodies"][0]["initial"]["angular_velocity"] = json!(3);
    let body = |name: &str, x: f64| {
        json!({ "name": name, "type": "rigid", "mass": 0.5, "inertia": 0.02, "markers": { "C": [0, 0], "A": [-0.2, 0] },
                "initial": { "position": [x, 0] } })
    };
    own["bodies"].as_array_mut().unwrap().extend([body("disc", 1.0), body("tail", 1.2)]);
    let found = promised(own, &settings(0.01, &[]));
    let merged = found.left_out().find(|trial| trial.what == ["rod and disc become one body"]).unwrap();
    // The motion is the same, at rtol 1e-8.
    assert!(merged.run.as_ref().unwrap().error() < 1e-6, "{:?}", merged.run);
    // What is written starts there, too: slower than the scene says.
    let rate = found.simplified["bodies"][0]["initial"]["angular_velocity"].as_f64().unwrap();
    assert!(rate > 0.1 && rate < 2.0, "{rate}");
}

/// A slider with one free coordinate, at (1.7, -0.5), on a rod of length 1 from (1, 0): assembly moves it to the end of
/// that.
#[test]
fn a_start_along_free_directions_is_written_as_assembled() {
    let mut joints = pin();
    let rod = json!({ "name": "link", "type": "distance", "between": ["rod.B", "slider.C"], "length": 1 });
    joints.as_array_mut().unwrap().push(rod);
    let mut own = pendulum(joints, json!([]));
    let slider = json!({ "name": "slider", "type": "rigid", "mass": 0.5, "free": ["x"], "markers": { "C": [0, 0] },
                         "initial": { "position": [1.7, -0.5] } });
    own["bodies"].as_array_mut().unwrap().push(slider);
    own["assembly"] = json!({ "hold": ["rod.angle"] });
    let found = scene(own, &settings(0.01, &[]));
    let start = &found.simplified["bodies"][1]["initial"]["position"];
    // As exact as assembly is.
    assert!((start[0].as_f64().unwrap() - (1.0 + 0.75f64.sqrt())).abs() < 1e-12 && start[1] == -0.5, "{start}");
}

/// A four-bar linkage written in space, in the plane of the first two of `axes`, with hinges about the third: hinges on
/// two closing joints too many. The frame of the coupler is turned about its line.
fn four_bar_in_space(axes: [[f64; 3]; 3], outputs: Value) -> Value {
    let [e, f, n] = axes;
    let at = |x: f64, y: f64| std::array::from_fn::<f64, 3, _>(|i| x * e[i] + y * f[i]);
    let hinge = |position: Value| json!({ "position": position, "z_axis": n, "x_axis": e });
    let bar = |name: &str, length: f64, [x, y, angle]: [f64; 3], is_turned: bool| {
        let line = at(angle.cos(), angle.sin());
        let side = at(angle.sin(), -angle.cos());
        let end = |x: f64| {
            if is_turned {
                json!({ "position": [x, 0, 0], "z_axis": [0, 1, 0], "x_axis": [1, 0, 0] })
            } else {
                json!([x, 0, 0])
            }
        };
        json!({ "name": name, "type": "rigid", "mass": format!("m*{length}"), "inertia": [0.01, 0.1 * length, 0.1 * length],
                "markers": { "A": end(-0.5 * length), "B": end(0.5 * length) },
                "initial": { "position": at(x, y), "z_axis": if is_turned { side } else { n }, "x_axis": line } })
    };
    // Closed to rounding: the start is not assembled otherwise in the plane.
    let tip = [1.2f64.cos(), 1.2f64.sin()];
    let gap = [2.0 - tip[0], 0.0 - tip[1]];
    let half = 0.25 * (gap[0] * gap[0] + gap[1] * gap[1]);
    let rise = (4.0 - half).sqrt() / (2.0 * half.sqrt());
    let top = [tip[0] + 0.5 * gap[0] - rise * gap[1], tip[1] + 0.5 * gap[1] + rise * gap[0]];
    let between =
        |a: [f64; 2], b: [f64; 2]| [0.5 * (a[0] + b[0]), 0.5 * (a[1] + b[1]), (b[1] - a[1]).atan2(b[0] - a[0])];
    let bars = [
        bar("crank", 1.0, between([0.0, 0.0], tip), false),
        bar("coupler", 2.0, between(tip, top), true),
        bar("rocker", 2.0, between([2.0, 0.0], top), false),
    ];
    let pairs =
        [("ground.O", "crank.A"), ("crank.B", "coupler.A"), ("ground.D", "rocker.A"), ("rocker.B", "coupler.B")];
    let joint = |(a, b): (&str, &str)| json!({ "name": format!("{a} {b}").replace([' ', '.'], "_"), "type": "revolute", "between": [a, b] });
    json!({ "name": "four_bar", "dimension": 3, "gravity": f.map(|part| format!("-g*{part}")),
            "parameters": { "g": 9.81, "m": 1 },
            "ground": { "markers": { "O": hinge(json!([0, 0, 0])), "D": hinge(json!(at(2.0, 0.0))) } },
            "bodies": bars, "joints": pairs.map(joint), "outputs": outputs, "assembly": { "hold": [] },
            "simulation": { "t_end": 1, "output_step": 0.01, "rtol": 1e-8, "atol": 1e-10 } })
}

/// The motion in a plane is the same, whatever plane it is: x-y, z-x, x-z, an oblique one.
#[test]
fn what_moves_in_a_plane_is_planar() {
    let x = [1.0, 0.0, 0.0];
    let y = [0.0, 1.0, 0.0];
    let z = [0.0, 0.0, 1.0];
    let oblique = [x, [0.0, 0.8, 0.6], [0.0, -0.6, 0.8]];
    for (axes, upright) in [([x, y, z], "y"), ([z, x, y], "x"), ([x, z, y.map(|i: f64| 0.0 - i)], "z"), (oblique, "z")]
    {
        let at = |name: &str, component: &str| json!({ "name": name, "measure": "position", "of": "coupler.B", "component": component });
        let outputs = json!([
            { "name": "crank", "measure": "angle", "of": "crank", "relative_to": "ground.O" },
            { "name": "rate", "measure": "angular_velocity", "of": "rocker", "relative_to": "ground.D", "component": "z" },
            { "name": "rise", "measure": "reaction", "of": "ground_O_crank_A", "component": upright },
            at("x", "x"), at("y", "y"), at("z", "z") ]);
        let ends: Vec<&str> =
            ["x", "y", "z"].into_iter().zip(axes[2]).filter(|(_, out)| out.abs() < 1.0).map(|(name, _)| name).collect();
        let watched = [&["crank", "rate", "rise"][..], &ends].concat();
        let flat = promised(four_bar_in_space(axes, outputs), &settings(0.01, &watched));
        let planar = flat.trials.iter().find(|trial| trial.what == ["the scene is planar"]).unwrap();
        let run = planar.run.as_ref().unwrap_or_else(|| panic!("{}", planar.reason));
        // Both are integrated at rtol 1e-8.
        assert!(planar.is_kept && run.error() < 1e-6, "{upright}: {} {:?}", planar.reason, run.outputs);
        assert_eq!((flat.richest.velocities, flat.richest.constraints), (18, 20));
        assert!(flat.chosen.velocities <= 9 && flat.chosen.constraints <= 8);
    }
    let lift = json!([{ "name": "lift", "measure": "position", "of": "coupler.B", "component": "z" },
                      { "name": "end", "measure": "position", "of": "coupler.B", "component": "x" }]);
    let spatial = scene(four_bar_in_space([x, y, z], lift), &settings(0.01, &[]));
    assert!(spatial.simplified["dimension"] == 3 && spatial.chosen.constraints <= 17, "{:?}", left_out(&spatial));
}

/// A filter of 1 ms.
#[test]
fn what_is_too_fast_goes() {
    let road: Vec<[f64; 2]> = (0..=400).map(|i| 0.01 * i as f64).map(|s| [s, 0.02 * (3.0 * s).sin()]).collect();
    let found = promised(
        json!({ "name": "rider", "dimension": 2, "parameters": { "m": 2, "k": 80, "tau": 1e-3 },
                "signals": [{ "name": "road", "points": road }],
                "bodies": [{ "name": "seat", "type": "rigid", "mass": "m", "free": ["y"] }],
                "states": [{ "name": "sensed", "rate": "(seat.y - sensed)/tau" }],
                "forces": [{ "name": "spring", "type": "applied_force", "at": "seat",
                             "force": [0, "k*(road(t) - sensed) - 2*seat.y'"] }],
                "outputs": [{ "name": "height", "measure": "position", "of": "seat", "component": "y" }],
                "simulation": { "t_end": 4, "output_step": 0.01, "rtol": 1e-7, "atol": 1e-9 } }),
        &settings(0.02, &[]),
    );
    let gone = left_out(&found);
    assert!(gone[0] == "sensed follows at once", "{gone:?}");
    assert_eq!((found.richest.velocities, found.chosen.velocities), (2, 1));
}

/// Heun's method at 10 ms errs by more than a tenth of 0.1 %: a shorter step takes its place.
#[test]
fn numerical_error_is_a_tenth_of_the_promise() {
    let mut coarse = pendulum(pin(), json!([]));
    for (key, value) in [("integrator", json!("heun")), ("step", json!(0.01))] {
        coarse["simulation"][key] = value;
    }
    let found = scene(coarse.clone(), &settings(0.001, &[]));
    let first = &found.trials[0];
    assert!(first.is_kept && first.candidate == "method" && first.what[0].contains("as it is at step"), "{first:?}");
    assert!(found.richest.method.step < Some(0.01) && found.richest.error() <= 1e-4, "{:?}", found.richest);
    assert!(found.warnings.iter().all(|warning| !warning.text.contains("numerical error")), "{:?}", found.warnings);
    // At 10 % the scene's own step will do.
    assert_eq!(scene(coarse, &settings(0.1, &[])).richest.method.step, Some(0.01));
}

#[test]
fn what_cannot_be_promised_is_refused() {
    let refused = |json: Value, settings: SimplificationSettings, what: &str| {
        let source = Source::new(json, &Overrides::default()).unwrap();
        let error = simplify(&source, &settings, registry(), &|| false, &mut |_, _| ()).unwrap_err().to_string();
        assert!(error.contains(what), "{error}");
    };
    let own = || pendulum(pin(), json!([]));
    refused(own(), settings(0.0, &[]), "above 0 %");
    refused(own(), settings(0.1, &["teta"]), "did you mean `theta`?");
    refused(own(), SimplificationSettings { at_most: 2, ..settings(0.1, &[]) }, "too few");
    let mut mute = own();
    mute["outputs"] = json!([]);
    refused(mute, settings(0.1, &[]), "no outputs");
}

/// A parallelogram passes states where its pins share the load as they like: their reactions there are none to promise.
#[test]
fn reactions_at_singular_states_are_not_promised() {
    let doubts = |outputs: &[&str]| {
        let found = shipped("parallelogram", &[], Some(0.5), &settings(0.01, outputs));
        found
            .warnings
            .into_iter()
            .map(|warning| warning.text)
            .filter(|text| text.contains("singular"))
            .collect::<Vec<_>>()
    };
    let doubts_of_pins = doubts(&["angle", "pin_A"]);
    assert!(doubts_of_pins.len() == 1 && doubts_of_pins[0].contains("pin_A is not determined"), "{doubts_of_pins:?}");
    assert!(doubts(&["angle"]).is_empty());
}
