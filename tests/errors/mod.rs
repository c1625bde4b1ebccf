//! Bad input, as a user meets it: every case ends with exit code 2 and one message that says where, what and how to
//! mend it; nothing is printed on standard output and nothing is written.

/// Scenes that are refused: `name: scene;`. The messages are in `messages/MODULE.txt`, under the names.
macro_rules! cases {
    ($($name:ident: $scene:expr;)*) => {
        #[test]
        fn all_messages_are_known() {
            crate::errors::refused_as(module_path!(), &[$((stringify!($name), || $scene)),*]);
        }
    };
}
mod command;
mod elements;
mod files;
mod keys;
mod measures;
mod options;
mod signals;
mod start;
mod text;

use std::fs;
use std::path::Path;
use std::process::{Command, Output};

const PENDULUM: &str = r#"{
  "name": "pendulum",
  "dimension": 2,
  "parameters": { "l": 1.0, "m": "2*l" },
  "gravity": [0, -9.81],
  "ground": { "markers": { "O": [0, 0], "P": [3, 0] } },
  "bodies": [
    { "name": "rod", "type": "rigid", "mass": "m", "inertia": "m*l^2/12",
      "markers": { "A": ["-l/2", 0], "B": ["l/2", 0] },
      "initial": { "position": [0.5, 0], "angle": 0 } }
  ],
  "joints": [
    { "name": "pin", "type": "revolute", "between": ["ground.O", "rod.A"] }
  ],
  "forces": [
    { "name": "spring", "type": "spring_damper", "between": ["ground.P", "rod.B"], "stiffness": 10, "free_length": 2 }
  ],
  "inputs": [],
  "outputs": [ { "name": "theta", "measure": "angle", "of": "rod" } ],
  "assembly": { "hold": [] },
  "simulation": { "t_end": 0.1, "output_step": 0.05 }
}
"#;

const TOP: &str = r#"{
  "name": "top",
  "dimension": 3,
  "gravity": [0, 0, -9.81],
  "ground": { "markers": { "O": [0, 0, 0] } },
  "bodies": [
    { "name": "top", "type": "rigid", "mass": 1, "inertia": [1, 1, 0.5],
      "markers": { "tip": [0, 0, -1] },
      "initial": { "position": [0, 0, 1], "rotation": [0.1, 0, 0], "angular_velocity": [0, 0, 5] } }
  ],
  "joints": [ { "name": "tip", "type": "spherical", "between": ["ground.O", "top.tip"] } ],
  "forces": [],
  "simulation": { "t_end": 0.1 }
}
"#;

const PIN: &str = r#"{ "name": "pin", "type": "revolute", "between": ["ground.O", "rod.A"] }"#;
const SPRING: &str = r#"{ "name": "spring", "type": "spring_damper", "between": ["ground.P", "rod.B"], "stiffness": 10, "free_length": 2 }"#;

