//! URDF as makers publish it: inertia without mass, moments that miss, mimics that are left over.

use crate::scenes::parse;
use holonom::import::{Imported, Options, import};
use holonom::report::check;
use holonom::scene::{Scene, json};

fn imported(text: &str) -> Imported {
    import(text, &Options::default()).unwrap()
}

fn refused(text: &str) -> String {
    let error = import(text, &Options::default()).unwrap_err();
    let holonom::Error::Input(input) = &error else { unreachable!() };
    assert!(input.place.is_some(), "{error}");
    error.to_string()
}

/// The hinge `a` swings from 1e-3 rad as 1e-3 cos(w t) does; the series of the pendulum goes on with parts of 1e-6/16.
#[track_caller]
fn swings_at(imported: &Imported, w: f64) {
    let mut scene = imported.scene.clone();
    scene["initial"] = json!({ "a.angle": 1e-3 });
    let run = parse(&scene.to_string()).tight(1e-11, 1.0, 0.1);
    let error = run.worst("a", |t| 1e-3 * (w * t).cos());
    assert!(error < 1e-9, "{error:e} from cos({w} t)");
}

#[test]
fn a_rotor_without_mass_adds_its_inertia() {
    let rotor = imported(include_str!("../data/import/rotor_without_mass.urdf"));
    assert!(rotor.warnings.is_empty() && rotor.left_out.iter().all(|what| !what.contains("mass")), "{rotor:?}");
    swings_at(&rotor, (1.5 * 9.81 * 0.4 / (0.02 + 0.05 + 1.5 * 0.16f64)).sqrt());
}

/// 0.05 a'' = -0.1 a'.
#[test]
fn a_wheel_of_inertia_alone_runs() {
    let mut wheel = imported(include_str!("../data/import/wheel_of_inertia_alone.urdf"));
    assert!(wheel.left_out.is_empty(), "{wheel:?}");
    wheel.scene["initial"]["a.angle'"] = json!(1);
    let run = parse(&wheel.scene.to_string()).tight(1e-11, 2.0, 0.25);
    assert!(run.worst("a", |t| 0.5 * (1.0 - (-2.0 * t).exp())) < 1e-10);
}

#[test]
fn a_mass_below_zero_is_refused() {
    let error = refused(include_str!("../data/import/mass_below_zero.urdf"));
    assert!(error.contains("`lug`: the mass is -1, but cannot be negative"), "{error}");
}

/// 0.26 a'' = 0.5 a', without gravity.
#[test]
fn damping_below_zero_is_kept_with_a_warning() {
    let mut fed = imported(include_str!("../data/import/damping_below_zero.urdf"));
    assert!(fed.warnings[0].contains("damping below zero") && fed.warnings[0].contains(" a"), "{:?}", fed.warnings);
    fed.scene["gravity"] = json!([0, 0, 0]);
    fed.scene["initial"]["a.angle'"] = json!(1);
    let run = parse(&fed.scene.to_string()).tight(1e-11, 1.0, 0.1);
    let k = 0.5 / 0.26;
    assert!(run.worst("a", |t| ((k * t).exp() - 1.0) / k) < 1e-9);
}

/// The largest moment, about an axis that does not turn, is lowered; that about the hinge stays.
#[test]
fn moments_that_miss_by_two_percent_run_with_a_warning() {
    let arm = imported(include_str!("../data/import/moments_two_percent_off.urdf"));
    let warning = &arm.warnings[0];
    assert!(warning.contains("of arm") && warning.contains("0.01059") && warning.contains("0.01037"), "{warning}");
    assert!(warning.contains("2.08 %"), "{warning}");
    swings_at(&arm, (1.5 * 9.81 * 0.1 / (0.00846 + 1.5 * 0.01f64)).sqrt());
}

/// What is far from a tensor of inertia stays as it is, and the scene does not start.
#[test]
fn moments_that_are_wrong_are_not_made_valid() {
    let text = include_str!("../data/import/moments_two_percent_off.urdf").replace("0.01059", "0.02");
    let arm = imported(&text);
    assert!(arm.warnings.is_empty() && arm.scene["bodies"][0]["inertia"][2] == 0.02, "{arm:?}");
    let error = Scene::parse(&arm.scene.to_string(), &[]).err().unwrap().to_string();
    assert!(error.contains("`arm`") && error.contains("violate the triangle inequality"), "{error}");
}

#[test]
fn moments_of_round_off_make_a_point() {
    let bob = imported(include_str!("../data/import/moments_of_round_off.urdf"));
    assert!(bob.warnings[0].contains("arm"), "{:?}", bob.warnings);
    swings_at(&bob, (9.81f64 / 0.4).sqrt());
}

