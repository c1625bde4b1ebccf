//! Only what a motion requires: what is left out, what stays, and that the promise is what is measured.

use crate::scenes::model;
use holonom::prepared::Overrides;
use holonom::simplify::{Nearby, Settings, Simplification, Source, registry, simplify};
use serde_json::{Value, json};

fn settings(within: f64, outputs: &[&str]) -> Settings {
    let outputs = outputs.iter().map(|name| name.to_string()).collect();
    Settings { within, outputs, ..Settings::default() }
}

fn found(source: Source, settings: &Settings) -> Simplification {
    let found = simplify(&source, settings, registry(), &|| false, &mut |_, _| ()).unwrap();
    assert!(found.chosen.error() <= settings.within && found.runs <= settings.at_most, "{:?}", found.trials);
    // What is written is what was measured.
    let written = Source { scene: found.simplified.clone(), ..source };
    let prepared = written.prepare(&written.scene).unwrap();
    assert_eq!(prepared.system().dimensions().v, found.chosen.velocities);
    assert_eq!(prepared.method, found.chosen.method);
    found
}

fn shipped(name: &str, set: &[(&str, f64)], until: Option<f64>, settings: &Settings) -> Simplification {
    let set = set.iter().map(|(name, value)| (name.to_string(), (*value).into())).collect();
    found(Source::load(&model(name), &Overrides { set, until, ..Overrides::default() }).unwrap(), settings)
}

