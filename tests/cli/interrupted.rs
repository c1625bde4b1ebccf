//! Runs that are interrupted, killed or find the disk full leave whole files or none.

use crate::cli::{PENDULUM, Place, err, out};
use serde_json::Value;
use std::fs;
use std::path::Path;
use std::process::{Child, Command, Output, Stdio};
use std::sync::atomic::{AtomicU32, Ordering};
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
    is_ignored(std::process::id(), 1)
}

/// Whether a process has a signal ignored; false where the system does not tell.
fn is_ignored(process: u32, signal: u32) -> bool {
    let status = fs::read_to_string(format!("/proc/{process}/status")).unwrap_or_default();
    let mask = status.lines().find_map(|line| line.strip_prefix("SigIgn:"));
    mask.and_then(|mask| u64::from_str_radix(mask.trim(), 16).ok()).unwrap_or(0) & 1 << (signal - 1) != 0
}

/// Waits for a condition.
fn until(mut is_so: impl FnMut() -> bool) {
    let clock = Instant::now();
    while !is_so() {
        assert!(clock.elapsed() < FOREVER);
        std::thread::sleep(Duration::from_micros(200));
    }
}

/// A run that does not end by then hangs.
const FOREVER: Duration = Duration::from_secs(120);
/// How an interrupted command ends that has no part of a result to write, and any that has not begun to step.
const AT_ONCE: Option<i32> = Some(130);

/// Sends a signal to a run that `begin` starts and waits for its end.
///
/// When a run listens cannot be seen from outside. So the signal is sent until the run ends. Where that was too early, or
/// twice, it is begun again, with twice the time between signals; `begin` is called with that time.
fn interrupted(begin: impl Fn(Duration) -> Child, with: &str, is_heard: impl Fn(&Output) -> bool) -> Output {
    let mut pause = Duration::from_millis(100);
    loop {
        let mut child = begin(pause);
        let clock = Instant::now();
        while child.try_wait().unwrap().is_none() {
            assert!(clock.elapsed() < FOREVER, "it does not hear {with}");
            std::thread::sleep(pause);
            signal(&child, with);
        }
        let output = child.wait_with_output().unwrap();
        if is_heard(&output) || 8 * pause > FOREVER {
            return output;
        }
        pause *= 2;
    }
}

/// A run that writes what it has.
fn has_ended_itself(output: &Output) -> bool {
    output.status.code().is_some_and(|code| Some(code) != AT_ONCE)
}

/// A command that has nothing to write.
fn has_ended_at_once(output: &Output) -> bool {
    output.status.code().is_some()
}

#[test]
fn an_interrupted_run_writes_what_it_has() {
    let signals = if is_sheltered() { &["INT", "TERM"][..] } else { &["INT", "TERM", "HUP"] };
    for with in signals {
        let place = Place::new(PENDULUM);
        let args = [&["simulate"], &ENDLESS[..], &["here"]].concat();
        let output = interrupted(|_| start(&place, &args), with, has_ended_itself);
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
        let args = [&["simulate"], &ENDLESS[..], &["here"]].concat();
        let output = interrupted(|_| start_ignoring(&place, ignored, &args), with, has_ended_itself);
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
        let output = interrupted(|_| start_ignoring(&place, "INT QUIT HUP", args), "INT", has_ended_at_once);
        assert_eq!((output.status.code(), err(&output).as_str()), (AT_ONCE, "interrupted\n"), "{args:?}");
    }
}

#[test]
#[cfg(target_os = "linux")]
fn nohup_keeps_a_run_from_hanging_up() {
    let place = Place::new(PENDULUM);
    let args = [&["simulate"], &ENDLESS[..], &["here"]].concat();
    let ends = AtomicU32::new(0);
    let begin = |pause: Duration| {
        let mut child = start_ignoring(&place, "HUP", &args);
        until(|| is_ignored(child.id(), 1));
        signal(&child, "HUP");
        std::thread::sleep(pause);
        ends.fetch_add(u32::from(child.try_wait().unwrap().is_some()), Ordering::Relaxed);
        child
    };
    // Had it been heard, TERM would be the second signal.
    assert_eq!(interrupted(begin, "TERM", has_ended_itself).status.code(), Some(1));
    assert_eq!(ends.into_inner(), 0, "HUP ends it");
}

#[test]
fn all_stabilizations_are_interrupted_together() {
    let place = Place::new(PENDULUM);
    let args = [&["drift"], &ENDLESS[..], &["here"]].concat();
    let output = interrupted(|_| start(&place, &args), "INT", has_ended_itself);
    assert_eq!(output.status.code(), Some(1), "{}", err(&output));
    assert!(err(&output).contains(": interrupted\n"), "{}", err(&output));
    assert_whole(&place.path("here"));
}

