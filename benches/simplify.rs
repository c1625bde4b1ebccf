//! What can be left out of all scenes: `cargo bench --bench simplify`, some 20 minutes; with names, these scenes alone.
//!
//! Each scene is simplified as `holonom simplify --robust 10% --samples 20 --budget 120s` does it, within 10 %, 1 % and
//! 0.1 %. The table: velocities, constraints and CPU time before and after, the output that is farthest off, motions
//! nearby on which the promise is kept, and what it took to find the model: runs, and CPU time in runs of the scene as
//! it is. The thread's CPU time is that of the search without the motions nearby, which run on others.

use holonom::clock::Stopwatch;
use holonom::error::{Result, percent};
use holonom::prepared::Overrides;
use holonom::report::TextTable;
use holonom::simplify::{ModelRun, Nearby, Simplification, SimplificationSettings, Source, registry, simplify};
use std::path::{Path, PathBuf};
use std::time::Duration;

const WITHIN: [f64; 3] = [0.1, 0.01, 1e-3];
const BUDGET: Duration = Duration::from_secs(120);
const NEARBY: Nearby = Nearby { by: 0.1, samples: Some(20) };
/// Changes that are named.
const NAMED: usize = 3;

/// The result, and the CPU time of the search, s.
fn found(path: &Path, within: f64) -> Result<(Simplification, f64)> {
    let source = Source::load(path, &Overrides::default())?;
    let with = |nearby| {
        let settings =
            SimplificationSettings { within, budget: Some(BUDGET), nearby, ..SimplificationSettings::default() };
        let watch = Stopwatch::start();
        let found = simplify(&source, &settings, registry(), &|| false, &mut |_, _| ());
        (found, watch.cpu().as_secs_f64())
    };
    // Some scenes have nothing that could be moved.
    match with(Some(NEARBY)) {
        (Ok(found), seconds) => Ok((found, seconds)),
        (Err(_), _) => {
            let (found, seconds) = with(None);
            Ok((found?, seconds))
        }
    }
}

fn row((found, seconds): &(Simplification, f64)) -> Vec<String> {
    let Simplification { richest, chosen, within, runs, robustness, warnings, .. } = found;
    let size = |run: &ModelRun| format!("{}, {}", run.velocities, run.constraints);
    let nearby = robustness.as_ref().map_or("-".to_string(), |near| format!("{} of {}", near.kept, near.counted));
    let what: Vec<&String> = found.left_out().flat_map(|trial| &trial.what).collect();
    let more = if what.len() > NAMED { format!("; {} more", what.len() - NAMED) } else { String::new() };
    let named: Vec<&str> = what.iter().take(NAMED).map(|what| what.as_str()).collect();
    let doubts = if warnings.is_empty() { String::new() } else { format!(" ({} warnings)", warnings.len()) };
    let is_kept = if chosen.error() <= *within { "yes" } else { "NO" };
    vec![
        found.scene.clone(),
        percent(*within),
        size(richest),
        size(chosen),
        format!("{:.3e}", richest.seconds),
        format!("{:.1}", richest.seconds / chosen.seconds),
        chosen.worst().map_or("-".to_string(), |worst| format!("{} {}", percent(worst.error), worst.name)),
        is_kept.to_string(),
        nearby,
        runs.to_string(),
        format!("{:.1}", seconds / richest.seconds),
        format!("{}{more}{doubts}", if named.is_empty() { "nothing".to_string() } else { named.join("; ") }),
    ]
}

fn scenes() -> Vec<PathBuf> {
    let named: Vec<String> = std::env::args().skip(1).filter(|arg| !arg.starts_with('-')).collect();
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("models");
    let files = std::fs::read_dir(folder).into_iter().flatten().filter_map(|entry| Some(entry.ok()?.path()));
    let is_scene = |path: &PathBuf| {
        let name = path.file_name().map(|name| name.to_string_lossy().into_owned()).unwrap_or_default();
        let stem = name.strip_suffix(".json");
        stem.is_some_and(|stem| !stem.contains('.') && (named.is_empty() || named.iter().any(|known| known == stem)))
    };
    let mut scenes: Vec<PathBuf> = files.filter(is_scene).collect();
    scenes.sort();
    scenes
}

fn main() {
    let headings = [
        "scene",
        "within",
        "v, c",
        "after",
        "CPU (s)",
        "times as fast",
        "farthest off",
        "kept",
        "nearby",
        "runs",
        "in its runs",
        "left out",
    ];
    let mut table = TextTable::left(&headings);
    for path in scenes() {
        for within in WITHIN {
            match found(&path, within) {
                Ok(result) => {
                    let row = row(&result);
                    println!("{}", row.join(" | "));
                    table.row(row);
                }
                Err(error) => println!("{} | {} | {error}", path.display(), percent(within)),
            }
        }
    }
    println!("\n{table}");
}
