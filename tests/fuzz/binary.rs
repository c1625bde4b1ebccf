//! Mutated scenes through the program itself.

use crate::{Stock, place, watch};
use std::collections::BTreeMap;
use std::path::Path;
use std::process::{Child, Command, ExitStatus, Stdio};
use std::time::{Duration, Instant};

/// Each with a short run; the scene's own may be endless.
const COMMANDS: [&[&str]; 17] = [
    &["check"],
    &["simulate", "--until", "0.01", "--output-step", "0.001"],
    &["linearize"],
    &["plot"],
    &["simulate", "--until", "0.01", "--output-step", "0.001", "--json", "--figures", "none"],
    &["drift", "--until", "0.01", "--output-step", "0.001", "--quiet"],
    &["loci", "--until", "0.01", "--every", "0.005"],
    &["check", "--json"],
    &["validate", "--horizon", "0.01", "--budget", "500ms"],
    &["bode", "--points", "10"],
    &["transition", "--lyapunov", "0.01"],
    &["kinematics", "m=1..2:3"],
    &["study", "--vary", "m=1..2:3", "--until", "0.01", "--linearize"],
    &["stress", "--map", "time", "--limit", "50ms", "--budget", "500ms"],
    &["simplify", "--within", "10%", "--until", "0.01", "--budget", "500ms"],
    &["tradeoff", "--until", "0.01", "--digits", "3", "--budget", "500ms"],
    &["simulate", "--until", "0.01", "--output-step", "0.001", "--method", "auto", "--check-error"],
];

/// A run is asked to end after this time.
const LONG: Duration = Duration::from_secs(2);

/// The command of a number, for a scene.
fn command(number: u64, scene: &Path, results: &Path) -> Command {
    let command = COMMANDS[(number % COMMANDS.len() as u64) as usize];
    let mut run = Command::new(env!("CARGO_BIN_EXE_holonom"));
    run.arg(command[0]).arg(scene).args(&command[1..]).current_dir(scene.parent().unwrap());
    if command[0] != "check" {
        run.arg("-o").arg(results);
    }
    run
}

/// How a command ends that writes to a folder: its code, or what is wrong with it.
pub fn ends(mut run: Command, results: &Path) -> Result<i32, String> {
    let _ = std::fs::remove_dir_all(results);
    let command: Vec<String> = run.get_args().map(|word| word.to_string_lossy().into_owned()).collect();
    let told = results.with_extension("err");
    run.stdout(Stdio::null()).stderr(std::fs::File::create(&told).unwrap());
    let (status, is_asked) = wait(run.spawn().unwrap()).ok_or(format!("{command:?} does not end"))?;
    let told = String::from_utf8_lossy(&std::fs::read(told).unwrap()).into_owned();
    match status.code() {
        _ if is_asked && !told.contains("panicked") => whole(results).map(|()| 1),
        _ if told.contains("panicked") => Err(format!("{command:?}: {told}")),
        Some(code @ (1 | 2)) if !told.contains("error: ") => Err(format!("{command:?} ends with {code}: `{told}`")),
        Some(code @ 0..=2) => whole(results).map(|()| code),
        _ => Err(format!("{command:?} ends with {status}: {told}")),
    }
}

/// How the program ended, and whether it had to be asked to. A run of tiny steps rightly takes long, but must hear that.
fn wait(mut child: Child) -> Option<(ExitStatus, bool)> {
    let clock = Instant::now();
    let mut is_asked = false;
    while clock.elapsed() < watch::FOREVER / 2 {
        if let Some(status) = child.try_wait().unwrap() {
            return Some((status, is_asked));
        }
        if !is_asked && clock.elapsed() > LONG {
            is_asked = Command::new("kill").arg(child.id().to_string()).status().is_ok();
        }
        std::thread::sleep(Duration::from_millis(2));
    }
    child.kill().unwrap();
    child.wait().unwrap();
    None
}

/// Nothing that is not whole, and nothing that is hidden.
fn whole(folder: &Path) -> Result<(), String> {
    for path in std::fs::read_dir(folder).into_iter().flatten().flatten().map(|entry| entry.path()) {
        let bytes = std::fs::read(&path).map_err(|error| format!("{}: {error}", path.display()))?;
        let is_whole = match path.extension().and_then(|end| end.to_str()).unwrap_or_default() {
            "json" => serde_json::from_slice::<serde_json::Value>(&bytes).is_ok(),
            "csv" => {
                bytes.ends_with(b"\n") && csv::Reader::from_reader(bytes.as_slice()).records().all(|row| row.is_ok())
            }
            "svg" => bytes.trim_ascii_end().ends_with(b"</svg>"),
            _ => !bytes.is_empty(),
        };
        if !is_whole {
            return Err(format!("{} is not whole", path.display()));
        }
    }
    Ok(())
}

fn try_binary(numbers: std::ops::Range<u64>) {
    let stock = Stock::new();
    let place = place();
    let numbers: Vec<u64> = numbers.collect();
    let codes = watch::each(&numbers, place.path(), |number, file| {
        std::fs::write(file, stock.mutant(number)).unwrap();
        let results = file.with_extension("out");
        ends(command(number, file, &results), &results)
    });
    told_of(codes, numbers.len(), 8);
}

/// No fault, and one of so many runs at least is fine.
pub fn told_of(codes: Vec<(u64, Result<i32, String>)>, all: usize, one_of: usize) {
    let mut counts: BTreeMap<i32, usize> = BTreeMap::new();
    let mut faults = Vec::new();
    for (number, code) in codes {
        match code {
            Ok(code) => *counts.entry(code).or_default() += 1,
            Err(fault) => faults.push(format!("number {number}: {fault}")),
        }
    }
    println!("exit codes: {counts:?}");
    assert!(faults.is_empty(), "{} of {all}:\n{}", faults.len(), faults.join("\n"));
    let done = counts.get(&0).copied().unwrap_or(0);
    assert!(done > all / one_of, "only {done} of {all} are fine");
}

#[test]
fn the_program_survives_scenes() {
    try_binary(20_000..20_320);
}

#[test]
#[ignore = "takes minutes"]
fn the_program_survives_ten_thousand_scenes() {
    try_binary(0..10_000);
}