/// What cannot end by itself ends at once, with nothing written.
#[test]
fn an_interrupted_command_that_has_no_part_of_a_result_writes_none() {
    let place = Place::new(PENDULUM);
    let args = ["validate", "scene.json", "--horizon", "1e6", "-o", "here"];
    let output = interrupted(|_| start(&place, &args), "INT", has_ended_at_once);
    assert_eq!((output.status.code(), err(&output).as_str()), (AT_ONCE, "interrupted\n"));
    assert_eq!(place.files("here"), [""; 0]);
}

/// The second signal does not wait for anything: both arrive at once, in a run with much to write.
#[test]
fn the_second_signal_ends_at_once() {
    let place = Place::new(PENDULUM);
    let endless = MUCH.map(|word| if word == "5" { "500" } else { word });
    let begin = |pause| {
        let _ = fs::remove_dir_all(place.path("here"));
        let child = start(&place, &endless);
        std::thread::sleep(pause);
        ["STOP", "INT", "TERM", "CONT"].iter().for_each(|with| signal(&child, with));
        child
    };
    let is_heard = |output: &Output| err(output).lines().count() == 2;
    let output = interrupted(begin, "INT", is_heard);
    let said = "interrupted: the results so far are written; again to end at once\ninterrupted\n";
    assert_eq!((output.status.code(), err(&output).as_str()), (AT_ONCE, said));
    assert!(!place.path("here/summary.json").exists());
}

fn hidden(folder: &Path) -> Vec<std::path::PathBuf> {
    let entries = fs::read_dir(folder).into_iter().flatten().flatten().map(|entry| entry.path());
    entries.filter(|path| path.file_name().unwrap().to_string_lossy().starts_with('.')).collect()
}

/// Kills a run as soon as it writes this file, or at once without a name.
fn killed(place: &Place, file: &str) {
    let mut child = start(place, &MUCH);
    let folder = place.path("here");
    while !file.is_empty()
        && child.try_wait().unwrap().is_none()
        && !hidden(&folder).iter().any(|path| path.join(file).exists())
    {
        std::thread::sleep(Duration::from_micros(200));
    }
    child.kill().unwrap();
    child.wait().unwrap();
}

#[test]
fn a_killed_run_leaves_whole_files() {
    let place = Place::new(PENDULUM);
    place.done(&[&MUCH[..7], &["whole"]].concat());
    let names = [vec![String::new()], place.files("whole")].concat();
    let run = || place.done(&["simulate", "scene.json", "-o", "here", "--quiet"]);
    run();
    let old = place.json("here/summary.json");
    let mut before = 0;
    let mut after = 0;
    let mut left = 0;
    // On a busy machine a run may have come to its end before it is killed.
    for name in names.iter().cycle().take(20 * names.len()) {
        killed(&place, name);
        left += usize::from(!hidden(&place.path("here")).is_empty());
        assert_whole(&place.path("here"));
        match place.path("here/summary.json").exists().then(|| place.json("here/summary.json")) {
            Some(summary) if summary["t_end"] == old["t_end"] => before += 1,
            Some(_) => after += 1,
            // Within the renames.
            None => {}
        }
        fs::remove_dir_all(place.path("here")).unwrap();
        run();
        if before + after >= 2 * names.len() && before >= 5 && left >= 5 {
            return;
        }
    }
    panic!("{before} killed before, {after} after the end, {left} left something behind");
}