/// The messages of a module, in which each has its name as a heading.
type Cases<'c> = &'c [(&'static str, fn() -> Scene)];

/// Simulates all scenes and compares the messages with the known ones. With HOLONOM_MESSAGES=write these are replaced.
fn refused_as(module: &str, cases: Cases) {
    let name = module.rsplit("::").next().unwrap();
    let path = format!("{}/tests/errors/messages/{name}.txt", env!("CARGO_MANIFEST_DIR"));
    let messages = |cases: Cases| -> Vec<String> {
        cases.iter().map(|(name, scene)| format!("## {name}\n{}", scene().message().trim_end())).collect()
    };
    let found: Vec<String> = std::thread::scope(|scope| {
        let parts = cases.chunks(cases.len().div_ceil(8)).map(|part| scope.spawn(move || messages(part)));
        let parts: Vec<_> = parts.collect();
        parts.into_iter().flat_map(|part| part.join().unwrap()).collect()
    });
    let all = found.join("\n\n") + "\n";
    if std::env::var_os("HOLONOM_MESSAGES").is_some_and(|what| what == "write") {
        fs::write(&path, &all).unwrap();
    }
    let known = fs::read_to_string(&path).unwrap();
    found.iter().for_each(|message| assert!(known.contains(message), "{path} does not have\n{message}"));
    assert_eq!(all, known, "{path} has a case that is gone, or another order");
}

/// A scene file and the rest of the command line.
struct Scene {
    text: Vec<u8>,
    args: Vec<String>,
}

fn pendulum() -> Scene {
    scene(PENDULUM)
}

fn top() -> Scene {
    scene(TOP)
}

fn scene(text: impl Into<Vec<u8>>) -> Scene {
    Scene { text: text.into(), args: Vec::new() }
}

/// JSON written with single quotes, so that it can be read here; ´ is a single quote itself.
fn json(text: &str) -> String {
    text.replace('\'', "\"").replace('´', "'")
}

impl Scene {
    /// Puts `to` in the place of the first `from`.
    fn with(mut self, from: &str, to: &str) -> Self {
        let text = String::from_utf8(self.text).unwrap();
        assert!(text.contains(&json(from)), "{from} is not in the scene");
        self.text = text.replacen(&json(from), &json(to), 1).into_bytes();
        self
    }

    /// Another joint in the place of the pin.
    fn joint(self, joint: &str) -> Self {
        self.with(PIN, joint)
    }

    /// A joint beside the pin.
    fn and_joint(self, joint: &str) -> Self {
        self.with(PIN, &format!("{PIN}, {joint}"))
    }

    /// Another force in the place of the spring.
    fn force(self, force: &str) -> Self {
        self.with(SPRING, force)
    }

    fn args(mut self, args: &[&str]) -> Self {
        self.args.extend(args.iter().map(|arg| arg.to_string()));
        self
    }

    fn refused_with(self, pieces: &[&str]) {
        has_pieces(&self.message(), pieces);
    }

    /// Simulates the scene, which is refused, and returns the message.
    fn message(self) -> String {
        let folder = tempfile::tempdir().unwrap();
        fs::write(folder.path().join("scene.json"), &self.text).unwrap();
        let args: Vec<&str> =
            ["simulate", "scene.json"].into_iter().chain(self.args.iter().map(String::as_str)).collect();
        message(folder.path(), &args)
    }
}

/// Runs `holonom` in `folder`, which refuses with all of `pieces` in the message, in their order.
fn refused(folder: &Path, args: &[&str], pieces: &[&str]) {
    has_pieces(&message(folder, args), pieces);
}

fn has_pieces(message: &str, pieces: &[&str]) {
    let mut rest = message;
    for piece in pieces {
        let at = rest.find(piece).unwrap_or_else(|| panic!("no `{piece}` in\n{message}"));
        rest = &rest[at + piece.len()..];
    }
}

/// Runs `holonom` in `folder`, checks that it refuses and leaves everything as it was, and returns what it says.
fn message(folder: &Path, args: &[&str]) -> String {
    let before = listing(folder);
    let Output { status, stdout, stderr } =
        Command::new(env!("CARGO_BIN_EXE_holonom")).args(args).current_dir(folder).output().unwrap();
    let stderr = String::from_utf8(stderr).unwrap();
    assert_eq!(status.code(), Some(2), "{stderr}");
    assert!(stdout.is_empty(), "standard output: {}", String::from_utf8_lossy(&stdout));
    assert!(!stderr.contains("panicked") && stderr.starts_with("error: "), "{stderr}");
    assert_eq!(listing(folder), before, "files were written or removed");
    stderr
}

/// Names and contents of all files below a folder.
fn listing(folder: &Path) -> Vec<(String, Vec<u8>)> {
    let mut all = Vec::new();
    for entry in fs::read_dir(folder).unwrap() {
        let path = entry.unwrap().path();
        let contents = if path.is_dir() { Vec::new() } else { fs::read(&path).unwrap() };
        all.push((path.display().to_string(), contents));
        if path.is_dir() {
            all.extend(listing(&path));
        }
    }
    all.sort();
    all
}

#[test]
fn the_scenes_themselves_are_fine() {
    for scene in [pendulum(), top()] {
        let folder = tempfile::tempdir().unwrap();
        fs::write(folder.path().join("scene.json"), &scene.text).unwrap();
        let mut command = Command::new(env!("CARGO_BIN_EXE_holonom"));
        let output = command.args(["check", "scene.json"]).current_dir(folder.path()).output().unwrap();
        assert_eq!((output.status.code(), output.stderr), (Some(0), Vec::new()));
    }
}

#[test]
fn a_whole_message() {
    let folder = tempfile::tempdir().unwrap();
    fs::write(folder.path().join("scene.json"), pendulum().with("'stiffness'", "'stifness'").text).unwrap();
    let mut command = Command::new(env!("CARGO_BIN_EXE_holonom"));
    let output = command.args(["simulate", "scene.json"]).current_dir(folder.path()).output().unwrap();
    let expected = "error: scene.json:16:96: at forces[0].stifness (`spring`): unknown key `stifness`\n  \
                    help: did you mean `stiffness`?\n";
    assert_eq!(String::from_utf8(output.stderr).unwrap(), expected);
}
