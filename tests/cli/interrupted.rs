//! Runs that are interrupted, killed or find the disk full leave whole files or none.

use crate::cli::{PENDULUM, Place, err, out};
use serde_json::Value;
use std::fs;
use std::os::unix::process::ExitStatusExt;
use std::path::Path;
use std::process::{Child, Command, Output, Stdio};
use std::time::{Duration, Instant};

/// Hours of computing, with few rows.
const ENDLESS: [&str; 6] = ["scene.json", "--until", "1e9", "--output-step", "1e3", "-o"];
/// 50 000 rows: less to compute than to write.
const MUCH: [&str; 8] = ["simulate", "scene.json", "--until", "5", "--output-step", "1e-4", "-o", "here"];

fn start(place: &Place, args: &[&str]) -> Child {
    place.command(args).stdout(Stdio::piped()).stderr(Stdio::piped()).spawn().unwrap()
}

fn signal(child: &Child, name: &str) {
    let status = Command::new("kill").args(["-s", name, &child.id().to_string()]).status();
    assert!(status.is_ok(), "{status:?}");
}

/// Whether this process, and so ours, has HUP ignored, as nohup does.
fn is_sheltered() -> bool {
    let status = fs::read_to_string("/proc/self/status").unwrap_or_default();
    let mask = status.lines().find_map(|line| line.strip_prefix("SigIgn:"));
    mask.and_then(|mask| u64::from_str_radix(mask.trim(), 16).ok()).unwrap_or(0) & 1 != 0
}

/// Waits until the run steps: it listens by then.
fn interrupted(place: &Place, args: &[&str], with: &str) -> Output {
    end(start(place, args), with)
}

fn end(child: Child, with: &str) -> Output {
    std::thread::sleep(Duration::from_millis(500));
    signal(&child, with);
    let clock = Instant::now();
    let output = child.wait_with_output().unwrap();
    assert!(clock.elapsed() < Duration::from_secs(5), "it ended after {:?}", clock.elapsed());
    output
}

#[test]
fn an_interrupted_run_writes_what_it_has() {
    let signals = if is_sheltered() { &["INT", "TERM"][..] } else { &["INT", "TERM", "HUP"] };
    for with in signals {
        let place = Place::new(PENDULUM);
        let output = interrupted(&place, &[&["simulate"], &ENDLESS[..], &["here"]].concat(), with);
        let message = err(&output);
        assert_eq!(output.status.code(), Some(1), "{message}");
        for piece in ["error: stopped at t = ", ": interrupted\n", "what was computed until then is in here"] {
            assert!(message.contains(piece), "{message}");
        }
        assert!(out(&output).contains("written to here: trajectory.csv"), "{}", out(&output));
        assert_whole(&place.path("here"));
        let summary = place.json("here/summary.json");
        assert_eq!((&summary["status"], &summary["failure"]["reason"]), (&"failed".into(), &"interrupted".into()));
        assert!(summary["t_end"].as_f64().unwrap() > 0.0);
    }
}

/// Starts with signals ignored, as nohup and the background of a script have them.
fn start_ignoring(place: &Place, ignored: &str, args: &[&str]) -> Child {
    let script = format!("trap '' {ignored}; exec \"$0\" \"$@\"");
    let mut command = Command::new("sh");
    command.args(["-c", &script, env!("CARGO_BIN_EXE_holonom")]).args(args).current_dir(place.path(""));
    command.stdout(Stdio::piped()).stderr(Stdio::piped()).spawn().unwrap()
}

#[test]
fn signals_are_heard_under_nohup_and_in_the_background() {
    for (ignored, with) in [("HUP", "TERM"), ("HUP", "INT"), ("INT QUIT", "INT"), ("INT QUIT HUP", "TERM")] {
        let place = Place::new(PENDULUM);
        let child = start_ignoring(&place, ignored, &[&["simulate"], &ENDLESS[..], &["here"]].concat());
        let output = end(child, with);
        let message = err(&output);
        assert_eq!(output.status.code(), Some(1), "{ignored}, {with}: {message}");
        assert!(message.contains(": interrupted\n"), "{message}");
        assert_eq!(place.json("here/summary.json")["status"], "failed");
    }
}

