//! Through the program: where files are looked for, and what is refused.

use crate::modal_body::{modal, swing, write};
use serde_json::{Value, json};
use std::fs;
use std::path::Path;
use std::process::{Command, Output};
use tempfile::TempDir;

/// A scene whose modes are in a file beside it, both in the folder `below`.
fn place(change: impl FnOnce(&mut Value), file: &str) -> TempDir {
    let folder = tempfile::tempdir().unwrap();
    let below = folder.path().join("below");
    fs::create_dir(&below).unwrap();
    let mut scene = modal::<2>(&swing::<2>(), &below, file);
    change(&mut scene);
    write(&below, &scene);
    folder
}

fn holonom(folder: &Path, args: &[&str]) -> Output {
    Command::new(env!("CARGO_BIN_EXE_holonom")).args(args).current_dir(folder).output().unwrap()
}

fn done(folder: &Path, args: &[&str]) {
    let output = holonom(folder, args);
    assert_eq!(output.status.code(), Some(0), "{args:?}: {}", String::from_utf8_lossy(&output.stderr));
}

#[test]
fn files_are_looked_for_beside_the_scene() {
    for file in ["rod.json", "rod.npz"] {
        let folder = place(|_| (), file);
        let rest = ["-o", "out", "--quiet", "--figures", "none"];
        done(folder.path(), &["check", "below/scene.json"]);
        done(folder.path(), &[&["simulate", "below/scene.json", "--until", "0.02"], &rest[..]].concat());
        // From within, and from a folder beside it.
        done(&folder.path().join("below"), &["check", "scene.json"]);
        fs::create_dir(folder.path().join("beside")).unwrap();
        done(&folder.path().join("beside"), &["check", "../below/scene.json"]);
    }
}

#[test]
fn a_sweep_looks_there_too() {
    let drive = json!({ "name": "drive", "type": "driver", "between": ["ground.O", "rod.left"], "coordinate": "angle",
        "value": "angle" });
    let driven = |scene: &mut Value| scene["joints"].as_array_mut().unwrap().push(drive);
    let folder = place(driven, "rod.npz");
    done(
        folder.path(),
        &["kinematics", "below/scene.json", "angle=0..0.6:4", "-o", "out", "--quiet", "--figures", "none"],
    );
    assert_eq!(fs::read_to_string(folder.path().join("out/kinematics.csv")).unwrap().lines().count(), 5);
}

/// What the program says of the scene, from the file's name and place on.
fn refusal(folder: &TempDir) -> String {
    let output = holonom(folder.path(), &["simulate", "below/scene.json"]);
    let text = String::from_utf8(output.stderr).unwrap();
    assert_eq!(output.status.code(), Some(2), "{text}");
    assert!(output.stdout.is_empty() && !folder.path().join("out").exists());
    let (place, message) = text.split_once(": at ").unwrap_or_else(|| panic!("{text}"));
    assert!(place.starts_with("error: below/scene.json:"), "{text}");
    message.to_string()
}

#[test]
fn markers_lie_at_nodes() {
    let folder = place(|scene| scene["bodies"][0]["markers"]["tip"] = json!([1.4, 0]), "rod.json");
    assert_eq!(
        refusal(&folder),
        "bodies[0].markers (`rod`): there is no node at [1.4, 0], where a marker is\n  help: markers of a modal_body lie \
         at its nodes: left [0, 0], tip [1.5, 0]\n"
    );
}

#[test]
fn a_file_that_is_not_there() {
    let folder = place(|scene| scene["bodies"][0]["file"] = json!("rods.json"), "rod.json");
    let message = refusal(&folder);
    assert!(message.starts_with("bodies[0].file (`rod`): rods.json: "), "{message}");
}

/// The message for a planar body of these data.
fn of_data(data: Value) -> String {
    refusal(&place(
        |scene| {
            let rod = scene["bodies"][0].as_object_mut().unwrap();
            rod.remove("file");
            rod.insert("data".to_string(), data);
        },
        "rod.json",
    ))
}

#[test]
fn matrices_that_do_not_fit() {
    let message = of_data(json!({ "mass": 1, "inertia": 1, "modal_stiffness": [1, 2], "modal_mass": [1, 1, 1] }));
    assert_eq!(message, "bodies[0].data.modal_mass (`rod`): expected 2 numbers, found 3 numbers\n");
    let message = of_data(json!({ "mass": 1, "inertia": 1, "modal_stiffness": [[1, 0], [0, -2]] }));
    assert_eq!(
        message,
        "bodies[0].data.modal_stiffness (`rod`): the stiffness matrix has the eigenvalue -2, but must be positive\n  \
         help: leave out rigid-body modes: the body's frame has these motions already\n"
    );
}

#[test]
fn files_that_do_not_fit() {
    let folder = place(|_| (), "rod.json");
    let data = json!({ "mass": 1, "inertia": 1, "modal_stiffness": [-1] });
    fs::write(folder.path().join("below/rod.json"), data.to_string()).unwrap();
    assert_eq!(
        refusal(&folder),
        "bodies[0].file (`rod`): rod.json: at modal_stiffness: the stiffness matrix has the eigenvalue -1, but must be \
         positive\n  help: leave out rigid-body modes: the body's frame has these motions already\n"
    );
}
