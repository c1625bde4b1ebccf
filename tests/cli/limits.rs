//! What does not fit is refused before it is asked for.

use crate::{Place, err};
use serde_json::json;
use std::fs;

/// A body with `count` modes, each of unit stiffness.
fn modal(count: usize) -> String {
    let data = json!({ "mass": 1, "inertia": 1, "modal_stiffness": vec![1; count] });
    let body = json!({ "name": "plate", "type": "modal_body", "data": data });
    json!({ "name": "many", "dimension": 2, "bodies": [body], "simulation": { "t_end": 1 } }).to_string()
}

fn refused(place: &Place, args: &[&str], pieces: &[&str]) {
    let output = place.run(args);
    let message = err(&output);
    assert_eq!(output.status.code(), Some(2), "{args:?}: {message}");
    pieces.iter().for_each(|piece| assert!(message.contains(piece), "{args:?}: {piece:?} not in {message}"));
}

#[test]
fn a_body_of_too_many_modes() {
    let place = Place::new(modal(200_000));
    let matrices = "bodies[0].data.modal_stiffness (`plate`): this body takes dense matrices of 200000 x 200000";
    for command in ["check", "simulate"] {
        refused(&place, &[command, "scene.json"], &[matrices, " GB in all: the limit is ", "help: keep fewer modes"]);
    }
}

/// A chain of 60 000 velocities.
fn chain() -> Place {
    let place = Place::new("");
    place.done(&["generate", "chain", "--n", "20000", "-o", "scene.json"]);
    place
}

#[test]
fn methods_that_are_dense() {
    let place = chain();
    let size = "dense matrices of 60000 x 60000";
    let short = ["--until", "0.001", "--projection", "none", "-o", "here"];
    for formulation in ["null_space", "udwadia_kalaba"] {
        let args = [&["simulate", "scene.json", "--formulation", formulation, "--integrator", "dop853"], &short[..]];
        let pieces = ["--formulation: ", formulation, size, "the limit is ", "help: choose a sparse formulation"];
        refused(&place, &args.concat(), &pieces);
    }
    for (integrator, formulation, unknowns) in
        [("bdf", "ggl", "200"), ("tr_bdf2", "index1", "120"), ("esdirk34", "ggl", "")]
    {
        let args = ["simulate", "scene.json", "--formulation", formulation, "--integrator", integrator];
        let size = format!("dense matrices of {unknowns}");
        let pieces = ["--integrator: ", integrator, &size, "help: choose a sparse implicit integrator"];
        refused(&place, &[&args, &short[..]].concat(), &pieces);
    }
    assert_eq!(place.files("."), ["scene.json"]);
}

#[test]
fn linear_models_that_are_dense() {
    let place = chain();
    let pieces = ["dense matrices of 60000 x 60000", "the limit is ", "help: `holonom linearize --modes N`"];
    let commands: [&[&str]; 4] = [
        &["linearize", "scene.json"],
        &["linearize", "scene.json", "--method", "rcs"],
        &["transition", "scene.json", "--period", "0.001"],
        &["transition", "scene.json", "--lyapunov", "0.001"],
    ];
    commands.iter().for_each(|args| refused(&place, args, &pieces));
}

#[test]
#[cfg(unix)]
fn files_that_need_not_end() {
    let place = Place::new(modal(1));
    let made = std::process::Command::new("mkfifo").arg(place.path("pipe.json")).status().unwrap();
    assert!(made.success());
    let refusal = "this is a pipe or a device; name a regular file";
    for file in ["pipe.json", "/dev/zero"] {
        refused(&place, &["check", file], &[file, refusal]);
        refused(&place, &["tradeoff", "scene.json", "--reference", file], &[refusal]);
    }
    let body = json!({ "name": "plate", "type": "modal_body", "file": "pipe.json" });
    let scene = |file: &str| {
        let mut body = body.clone();
        body["file"] = file.into();
        json!({ "name": "beside", "dimension": 2, "bodies": [body], "simulation": { "t_end": 1 } }).to_string()
    };
    std::os::unix::fs::symlink(place.path("pipe.json"), place.path("pipe.npz")).unwrap();
    for file in ["pipe.json", "pipe.npz"] {
        fs::write(place.path("scene.json"), scene(file)).unwrap();
        refused(&place, &["check", "scene.json"], &["bodies[0].file (`plate`)", refusal]);
    }
}

#[test]
fn files_that_are_too_large() {
    let place = Place::new("");
    // Nothing is stored of what is not written.
    let file = fs::File::create(place.path("large.json")).unwrap();
    file.set_len(300_000_000).unwrap();
    refused(&place, &["check", "large.json"], &["large.json: this is larger than the 256 MB that are read"]);
}