/// As in a terminal: what writes nothing before its end ends at once.
#[test]
fn every_command_hears_signals_in_the_background() {
    let commands: [&[&str]; 2] = [
        &["validate", "scene.json", "--horizon", "1e6", "-o", "here"],
        &["transition", "scene.json", "--lyapunov", "1e6", "-o", "here"],
    ];
    for args in commands {
        let place = Place::new(PENDULUM);
        let output = end(start_ignoring(&place, "INT QUIT HUP", args), "INT");
        assert_eq!((output.status.code(), err(&output).as_str()), (Some(130), "interrupted\n"), "{args:?}");
    }
}

#[test]
#[cfg(target_os = "linux")]
fn nohup_keeps_a_run_from_hanging_up() {
    let place = Place::new(PENDULUM);
    let mut child = start_ignoring(&place, "HUP", &[&["simulate"], &ENDLESS[..], &["here"]].concat());
    std::thread::sleep(Duration::from_millis(500));
    signal(&child, "HUP");
    std::thread::sleep(Duration::from_millis(300));
    assert_eq!(child.try_wait().unwrap(), None);
    assert_eq!(end(child, "TERM").status.code(), Some(1));
}

#[test]
fn all_stabilizations_are_interrupted_together() {
    let place = Place::new(PENDULUM);
    let output = interrupted(&place, &[&["drift"], &ENDLESS[..], &["here"]].concat(), "INT");
    assert_eq!(output.status.code(), Some(1), "{}", err(&output));
    assert!(err(&output).contains(": interrupted\n"), "{}", err(&output));
    assert_whole(&place.path("here"));
}

/// What cannot end by itself ends at once, with nothing written.
#[test]
fn an_interrupted_command_that_has_no_part_of_a_result_writes_none() {
    let place = Place::new(PENDULUM);
    let output = interrupted(&place, &["validate", "scene.json", "--horizon", "1e6", "-o", "here"], "INT");
    assert_eq!((output.status.code(), err(&output).as_str()), (Some(130), "interrupted\n"));
    assert_eq!(place.files("here"), [""; 0]);
}

/// The second signal does not wait for anything.
#[test]
fn the_second_signal_ends_at_once() {
    let place = Place::new(PENDULUM);
    // Between two signals so near to each other 300 000 rows cannot be written, but on a busy machine they may be.
    let ends_at_once = || {
        let _ = fs::remove_dir_all(place.path("here"));
        let mut child = start(&place, &MUCH.map(|word| if word == "5" { "30" } else { word }));
        std::thread::sleep(Duration::from_millis(300));
        while child.try_wait().unwrap().is_none() {
            signal(&child, "INT");
            std::thread::sleep(Duration::from_millis(5));
        }
        let output = child.wait_with_output().unwrap();
        output.status.code() == Some(130) && err(&output).ends_with("interrupted\n")
    };
    assert!((0..5).any(|_| ends_at_once()));
    assert!(!place.path("here/summary.json").exists());
}

/// A deterministic spread of moments: fractions of the golden ratio.
fn moments(count: u32) -> impl Iterator<Item = f64> {
    (1..=count).map(|k| (f64::from(k) * 0.618_033_988_749_895).fract())
}

fn hidden(folder: &Path) -> Vec<std::path::PathBuf> {
    let entries = fs::read_dir(folder).into_iter().flatten().flatten().map(|entry| entry.path());
    entries.filter(|path| path.file_name().unwrap().to_string_lossy().starts_with('.')).collect()
}

#[test]
fn a_killed_run_leaves_whole_files() {
    let place = Place::new(PENDULUM);
    place.done(&["simulate", "scene.json", "-o", "here", "--quiet"]);
    let old = place.json("here/summary.json");
    let clock = Instant::now();
    place.done(&[&MUCH[..7], &["timed"]].concat());
    let usual = clock.elapsed();
    let (mut before, mut after, mut left) = (0, 0, 0);
    for part in moments(25) {
        let mut child = start(&place, &MUCH);
        // Beyond the usual time too, so that some runs come to their end.
        std::thread::sleep(usual.mul_f64(1.2 * part));
        child.kill().unwrap();
        child.wait().unwrap();
        left += usize::from(!hidden(&place.path("here")).is_empty());
        assert_whole(&place.path("here"));
        match place.path("here/summary.json").exists().then(|| place.json("here/summary.json")) {
            Some(summary) if summary["t_end"] == old["t_end"] => before += 1,
            Some(_) => after += 1,
            // Within the renames.
            None => {}
        }
        fs::remove_dir_all(place.path("here")).unwrap();
        place.done(&["simulate", "scene.json", "-o", "here", "--quiet"]);
    }
    assert!(before >= 5, "{before} killed before, {after} after the end, {left} left something behind");
}

