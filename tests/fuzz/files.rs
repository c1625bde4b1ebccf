//! Mutated files of every kind that the program reads, each through the command that reads it.

use crate::binary::{ends, told_of};
use crate::random::Random;
use crate::{folder, mutate, text, watch};
use holonom::files::{Array, npz};
use serde_json::{Value, json};
use std::path::Path;
use std::process::Command;

/// A file and the command that reads it, both in a folder with the scenes that they need.
struct Kind {
    file: &'static str,
    bytes: Vec<u8>,
    command: &'static [&'static str],
}

fn shipped(name: &str) -> Vec<u8> {
    std::fs::read(folder().join(name)).unwrap()
}

fn import(name: &str) -> Vec<u8> {
    std::fs::read(Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/data/import").join(name)).unwrap()
}

fn scene(name: &str) -> Value {
    serde_json::from_slice(&shipped(name)).unwrap()
}

/// Nested lists of numbers as one array; a number has no shape.
fn array(lists: &Value) -> Array {
    let mut shape = Vec::new();
    let mut inner = lists;
    while let Some(list) = inner.as_array() {
        shape.push(list.len());
        inner = &list[0];
    }
    let mut values = Vec::new();
    collect(lists, &mut values);
    Array::Real { shape, values }
}

fn collect(lists: &Value, values: &mut Vec<f64>) {
    match lists.as_array() {
        Some(list) => list.iter().for_each(|inner| collect(inner, values)),
        None => values.push(lists.as_f64().unwrap()),
    }
}

/// The modes of a link, as arrays of NumPy.
fn modes(link: &Value) -> Vec<u8> {
    let lumped = link["lumped"].as_array().unwrap().clone();
    let (names, nodes): (Vec<String>, Vec<Value>) = link["nodes"].as_object().unwrap().clone().into_iter().unzip();
    let of = |list: &[Value], key: &str| array(&list.iter().map(|part| part[key].clone()).collect());
    let arrays = [
        ("modal_stiffness", array(&link["modal_stiffness"])),
        ("lumped_masses", of(&lumped, "mass")),
        ("lumped_positions", of(&lumped, "position")),
        ("lumped_translations", of(&lumped, "translation")),
        ("node_names", Array::Texts(names)),
        ("node_positions", of(&nodes, "position")),
        ("node_translations", of(&nodes, "translation")),
        ("node_rotations", of(&nodes, "rotation")),
    ];
    npz::write(&arrays).unwrap()
}

/// The kinds; the summary is that of a run of the pendulum, written into `place`.
fn kinds(place: &Path) -> Vec<Kind> {
    std::fs::write(place.join("pendulum.json"), shipped("pendulum.json")).unwrap();
    let mut run = Command::new(env!("CARGO_BIN_EXE_holonom"));
    run.args(["simulate", "pendulum.json", "--until", "0.01", "-o", "run", "--figures", "none", "--quiet"]);
    assert!(run.current_dir(place).status().unwrap().success());
    let summary = std::fs::read(place.join("run/summary.json")).unwrap();
    let link = scene("modal_link.json")["bodies"]
        .as_array()
        .unwrap()
        .iter()
        .find(|body| body["data"].is_object())
        .unwrap()["data"]
        .clone();
    vec![
        Kind {
            file: "data/rough_road.csv",
            bytes: shipped("data/rough_road.csv"),
            command: &["simulate", "half_car.json"],
        },
        Kind {
            file: "modes.json",
            bytes: serde_json::to_vec(&link).unwrap(),
            command: &["simulate", "modal_file.json"],
        },
        Kind { file: "modes.npz", bytes: modes(&link), command: &["simulate", "modal_npz.json"] },
        Kind { file: "robot.urdf", bytes: shipped("data/two_link.urdf"), command: &["import", "robot.urdf"] },
        Kind { file: "robot.urdf", bytes: import("rotor_without_mass.urdf"), command: &["import", "robot.urdf"] },
        Kind { file: "model.xml", bytes: import("four_bar.xml"), command: &["import", "model.xml"] },
        Kind {
            file: "summary.json",
            bytes: summary,
            command: &["simulate", "pendulum.json", "--start", "summary.json"],
        },
    ]
}

/// The scenes that the kinds name, in a folder of their own.
fn fill(place: &Path) {
    std::fs::create_dir_all(place.join("data")).unwrap();
    for name in ["half_car.json", "pendulum.json"] {
        std::fs::write(place.join(name), shipped(name)).unwrap();
    }
    for (name, file) in [("modal_file.json", "modes.json"), ("modal_npz.json", "modes.npz")] {
        let mut scene = scene("modal_link.json");
        for body in scene["bodies"].as_array_mut().unwrap() {
            let body = body.as_object_mut().unwrap();
            if body.remove("data").is_some() {
                body.insert("file".to_string(), json!(file));
            }
        }
        std::fs::write(place.join(name), scene.to_string()).unwrap();
    }
}

/// The bytes, changed as text or as bytes; JSON also by its values.
fn mutant(kind: &Kind, random: &mut Random) -> Vec<u8> {
    let mut bytes = kind.bytes.clone();
    if kind.file.ends_with(".json") && !random.is_one_in(3) {
        let mut value: Value = serde_json::from_slice(&bytes).unwrap();
        (0..random.one([1, 1, 2, 3])).for_each(|_| mutate::mutate(&mut value, random));
        return value.to_string().into_bytes();
    }
    (0..random.one([1, 1, 2, 4])).for_each(|_| bytes = text::damage(std::mem::take(&mut bytes), random));
    bytes
}

/// Writes the file and runs the command that reads it.
fn read(kind: &Kind, bytes: Vec<u8>, here: &Path) -> Result<i32, String> {
    fill(here);
    std::fs::write(here.join(kind.file), bytes).unwrap();
    let mut run = Command::new(env!("CARGO_BIN_EXE_holonom"));
    run.args(kind.command).current_dir(here);
    if kind.command[0] == "simulate" {
        run.args(["--until", "0.02", "--output-step", "0.001", "-o", "out"]);
    }
    ends(run, &here.join("out"))
}

fn try_files(numbers: std::ops::Range<u64>) {
    let place = tempfile::tempdir().unwrap();
    let kinds = kinds(place.path());
    for kind in &kinds {
        assert_eq!(read(kind, kind.bytes.clone(), &place.path().join("whole")), Ok(0), "{:?}", kind.command);
    }
    let numbers: Vec<u64> = numbers.collect();
    let codes = watch::each(&numbers, place.path(), |number, file| {
        let kind = &kinds[number as usize % kinds.len()];
        let bytes = mutant(kind, &mut Random::new(number));
        read(kind, bytes, &file.with_extension("folder"))
    });
    told_of(codes, numbers.len(), 16);
}

#[test]
fn the_program_survives_files_of_every_kind() {
    try_files(0..140);
}

#[test]
#[ignore = "takes minutes"]
fn the_program_survives_ten_thousand_files() {
    try_files(0..10_000);
}
