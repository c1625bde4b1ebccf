//! A system call that fails, whichever it is, leaves the results of before.
//!
//! `cargo test --release --test program faults -- --ignored`: strace lets the calls fail.

use crate::cli::{PENDULUM, Place, err};
use std::collections::BTreeMap;
use std::path::Path;
use std::process::Command;

/// More calls of one kind than a command makes for its results.
const MOST: usize = 60;

/// Files and folders with what they hold.
fn snapshot(folder: &Path) -> BTreeMap<String, Vec<u8>> {
    let mut found = BTreeMap::new();
    for path in std::fs::read_dir(folder).unwrap().map(|entry| entry.unwrap().path()) {
        let name = path.file_name().unwrap().to_string_lossy().into_owned();
        found.insert(name, std::fs::read(&path).unwrap_or_default());
    }
    found
}

/// The number of calls that failed one after the other, each in a run of its own, until one had no such call.
fn failed(command: &[&str], calls: &str, error: &str) -> usize {
    for number in 1..MOST {
        let place = Place::new(PENDULUM);
        place.done(&[command, &["-o", "here"]].concat());
        let before = snapshot(&place.path("here"));
        std::fs::write(place.path("scene.json"), PENDULUM.replace("-9.81", "-9.9")).unwrap();
        let mut run = Command::new("strace");
        run.args(["-f", "-qq", "-o", "/dev/null", "-e", &format!("trace={calls}")]);
        run.args(["-e", &format!("inject={calls}:error={error}:when={number}")]);
        run.arg(env!("CARGO_BIN_EXE_holonom")).args(command).args(["-o", "here"]);
        let output = run.current_dir(place.path(".")).output().expect("strace");
        if output.status.success() {
            return number - 1;
        }
        assert!(!err(&output).contains("panicked"), "{command:?}, {calls} {number}: {}", err(&output));
        assert!(snapshot(&place.path("here")) == before, "{command:?}, {calls} {number}: {}", err(&output));
    }
    panic!("{command:?} never ends well");
}

#[test]
#[ignore = "needs strace"]
fn every_call_may_fail() {
    let commands: [&[&str]; 3] = [
        &["simulate", "scene.json", "--until", "0.1", "--format", "csv,npz,mat", "--quiet"],
        &["drift", "scene.json", "--until", "0.05", "--quiet"],
        &["linearize", "scene.json", "--quiet"],
    ];
    for command in commands {
        for (calls, error) in [("write", "ENOSPC"), ("fsync", "EIO"), ("rename,renameat,renameat2", "EIO")] {
            assert!(failed(command, calls, error) >= 3, "{command:?}: {calls}");
        }
    }
}