#[test]
fn what_a_killed_run_left_behind_is_removed() {
    let place = Place::new(PENDULUM);
    let folder = place.path("here");
    // The middle of writing is where the hidden folder is.
    let is_caught = (0..20).any(|_| {
        let mut child = start(&place, &MUCH);
        while child.try_wait().unwrap().is_none() && !hidden(&folder).iter().any(|path| path.join("drift.csv").exists())
        {
            std::thread::sleep(Duration::from_micros(200));
        }
        child.kill().unwrap();
        child.wait().unwrap();
        !hidden(&folder).is_empty()
    });
    assert!(is_caught && !folder.join("summary.json").exists());
    place.done(&["simulate", "scene.json", "-o", "here", "--quiet"]);
    assert_eq!(hidden(&folder), [""; 0].map(std::path::PathBuf::from));
    assert_whole(&folder);
}

/// A shell's limit on the size of files, in blocks of 512 or 1024 bytes, stands for a full disk.
fn limited(place: &Place, trap: &str) -> Output {
    let script = format!("{trap} ulimit -f 64; exec \"$0\" \"$@\"");
    let mut command = Command::new("sh");
    command.args(["-c", &script, env!("CARGO_BIN_EXE_holonom")]).args(MUCH).current_dir(place.path(""));
    command.output().unwrap()
}

#[test]
fn where_the_disk_is_full_nothing_is_written() {
    let place = Place::new(PENDULUM);
    place.done(&["simulate", "scene.json", "-o", "here", "--quiet"]);
    let (old, files) = (place.text("here/summary.json"), place.files("here"));
    let output = limited(&place, "trap '' XFSZ;");
    let message = err(&output);
    assert_eq!(output.status.code(), Some(1), "{message}");
    for piece in ["error: here/trajectory.csv: nothing was written: ", "choose another place with -o"] {
        assert!(message.contains(piece), "{message}");
    }
    assert_eq!((place.text("here/summary.json"), place.files("here")), (old, files));
    // Without the trap the system kills it.
    let output = limited(&place, "");
    assert!(output.status.signal().is_some() || output.status.code().is_some_and(|code| code > 128));
    assert_whole(&place.path("here"));
    assert_eq!(place.json("here/summary.json")["t_end"], 1.0);
}

#[test]
#[cfg(target_os = "linux")]
fn a_full_device_is_told() {
    let place = Place::new(PENDULUM);
    let output = place.run(&["generate", "chain", "-o", "/dev/full"]);
    assert_eq!(output.status.code(), Some(1));
    assert!(
        err(&output).starts_with("error: /dev/full: cannot write: the disk is full; make room, or"),
        "{}",
        err(&output)
    );
    let full = fs::OpenOptions::new().write(true).open("/dev/full").unwrap();
    let output = place.command(&["simulate", "scene.json", "-o", "here"]).stdout(full).output().unwrap();
    assert_eq!(output.status.code(), Some(1));
    assert!(err(&output).starts_with("error: standard output: "), "{}", err(&output));
    // The files were written before.
    assert_whole(&place.path("here"));
}

/// Every file that is seen is whole, and those that a summary vouches for are of one run.
fn assert_whole(folder: &Path) {
    for entry in fs::read_dir(folder).unwrap().map(|entry| entry.unwrap().path()).filter(|path| path.is_file()) {
        let text = fs::read_to_string(&entry).unwrap();
        let is_whole = match entry.extension().unwrap().to_str().unwrap() {
            // Rows of unequal width are errors.
            "csv" => text.ends_with('\n') && csv::Reader::from_reader(text.as_bytes()).records().all(|row| row.is_ok()),
            "json" => serde_json::from_str::<Value>(&text).is_ok(),
            "svg" => text.trim_end().ends_with("</svg>"),
            other => panic!("{other}"),
        };
        assert!(is_whole, "{} of {} bytes", entry.display(), text.len());
    }
    let Ok(summary) = fs::read_to_string(folder.join("summary.json")) else { return };
    let end = serde_json::from_str::<Value>(&summary).unwrap()["t_end"].as_f64().unwrap();
    for name in ["trajectory.csv", "drift.csv", "energy.csv"] {
        let rows = fs::read_to_string(folder.join(name)).unwrap();
        let last: f64 = rows.lines().last().unwrap().split(',').next().unwrap().parse().unwrap();
        assert_eq!(last, end, "{name}");
    }
}
