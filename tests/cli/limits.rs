//! What does not fit is refused before it is asked for.

use crate::cli::{PENDULUM, Place, err, out};
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
    assert_eq!(place.files("."), ["scene.json"]);
}

#[test]
fn linear_models_that_are_dense() {
    let place = chain();
    let pieces = ["dense matrices of 60000 x 60000", "the limit is ", "help: `holonom linearize --modes N`"];
    let commands: [&[&str]; 6] = [
        &["linearize", "scene.json"],
        &["linearize", "scene.json", "--method", "rcs"],
        &["transition", "scene.json", "--period", "0.001"],
        &["transition", "scene.json", "--lyapunov", "0.001"],
        &["validate", "scene.json", "--at", "0"],
        &["loci", "scene.json", "--every", "0.5"],
    ];
    commands.iter().for_each(|args| refused(&place, args, &pieces));
}

/// Under a limit of the address space, kB.
#[cfg(target_os = "linux")]
fn limited(place: &Place, kilobytes: u32, args: &[&str]) -> std::process::Output {
    let script = format!("ulimit -v {kilobytes}; exec \"$0\" \"$@\"");
    let mut command = std::process::Command::new("sh");
    command.args(["-c", &script, env!("CARGO_BIN_EXE_holonom")]).args(args);
    command.current_dir(place.path("")).env("HOLONOM_CLOCK", "readings").output().unwrap()
}

#[test]
#[cfg(target_os = "linux")]
fn more_rows_than_memory() {
    let place = chain();
    let output = limited(
        &place,
        4_000_000,
        &["simulate", "scene.json", "--until", "1e-4", "--output-step", "1e-7", "--format", "npz"],
    );
    let message = err(&output);
    assert_eq!(output.status.code(), Some(2), "{message}");
    let pieces = ["--output-step: 1001 rows of 160003 numbers take 7.7 GB", "the limit is ", "help: give a larger one"];
    pieces.iter().for_each(|piece| assert!(message.contains(piece), "{piece:?} not in {message}"));
}

/// Two hundred changed scenes are not in memory at once, and as many run at once as fit.
#[test]
#[cfg(target_os = "linux")]
fn extremes_of_a_large_scene() {
    let place = Place::new("");
    place.done(&["generate", "chain", "--n", "5000", "-o", "scene.json"]);
    // Typical times are those of a whole run.
    let short = place.text("scene.json").replace(r#""t_end": 1.0"#, r#""t_end": 1e-4"#);
    fs::write(place.path("scene.json"), short).unwrap();
    let few = ["--map", "mass", "--budget", "2ms", "--figures", "none", "-o", "here", "--quiet"];
    let output = limited(&place, 1_500_000, &[&["stress", "scene.json"], &few[..]].concat());
    assert!(output.status.success(), "{}", err(&output));
}

/// Of 25 000 equations a dense matrix takes 5 GB.
#[test]
#[cfg(target_os = "linux")]
fn the_equilibrium_of_a_large_scene() {
    let place = Place::new("");
    place.done(&["generate", "chain", "--n", "5000", "-o", "scene.json"]);
    let output = limited(&place, 1_500_000, &["check", "scene.json", "--static"]);
    assert!(output.status.success() && out(&output).contains("static equilibrium at t = 0 s"), "{}", err(&output));
}

/// What is written for each joint does not ask for the names of all.
#[test]
fn a_large_scene_is_checked() {
    let place = chain();
    let text = place.done(&["check", "scene.json"]);
    assert!(text.contains("60000 coordinates, 60000 velocities, 40000 constraints of rank 40000"), "{text}");
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

/// Text of 2 bytes a value would take 36 times its size.
#[test]
fn a_scene_of_too_many_values_is_refused() {
    let place = Place::new(format!("[0{}]", ",0".repeat(6_000_000)));
    let message = "scene.json: this has more than the 6 million values that are read";
    refused(&place, &["check", "scene.json"], &[message, "signals as CSV, modes as npz"]);
}

/// At 1e9 m a position is known to 1e-7 m: the tolerance is refused, and one that is a thousand times nearer is not.
#[test]
fn a_tolerance_below_the_rounding_of_positions_is_refused() {
    let at = |x: &str| {
        let far = PENDULUM.replace(r#""O": [0, 0]"#, &format!(r#""O": [{x}, 0]"#));
        far.replace(r#""position": [0.5, 0]"#, &format!(r#""position": [{x}.5, 0]"#))
    };
    let place = Place::new(at("1000000000"));
    let output = place.run(&["simulate", "scene.json"]);
    let message = err(&output);
    assert_eq!(output.status.code(), Some(2), "{message}");
    assert!(
        message.contains("coordinates of 1e9 are rounded by 4.4e-7 of the longest lever of the joints"),
        "{message}"
    );
    assert!(message.contains("put the origin near the mechanism"), "{message}");
    place.done(&["simulate", "scene.json", "--rtol", "1e-5", "--atol", "1e-5", "--quiet"]);
    Place::new(at("1000")).done(&["simulate", "scene.json", "--quiet"]);
}

#[test]
fn a_parameter_that_is_set_twice() {
    let place = Place::new(PENDULUM);
    let twice = ["check", "scene.json", "--set", "l=1", "--set", "l=2"];
    refused(&place, &twice, &["--set: the parameter `l` is set twice"]);
}

#[test]
fn more_threads_than_any_machine_has_cores() {
    let place = Place::new(PENDULUM);
    let run =
        |threads: &str| place.command(&["check", "scene.json"]).env("RAYON_NUM_THREADS", threads).output().unwrap();
    let output = run("100000");
    assert_eq!(output.status.code(), Some(2));
    assert!(err(&output).contains("RAYON_NUM_THREADS asks for 100000 threads"), "{}", err(&output));
    assert_eq!(run("3").status.code(), Some(0));
}