fn scene(json: Value, settings: &Settings) -> Simplification {
    found(Source::new(json, &Overrides::default()).unwrap(), settings)
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

/// A pendulum on dampers and with hangers, as asked for.
fn pendulum(joint: Value, forces: Value, hangers: usize) -> Value {
    let rod = json!({ "name": "rod", "type": "rigid", "mass": "m", "inertia": "m/12",
                      "markers": { "A": [-0.5, 0], "B": [0.5, 0] }, "initial": { "position": [0.5, 0] } });
    let hanger = |i: usize| {
        json!({ "name": format!("hanger{i}"), "type": "point_mass", "mass": 1e-5,
                "initial": { "position": [1, -0.1 * i as f64] } })
    };
    let string = |i: usize| {
        json!({ "name": format!("string{i}"), "type": "distance", "length": 0.1 * i as f64,
                "between": ["rod.B", format!("hanger{i}")] })
    };
    let bodies: Vec<Value> = [rod].into_iter().chain((1..=hangers).map(hanger)).collect();
    let joints: Vec<Value> = joint.as_array().unwrap().iter().cloned().chain((1..=hangers).map(string)).collect();
    json!({ "name": "pendulum", "dimension": 2, "gravity": [0, -9.81], "parameters": { "m": 1 },
            "ground": { "markers": { "O": [0, 0], "far": [0, 2] } },
            "bodies": bodies, "joints": joints, "forces": forces,
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
    let off = |within| scene(pendulum(pin(), forces(&["one", "other"]), 0), &settings(within, &[]));
    let both = off(0.02);
    let of = |name: &str| both.trials.iter().find(|trial| trial.what == [format!("the force {name} is left out")]);
    let error = |name: &str| of(name).unwrap().run.as_ref().unwrap().error();
    let kept = ["one", "other"].map(|name| of(name).is_some_and(|trial| trial.is_kept));
    assert!(kept == [true, false] && error("one") < 0.02 && error("other") > 0.02, "{:?}", both.trials);
    // The two together were tried first.
    assert!(both.trials.iter().any(|trial| trial.subjects == ["one", "other"] && !trial.is_kept));
    assert_eq!(left_out(&off(0.1)), ["the force one is left out", "the force other is left out"]);
}

#[test]
fn the_bodies_that_matter_stay() {
    let machine = scene(pendulum(pin(), json!([]), 26), &settings(0.05, &[]));
    assert_eq!((machine.richest.velocities, machine.chosen.velocities), (55, 3), "{:?}", left_out(&machine));
    assert!(machine.runs <= 8, "{}", machine.runs);
}

#[test]
fn a_stiff_bushing_is_a_joint() {
    let bushing = json!([{ "name": "rubber", "type": "bushing", "between": ["ground.O", "rod.A"],
                           "stiffness": [1e6, 1e6, 0] }]);
    let found = scene(pendulum(json!([]), bushing, 0), &settings(0.01, &[]));
    assert_eq!(left_out(&found), ["rubber becomes a joint (revolute)"], "{:?}", found.trials);
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

/// A four-bar linkage written in space: hinges on two closing joints too many.
fn four_bar_in_space() -> Value {
    let bar = |name: &str, length: f64, [x, y, angle]: [f64; 3]| {
        json!({ "name": name, "type": "rigid", "mass": length, "inertia": [0.01, 0.1 * length, 0.1 * length],
                "markers": { "A": [-0.5 * length, 0, 0], "B": [0.5 * length, 0, 0] },
                "initial": { "position": [x, y, 0], "rotation": [0, 0, angle] } })
    };
    let bars = [
        bar("crank", 1.0, [0.18, 0.47, 1.2]),
        bar("coupler", 2.0, [1.21, 1.47, 0.563]),
        bar("rocker", 2.0, [2.03, 1.0, 1.544]),
    ];
    let pairs =
        [("ground.O", "crank.A"), ("crank.B", "coupler.A"), ("ground.D", "rocker.A"), ("rocker.B", "coupler.B")];
    let hinge = |(a, b): (&str, &str)| json!({ "name": format!("{a} {b}").replace([' ', '.'], "_"), "type": "revolute", "between": [a, b] });
    json!({ "name": "four_bar", "dimension": 3, "gravity": [0, -9.81, 0],
            "ground": { "markers": { "O": [0, 0, 0], "D": [2, 0, 0] } },
            "bodies": bars, "joints": pairs.map(hinge),
            "outputs": [
                { "name": "crank", "measure": "angle", "of": "crank" },
                { "name": "end", "measure": "position", "of": "coupler.B", "component": "x" },
                { "name": "lift", "measure": "position", "of": "coupler.B", "component": "z" } ],
            "assembly": { "hold": [] },
            "simulation": { "t_end": 1, "output_step": 0.01, "rtol": 1e-8, "atol": 1e-10 } })
}

#[test]
fn what_moves_in_a_plane_is_planar() {
    let flat = scene(four_bar_in_space(), &settings(0.01, &["crank", "end"]));
    assert_eq!(flat.simplified["dimension"], 2, "{:?}", flat.trials);
    assert_eq!((flat.richest.velocities, flat.richest.constraints), (18, 20));
    assert!(flat.chosen.velocities <= 9 && flat.chosen.constraints <= 8);
    let spatial = scene(four_bar_in_space(), &settings(0.01, &["crank", "end", "lift"]));
    assert!(spatial.simplified["dimension"] == 3 && spatial.chosen.constraints <= 17, "{:?}", left_out(&spatial));
}

/// The same samples in every run; a parameter that is a number of elements is not moved.
#[test]
fn a_promise_is_tried_on_motions_nearby() {
    let nearby = Some(Nearby { by: 0.1, samples: 6 });
    let forces = json!([damper("weak", 0.01)]);
    let near = || {
        let settings = Settings { nearby, ..settings(0.05, &[]) };
        scene(pendulum(pin(), forces.clone(), 0), &settings).robustness.unwrap()
    };
    let (first, again) = (near(), near());
    let errors = |near: &holonom::simplify::Robustness| near.motions.iter().map(|m| m.error).collect::<Vec<_>>();
    assert_eq!((first.counted, first.kept, &first.parameters[..]), (6, 6, &["m".to_string()][..]));
    assert!(errors(&first)[0] != errors(&first)[1]);
    assert_eq!(first.motions.len(), again.motions.len());
}

#[test]
fn what_cannot_be_promised_is_refused() {
    let refused = |json: Value, settings: Settings, what: &str| {
        let source = Source::new(json, &Overrides::default()).unwrap();
        let error = simplify(&source, &settings, registry(), &|| false, &mut |_, _| ()).unwrap_err().to_string();
        assert!(error.contains(what), "{error}");
    };
    let own = || pendulum(pin(), json!([]), 0);
    refused(own(), settings(0.0, &[]), "above 0 %");
    refused(own(), settings(0.1, &["teta"]), "did you mean `theta`?");
    refused(own(), Settings { at_most: 2, ..settings(0.1, &[]) }, "too few");
    let mut mute = own();
    mute["outputs"] = json!([]);
    refused(mute, settings(0.1, &[]), "no outputs");
}