#[test]
fn what_a_killed_run_left_behind_is_removed() {
    let place = Place::new(PENDULUM);
    let folder = place.path("here");
    // The middle of writing is where the hidden folder is.
    let is_caught = (0..100).any(|_| {
        killed(&place, "drift.csv");
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
    let old = place.text("here/summary.json");
    let files = place.files("here");
    for trap in ["trap '' XFSZ;", ""] {
        let output = limited(&place, trap);
        let message = err(&output);
        assert_eq!(output.status.code(), Some(1), "{message}");
        for piece in ["error: here/trajectory.csv: nothing was written: ", "choose another place with -o"] {
            assert!(message.contains(piece), "{message}");
        }
        assert_eq!((&place.text("here/summary.json"), &place.files("here")), (&old, &files));
    }
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

#[test]
fn an_interrupted_study_keeps_whole_rows() {
    let place = Place::new(PENDULUM.replace(r#""gravity""#, r#""parameters": { "l": 1 }, "gravity""#));
    let study = ["study", "scene.json", "--vary", "l=1..2:100000", "--figures", "none", "-o", "here"];
    let output = interrupted(|_| start(&place, &study), "INT", has_ended_itself);
    assert_eq!(output.status.code(), Some(1));
    assert!(err(&output).contains("error: interrupted: ") && err(&output).contains("--resume"), "{}", err(&output));
    assert_whole_study(&place);
}

/// The cells of short steps would take hours.
#[test]
fn interrupted_maps_keep_their_cells() {
    let place = Place::new(PENDULUM);
    let axes = ["--x", "step=1e-9..1e-3:2:log", "--y", "mass_ratio=1..2:2", "--limit", "1h", "--budget", "9h"];
    let args = [&["stress", "scene.json", "--until", "1", "--figures", "none", "-o", "here"], &axes[..]].concat();
    let output = interrupted(|_| start(&place, &args), "INT", has_ended_itself);
    assert_eq!(output.status.code(), Some(1), "{}", err(&output));
    assert!(err(&output).ends_with("error: interrupted\n"), "{}", err(&output));
    let map = place.json("here/stress.json")["maps"][0].clone();
    let cells = map["cells"].as_array().unwrap();
    assert!(cells.len() >= 4, "{map}");
    assert!(cells.iter().any(|cell| cell["status"] == "left_out"), "{map}");
}

fn assert_whole_study(place: &Place) {
    let table = place.text("here/study.csv");
    let rows: Vec<csv::StringRecord> =
        csv::Reader::from_reader(table.as_bytes()).records().map(Result::unwrap).collect();
    assert_eq!(place.json("here/study.json")["rows"], rows.len());
    assert!(rows.iter().all(|row| row.len() == 5 && row[2].parse::<f64>().is_ok() && row[4].is_empty()), "{table}");
}

/// A signal that comes while results are renamed: old ones or new ones, whole.
#[test]
fn a_signal_mixes_no_results() {
    let place = Place::new(PENDULUM);
    let times: Vec<String> = (0..40).map(|k| format!("{}", 0.01 * f64::from(k))).collect();
    let times = times.join(",");
    let linearize = |rtol| ["linearize", "scene.json", "--at", &times, "--rtol", rtol, "-o", "here", "--quiet"];
    // The names of all files, and the tolerances in those that have one.
    let contents = || -> (Vec<String>, Vec<String>) {
        let mut names: Vec<String> = place.files("here");
        names.retain(|name| !name.starts_with('.'));
        names.sort();
        let tolerance = |name: &String| place.json(&format!("here/{name}"))["simulation"]["rtol"].to_string();
        let mut tolerances: Vec<String> = names.iter().filter(|name| name.ends_with(".json")).map(tolerance).collect();
        tolerances.dedup();
        (names, tolerances)
    };
    for _ in 0..5 {
        place.done(&linearize("1e-6"));
        let (names, old) = contents();
        let mut child = start(&place, &linearize("1e-5"));
        // The first file goes when the renames begin.
        until(|| contents_changed(&place, names.len()) || child.try_wait().unwrap().is_some());
        signal(&child, "TERM");
        child.wait().unwrap();
        let (now, new) = contents();
        assert!(now == names && old.len() == 1 && new.len() == 1, "{old:?}, then {new:?}");
    }
}

/// True if the folder has another number of files than before.
fn contents_changed(place: &Place, before: usize) -> bool {
    let entries = fs::read_dir(place.path("here")).unwrap().flatten();
    entries.filter(|entry| !entry.file_name().to_string_lossy().starts_with('.')).count() != before
}

/// A name that is not text in UTF-8 is a name like any other.
#[test]
fn a_name_that_is_not_utf_8_loses_nothing() {
    use std::os::unix::ffi::OsStringExt;
    let place = Place::new(PENDULUM);
    let name = std::ffi::OsString::from_vec(b"out\xff".to_vec());
    let output = place.command(&["simulate", "scene.json", "--quiet", "-o"]).arg(&name).output().unwrap();
    assert_eq!(output.status.code(), Some(0), "{}", err(&output));
    let folder = fs::read_dir(place.path(".")).unwrap().flatten().find(|entry| entry.file_name() == name).unwrap();
    let summary: Value = serde_json::from_slice(&fs::read(folder.path().join("summary.json")).unwrap()).unwrap();
    assert_eq!(summary["command"].as_array().unwrap().last(), Some(&Value::from("out\u{fffd}")));
}
