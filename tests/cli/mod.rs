//! The command line at work: what every command prints and writes, as DESIGN.md, sections 5 and 6, says.

mod auto;
mod check;
mod check_error;
mod controller;
mod drift;
mod equilibrium;
mod examples;
#[cfg(target_os = "linux")]
mod faults;
mod generate;
mod import;
#[cfg(unix)]
mod interrupted;
mod jumps;
mod kinematics;
mod limits;
mod linear;
mod loci;
mod methods;
mod origin;
mod plot;
mod reference;
mod restart;
mod schema;
mod simplify;
mod simulate;
mod singular;
mod stress;
mod study;
mod terminal;
mod tradeoff;
mod units;
mod view;
mod warnings;
mod words;

use serde_json::Value;
use std::fs;
use std::path::{Path, PathBuf};
use std::process::{Command, Output};
use tempfile::TempDir;

/// A pendulum that starts level.
const PENDULUM: &str = r#"{
  "name": "pendulum", "dimension": 2, "gravity": [0, -9.81],
  "ground": { "markers": { "O": [0, 0] } },
  "bodies": [
    { "name": "rod", "type": "rigid", "mass": 1, "inertia": "1/12", "markers": { "A": [-0.5, 0] },
      "initial": { "position": [0.5, 0], "angle": 0 } } ],
  "joints": [ { "name": "A", "type": "revolute", "between": ["ground.O", "rod.A"] } ],
  "forces": [ { "name": "push", "type": "applied_force", "at": "rod", "force": [0, 0] } ],
  "outputs": [
    { "name": "theta", "measure": "angle", "of": "rod" },
    { "name": "pin", "measure": "reaction", "of": "A" } ],
  "simulation": { "t_end": 1, "output_step": 0.1 }
}"#;

/// A beam on three parallel links: one constraint too many.
fn parallelogram() -> String {
    let link = |i: usize, x: f64| {
        format!(
            r#"{{ "name": "link{i}", "type": "rigid", "mass": 0.4, "inertia": 0.01, "origin": [0, 0.25],
               "markers": {{ "top": [0, 0], "end": [0, -0.5] }}, "initial": {{ "position": [{x}, 0], "angle": 0.5 }} }}"#
        )
    };
    let pins = |i: usize| {
        format!(
            r#"{{ "name": "top{i}", "type": "revolute", "between": ["ground.P{i}", "link{i}.top"] }},
               {{ "name": "end{i}", "type": "revolute", "between": ["link{i}.end", "beam.P{i}"] }}"#
        )
    };
    format!(
        r#"{{ "name": "parallelogram", "dimension": 2, "gravity": [0, -9.81],
            "ground": {{ "markers": {{ "P0": [0, 0], "P1": [0.5, 0], "P2": [1, 0] }} }},
            "bodies": [ {}, {}, {},
              {{ "name": "beam", "type": "rigid", "mass": 2, "inertia": 0.2,
                 "markers": {{ "P0": [-0.5, 0], "P1": [0, 0], "P2": [0.5, 0] }},
                 "initial": {{ "position": ["0.5 + 0.5*sin(0.5)", "-0.5*cos(0.5)"] }} }} ],
            "joints": [ {}, {}, {} ],
            "simulation": {{ "t_end": 0.5 }} }}"#,
        link(0, 0.0),
        link(1, 0.5),
        link(2, 1.0),
        pins(0),
        pins(1),
        pins(2)
    )
}

/// A folder with `scene.json` in it, where commands run.
struct Place(TempDir);

impl Place {
    fn new(scene: impl AsRef<str>) -> Self {
        let place = Place(tempfile::tempdir().unwrap());
        fs::write(place.path("scene.json"), scene.as_ref()).unwrap();
        place
    }

    fn path(&self, name: &str) -> PathBuf {
        self.0.path().join(name)
    }

    /// The program, of which budgets are counted in steps and rows, 10 000 for a second.
    fn command(&self, args: &[&str]) -> Command {
        let mut command = Command::new(env!("CARGO_BIN_EXE_holonom"));
        command.args(args).current_dir(self.0.path()).env("HOLONOM_CLOCK", "readings");
        command
    }

    fn run(&self, args: &[&str]) -> Output {
        let output = self.command(args).output().unwrap();
        assert!(!err(&output).contains("panicked"), "{}", err(&output));
        output
    }

    /// Runs what must succeed and returns standard output.
    fn done(&self, args: &[&str]) -> String {
        let output = self.run(args);
        assert_eq!(output.status.code(), Some(0), "{args:?}: {}", err(&output));
        out(&output)
    }

    fn text(&self, name: &str) -> String {
        fs::read_to_string(self.path(name)).unwrap_or_else(|error| panic!("{name}: {error}"))
    }

    fn json(&self, name: &str) -> Value {
        serde_json::from_str(&self.text(name)).unwrap()
    }

    /// Names of the files in a folder.
    fn files(&self, folder: &str) -> Vec<String> {
        files(&self.path(folder))
    }
}

fn files(folder: &Path) -> Vec<String> {
    let names = fs::read_dir(folder).unwrap().map(|entry| entry.unwrap().file_name().into_string().unwrap());
    let mut names: Vec<String> = names.collect();
    names.sort();
    names
}

fn out(output: &Output) -> String {
    String::from_utf8(output.stdout.clone()).unwrap()
}

fn err(output: &Output) -> String {
    String::from_utf8(output.stderr.clone()).unwrap()
}

fn keys(json: &Value) -> Vec<&str> {
    json.as_object().unwrap_or_else(|| panic!("no object: {json}")).keys().map(String::as_str).collect()
}

#[test]
fn help_and_version_are_no_errors() {
    let place = Place::new("");
    for args in [&["--help"][..], &["simulate", "--help"], &["check", "-h"], &["help", "drift"]] {
        assert!(place.done(args).contains("Usage: holonom"), "{args:?}");
    }
    let version = format!("holonom {} (features: cli figures npz urdf view)\n", env!("CARGO_PKG_VERSION"));
    assert_eq!(place.done(&["--version"]), version);
}

#[test]
fn a_reader_that_goes_away_is_no_error() {
    let place = Place::new(PENDULUM);
    for args in [&["schema"][..], &["generate", "chain", "--n", "2000"], &["simulate", "scene.json", "--json"]] {
        let mut child = place.command(args);
        let child = child.stdout(std::process::Stdio::piped()).stderr(std::process::Stdio::piped());
        let mut child = child.spawn().unwrap();
        drop(child.stdout.take());
        let output = child.wait_with_output().unwrap();
        assert_eq!((output.status.code(), err(&output).as_str()), (Some(0), ""), "{args:?}");
    }
}
