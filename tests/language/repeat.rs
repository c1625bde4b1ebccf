//! Elements written once and repeated: the same as written out, and a Stewart platform.

use crate::scenes::{dop853, model, parse, shipped};
use holonom::prepared::Model;
use holonom::report::check;
use holonom::simulate::Span;
use serde_json::Value;
use std::f64::consts::PI;

/// A chain of three links with a spring and an output each.
fn chain(bodies: &str, joints: &str, forces: &str, outputs: &str) -> String {
    format!(
        r#"{{ "name": "chain", "dimension": 2, "gravity": [0, -9.81], "parameters": {{ "n": 3, "l": 0.5 }},
            "ground": {{ "markers": {{ "B0": [0, 0] }} }},
            "bodies": [{bodies}], "joints": [{joints}], "forces": [{forces}], "outputs": [{outputs}] }}"#
    )
}

#[test]
fn copies_are_as_good_as_written_out() {
    let repeated = chain(
        r#"{ "name": "link{i}", "repeat": { "i": "1..n" }, "type": "rigid", "mass": "{i}", "inertia": "l^2*{i}/12",
             "markers": { "A": ["-l/2", 0], "B": ["l/2", 0] }, "initial": { "position": ["({i} - 0.5)*l", 0] } }"#,
        r#"{ "name": "pin1", "type": "revolute", "between": ["ground.B0", "link1.A"] },
           { "name": "pin{i}", "repeat": { "i": "2..n" }, "type": "revolute", "between": ["link{i - 1}.B", "link{i}.A"] }"#,
        r#"{ "name": "coil{i}", "repeat": { "i": "2..n" }, "type": "torsion_spring", "between": ["link{i-1}", "link{i}"],
             "stiffness": "5/{i}" }"#,
        r#"{ "name": "tip{i}_{j}", "repeat": { "i": "1..n", "j": "i..n" }, "measure": "distance",
             "between": ["link{i}.A", "link{j}.B"] }"#,
    );
    let link = |i: usize| {
        format!(
            r#"{{ "name": "link{i}", "type": "rigid", "mass": {i}, "inertia": "l^2*{i}/12", "markers": {{ "A": ["-l/2", 0],
                "B": ["l/2", 0] }}, "initial": {{ "position": ["({i} - 0.5)*l", 0] }} }}"#
        )
    };
    let pin =
        |i: usize, a: String| format!(r#"{{ "name": "pin{i}", "type": "revolute", "between": ["{a}", "link{i}.A"] }}"#);
    let coil = |i: usize| {
        format!(
            r#"{{ "name": "coil{i}", "type": "torsion_spring", "between": ["link{}", "link{i}"], "stiffness": "5/{i}" }}"#,
            i - 1
        )
    };
    let tip = |i: usize, j: usize| {
        format!(r#"{{ "name": "tip{i}_{j}", "measure": "distance", "between": ["link{i}.A", "link{j}.B"] }}"#)
    };
    let written = chain(
        &[link(1), link(2), link(3)].join(","),
        &[pin(1, "ground.B0".into()), pin(2, "link1.B".into()), pin(3, "link2.B".into())].join(","),
        &[coil(2), coil(3)].join(","),
        &[tip(1, 1), tip(1, 2), tip(1, 3), tip(2, 2), tip(2, 3), tip(3, 3)].join(","),
    );
    let [a, b] = [&repeated, &written].map(|text| parse(text).tight(1e-9, 0.5, 0.1).record.trajectory);
    assert_eq!(a.headings(), b.headings());
    assert!(a.headings().contains(&"tip2_3"));
    assert_eq!(a.rows, b.rows);
}

#[test]
fn mistakes_in_copies_have_their_name_and_the_place_of_the_text() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("scene.json");
    let load = |bodies: &str| {
        std::fs::write(&path, chain(bodies, "", "", "")).unwrap();
        let error = Model::load_with(&path, &Default::default()).map(|_| ()).unwrap_err().to_string();
        error.rsplit_once("scene.json:").unwrap().1.to_string()
    };
    let plain = r#"{ "name": "a", "type": "point_mass", "mass": 1 }"#;
    let copies = |keys: &str| {
        load(&format!(
            "{plain},\n{{ \"name\": \"b{{i}}\", \"repeat\": {{ \"i\": \"1..3\" }}, \"type\": \"rigid\", {keys} }}"
        ))
    };
    let message = copies(r#""mass": "2 - {i}", "inertia": 1"#);
    assert!(message.starts_with("4:71: at bodies[1].mass (`b3`): mass is -1, but cannot be negative"), "{message}");
    let message = copies(r#""mass": "2*i", "inertia": 1"#);
    assert!(message.contains("at bodies[1].mass (`b1`): unknown name `i`"), "{message}");
    assert!(message.contains("write `{i}` for the value of `i` in \"repeat\""), "{message}");
    let marker = r#""mass": 1, "inertia": 1, "markers": { "M{k}": { "repeat": { "k": "1..2" }, "position": [0] } }"#;
    assert!(copies(marker).contains("at bodies[1].markers.M{k}.position (`b1`): expected 2 numbers"));
    let message = load(r#"{ "name": "b{i}", "type": "point_mass", "mass": 1 }"#);
    assert!(message.contains("`b{i}` cannot be a name") && message.contains("need a \"repeat\""), "{message}");
}

/// The platform moves as the lengths of its legs say: inverse kinematics, by the rotation of the platform's corners.
#[test]
fn stewart_platform_follows_the_lengths_of_its_legs() {
    let run = shipped("stewart_platform", &[]).run(&dop853(1e-10), Span { start: 0.0, end: 2.0, output_step: 0.25 });
    let rise = |t: f64| 1.1 + 0.15 * (1.0 - (PI * t).cos());
    let turn = |t: f64| 0.2 * (1.0 - (PI * t).cos());
    assert!(run.worst("height", rise) < 1e-9, "{:e}", run.worst("height", rise));
    assert!(run.worst("yaw", |t| turn(t).to_degrees()) < 1e-7);
    for coordinate in ["x", "y", "qx", "qy"] {
        assert!(run.worst(&format!("platform.{coordinate}"), |_| 0.0) < 1e-9, "{coordinate}");
    }
    for leg in 1..=6 {
        let sign = if leg % 2 == 0 { 1.0 } else { -1.0 };
        let at = PI / 3.0 * (leg as f64 - 0.5);
        let base = at - 0.35 * sign;
        let corner = at + 0.35 * sign;
        let length = |t: f64| {
            let (s, c) = (corner + turn(t)).sin_cos();
            (0.7 * c - 1.2 * base.cos()).hypot(0.7 * s - 1.2 * base.sin()).hypot(rise(t))
        };
        assert!(run.worst(&format!("length{leg}"), length) < 1e-9, "leg {leg}");
    }
}

/// 13 bodies of 6 freedoms; a leg's joints take 4 + 5 + 3 of them.
#[test]
fn a_stewart_platform_without_drivers_has_six_degrees_of_freedom() {
    let mut scene: Value = serde_json::from_str(&std::fs::read_to_string(model("stewart_platform")).unwrap()).unwrap();
    scene["joints"].as_array_mut().unwrap().retain(|joint| joint["type"] != "driver");
    scene["outputs"].as_array_mut().unwrap().retain(|output| output["measure"] != "reaction");
    let free = check(&parse(&scene.to_string()).0);
    assert_eq!((free.degrees_of_freedom, free.constraints), (6, 72));
    assert_eq!(check(&shipped("stewart_platform", &[]).0).degrees_of_freedom, 0);
}