#[test]
fn a_mimic_on_a_fixed_joint_is_left_out() {
    let arm = imported(include_str!("../data/import/mimic_on_fixed.urdf"));
    assert!(arm.left_out.iter().any(|what| what == "mimic of the fixed joints b"), "{:?}", arm.left_out);
    assert_eq!(check(&parse(&arm.scene.to_string()).0).degrees_of_freedom, 1);
}

#[test]
fn what_follows_a_fixed_joint_stands_at_its_offset() {
    let text = include_str!("../data/import/mimic_on_fixed.urdf")
        .replace("\"b\" type=\"fixed\"", "\"b\" type=\"revolute\"")
        .replace("\"a\" type=\"continuous\"", "\"a\" type=\"fixed\"")
        .replace("multiplier=\"-1\"", "multiplier=\"-1\" offset=\"0.3\"");
    let arm = imported(&text);
    assert!(arm.left_out.iter().any(|what| what.contains("motion of b: each mimics a fixed joint")), "{arm:?}");
    let ready = parse(&arm.scene.to_string());
    assert_eq!(check(&ready.0).degrees_of_freedom, 0);
    assert!((ready.tight(1e-9, 0.1, 0.1).column("b")[0] - 0.3).abs() < 1e-12);
}

#[test]
fn a_mimic_of_itself_is_refused() {
    let text = include_str!("../data/import/mimic_on_fixed.urdf").replace("type=\"fixed\"", "type=\"revolute\"");
    let error = refused(&text.replace("mimic joint=\"a\"", "mimic joint=\"b\""));
    assert!(error.contains("`b`: it mimics itself"), "{error}");
}

#[test]
fn a_blank_line_before_the_declaration_is_read() {
    let text = include_str!("../data/import/blank_first_line.urdf");
    assert_eq!(imported(text).scene, imported(text.trim_start()).scene);
    // Places stay those of the file.
    let holonom::Error::Input(input) = import(&text.replace("arm", "base"), &Options::default()).unwrap_err() else {
        unreachable!()
    };
    assert_eq!(input.place.map(|(line, _)| line), Some(4));
}

#[test]
fn mass_of_the_ground_is_told() {
    let held = imported(include_str!("../data/import/one_link.urdf"));
    assert!(held.left_out.iter().any(|what| what == "mass of links that are the ground: hull"), "{held:?}");
    let options = Options { is_free: true, ..Options::default() };
    let free = import(include_str!("../data/import/one_link.urdf"), &options).unwrap();
    assert_eq!(check(&parse(&free.scene.to_string()).0).degrees_of_freedom, 6);
}

/// Ten thousand links in a row, and as many names of one form: a minute each in quadratic time.
#[test]
fn long_chains_and_alike_names_are_imported() {
    let links = |name: fn(usize) -> String| -> String {
        let joint = |i: usize| {
            let parent = name(i - 1);
            let child = name(i);
            format!(
                "<link name=\"{child}\"/><joint name=\"j{i}\" type=\"continuous\"><origin xyz=\"0 0 -0.1\"/>\
                 <parent link=\"{parent}\"/><child link=\"{child}\"/><mimic joint=\"j1\" multiplier=\"{i}\"/></joint>"
            )
        };
        let all: String = (1..=10_000).map(joint).collect();
        format!(
            "<robot><link name=\"{}\"/>{}</robot>",
            name(0),
            all.replacen("<mimic joint=\"j1\" multiplier=\"1\"/>", "", 1)
        )
    };
    let chain = imported(&links(|i| format!("l{i}"))).scene;
    let depth = chain["bodies"][9_999]["initial"]["position"][2].as_f64().unwrap();
    assert!((depth + 1000.0).abs() < 1e-9, "{depth}");
    let signs = |i: usize| {
        let sign = |digit: u8| char::from(b"()*+,-.:;="[usize::from(digit - b'0')]);
        i.to_string().bytes().map(sign).collect::<String>()
    };
    let alike = imported(&links(signs));
    assert_eq!(alike.scene["bodies"].as_array().map(Vec::len), Some(10_000));
}

#[test]
fn a_gear_whose_wheel_is_its_carrier_is_refused() {
    let bodies = ["arm", "wheel"].map(|name| {
        json!({ "name": name, "type": "rigid", "mass": 1, "inertia": [1, 1, 1],
            "markers": { "A": [0, 0, 0], "B": [0, 0, 0] } })
    });
    let text = json!({ "name": "g", "dimension": 3, "bodies": bodies,
        "joints": [{ "name": "mesh", "type": "gear", "between": ["arm.A", "wheel.A"], "carrier": ["arm.B", "arm.B"],
            "teeth": [20, 30] }] });
    let error = Scene::parse(&text.to_string(), &[]).err().unwrap().to_string();
    assert!(error.contains("carrier[0]") && error.contains("the wheel `arm` is its own carrier"), "{error}");
}
