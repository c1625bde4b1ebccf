//! Folders of results say where they come from, and what a later run replaces.

use super::*;

/// Every command that writes results, with its file.
const COMMANDS: [(&[&str], &str); 13] = [
    (&["simulate"], "summary.json"),
    (&["drift"], "stabilizations.json"),
    (&["kinematics", "l=1..2:3"], "kinematics.json"),
    (&["study", "--vary", "a=0..1:2", "--record", "rod.angle"], "study.json"),
    (&["tradeoff", "--integrator", "rk4", "--digits", "3", "--rows", "3", "--budget", "1s"], "tradeoff.json"),
    (&["tradeoff", "--variants", "scene.json:l=1", "--repeats", "1"], "models.json"),
    (&["stress", "--map", "time", "--limit", "0.01"], "stress.json"),
    (&["plot", "--stroboscope"], "stroboscope.json"),
    (&["linearize"], "linear-0.json"),
    (&["loci", "--every", "0.5"], "loci.json"),
    (&["bode"], "bode-0.json"),
    (&["validate"], "validation-0.json"),
    (&["transition", "--lyapunov", "0.5"], "transition-0.json"),
];

fn scene() -> String {
    let inputs = r#""inputs": [ { "name": "push", "force": "push", "component": "x" } ], "outputs": "#;
    PENDULUM.replace(r#""gravity""#, r#""parameters": { "l": 1, "a": 0 }, "gravity""#).replace(r#""outputs": "#, inputs)
}

#[test]
fn every_command_says_how_to_repeat_it() {
    let place = Place::new(scene());
    for (command, file) in COMMANDS {
        let more = ["--set", "l=1.5", "--quiet", "-o", "here"];
        let more = if command[0] == "kinematics" { &more[2..] } else { &more[..] };
        let args = [&command[..1], &["scene.json"], &command[1..], more].concat();
        let code = place.run(&args).status.code();
        assert!(code == Some(0) || command[0] == "tradeoff", "{args:?}");
        let json = place.json(&format!("here/{file}"));
        assert_eq!(json["holonom"], env!("CARGO_PKG_VERSION"), "{file}");
        assert_eq!(json["command"].as_array().unwrap()[1..], *args, "{file}");
        assert_eq!(json["parameters"]["l"].as_f64(), Some(if more.len() == 5 { 1.5 } else { 1.0 }), "{file}");
        assert!(json["warnings"].is_array(), "{file}");
        let files = json["files"].as_array().unwrap();
        assert_eq!(files.last().unwrap(), file);
        files.iter().for_each(|name| assert!(place.path("here").join(name.as_str().unwrap()).is_file(), "{name}"));
        let method = if json["method"].is_object() { &json["method"] } else { &json["simulation"] };
        let is_named = method["integrator"] == "dop853";
        assert!(is_named || ["kinematics.json", "tradeoff.json"].contains(&file), "{file}: {method}");
    }
}

#[test]
fn what_is_replaced_is_said_where_settings_differ() {
    let place = Place::new(scene());
    let run = |more: &[&str]| err(&place.run(&[&["simulate", "scene.json"], more].concat()));
    assert_eq!(run(&["--rtol", "1e-6"]), "");
    assert_eq!(run(&["--rtol", "1e-6", "--json"]), "", "the same run again");
    assert_eq!(run(&["--figures", "svg", "--rtol", "1e-6", "-o=out/pendulum"]), "", "and again");
    assert_eq!(
        run(&["--set", "l=2"]),
        "note: replaced in out/pendulum the results of `holonom simulate scene.json --rtol 1e-6` \
         (l was 1, rtol was 1e-6, atol was 1e-8); -o DIR keeps both\n"
    );
    assert_eq!(run(&["--quiet"]), "");
    assert_eq!(run(&["-o", "elsewhere"]), "");
    let told = "note: replaced in elsewhere the results of `holonom simulate scene.json`; -o DIR keeps both\n";
    assert_eq!(run(&["-o", "elsewhere", "--until", "0.5"]), told);
}

#[test]
fn files_of_an_earlier_run_do_not_stay_beside_a_newer_one() {
    let place = Place::new(scene());
    place.done(&["simulate", "scene.json", "-o", "here"]);
    fs::write(place.path("here/notes.txt"), "mine").unwrap();
    let output = place.run(&["simulate", "scene.json", "-o", "here", "--format", "npz", "--figures", "none"]);
    let gone = "trajectory.csv, outputs.svg, drift.svg, energy.svg";
    assert_eq!(err(&output), format!("note: in here: removed {gone} of an earlier run\n"));
    assert_eq!(place.files("here"), ["drift.csv", "energy.csv", "notes.txt", "summary.json", "trajectory.npz"]);
    // Names that lead elsewhere are nobody's results.
    let text = place.text("here/summary.json").replace("\"energy.csv\"", "\"../scene.json\"");
    fs::write(place.path("here/summary.json"), text).unwrap();
    place.done(&["simulate", "scene.json", "-o", "here"]);
    assert!(place.path("scene.json").exists());
}

#[test]
fn warnings_are_in_every_file() {
    let place = Place::new(scene().replace(r#""position": [0.5, 0]"#, r#""position": [0.5, 5]"#));
    place.done(&["linearize", "scene.json", "-o", "here", "--quiet"]);
    let warnings = place.json("here/linear-0.json")["warnings"].clone();
    assert!(warnings[0].as_str().unwrap().starts_with("assembly turned `rod` by "), "{warnings}");
}

#[test]
fn a_finished_run_is_drawn() {
    let place = Place::new(scene());
    for format in ["csv", "npz"] {
        place.done(&["simulate", "scene.json", "--format", format, "--set", "l=3", "-o", format, "--quiet"]);
        let from =
            ["plot", "scene.json", "--from", format, "-o", "drawn", "--outputs", "--figures", "png", "--at", "0.3"];
        assert!(place.done(&from).starts_with("pendulum at t = 0.3 s\n"));
        assert_eq!(place.json("drawn/mechanism.json")["parameters"]["l"], 3.0);
        assert_eq!(place.files("drawn"), ["mechanism.json", "mechanism.png", "plot-outputs.json", "plot-outputs.png"]);
    }
    // What is drawn is what a run of its own draws, at times of rows to the last digit.
    let svg = |more: &[&str]| {
        place.done(&[&["plot", "scene.json", "--at", "0.5", "-o", "svg", "--quiet"], more].concat());
        place.text("svg/mechanism.svg")
    };
    assert_eq!(svg(&["--from", "csv/summary.json"]), svg(&["--output-step", "0.1"]));
    // Ten rows a second are close enough; two are not.
    assert_eq!(err(&place.run(&["plot", "scene.json", "--from", "csv", "--stroboscope"])), "");
    place.done(&["simulate", "scene.json", "--output-step", "0.5", "-o", "rare", "--quiet"]);
    let output = place.run(&["plot", "scene.json", "--from", "rare", "--stroboscope", "-o", "drawn"]);
    assert!(err(&output).starts_with("warning: rows at t = 0.5 s are too far apart to draw"), "{}", err(&output));
}

#[test]
fn what_is_no_run_of_the_scene_is_refused() {
    let place = Place::new(scene());
    place.done(&["simulate", "scene.json", "--outputs-only", "-o", "few", "--quiet"]);
    place.done(&["simulate", "scene.json", "--format", "mat", "-o", "mat", "--quiet"]);
    place.done(&["plot", "scene.json", "--from", "few", "--outputs", "-o", "drawn"]);
    fs::write(place.path("other.json"), scene().replace("theta", "phi")).unwrap();
    fs::write(place.path("renamed.json"), scene().replace(r#""l""#, r#""ll""#)).unwrap();
    let cases: [(&[&str], &str); 7] = [
        (&["scene.json", "--from", "few", "--at", "0.5"], "the coordinates were left out of this run"),
        (&["scene.json", "--from", "mat", "--at", "0.5"], "no trajectory that is read\n  help: simulate again with"),
        (&["renamed.json", "--from", "few", "--outputs"], "at --from (`l`): unknown parameter"),
        (&["scene.json", "--from", "none"], "help: name the folder that `holonom simulate` has written"),
        (&["scene.json", "--from", "scene.json"], "it is no summary of a run"),
        (&["other.json", "--from", "few", "--outputs"], "of another scene: they do not share the column `theta`"),
        (&["scene.json", "--from", "few", "--rtol", "1e-3"], "cannot be used with"),
    ];
    for (args, message) in cases {
        let output = place.run(&[&["plot"], args].concat());
        assert!(output.status.code() == Some(2) && err(&output).contains(message), "{args:?}: {}", err(&output));
    }
}

/// A summary that somebody else has written makes no command remove what holonom has not written.
#[test]
fn a_planted_summary_removes_no_file_of_others() {
    let place = Place::new(scene());
    fs::create_dir(place.path("here")).unwrap();
    let others = ["thesis.tex", "data.csv", "run.json"];
    others.iter().for_each(|name| fs::write(place.path("here").join(name), "mine").unwrap());
    fs::write(place.path("here/energy.png"), "of an earlier run").unwrap();
    let files = ["thesis.tex", "data.csv", "run.json", "energy.png", "../scene.json", "summary.json"];
    let planted = serde_json::json!({ "holonom": "0", "command": ["x"], "parameters": {}, "files": files });
    fs::write(place.path("here/summary.json"), planted.to_string()).unwrap();
    place.done(&["simulate", "scene.json", "--quiet", "-o", "here"]);
    others.iter().for_each(|name| assert_eq!(place.text(&format!("here/{name}")), "mine"));
    assert!(!place.path("here/energy.png").exists());
}
