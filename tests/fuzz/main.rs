//! Mutated scenes: whatever stands in a file, the answer is a result or a message, soon.
//!
//! `cargo test --release --test fuzz ten_thousand -- --ignored --nocapture` tries 10 000 of them, in the library and through
//! the program. One is looked at again by its number, as in `SCENE=1234 cargo test --release --test fuzz one -- --ignored
//! --nocapture`.

mod binary;
mod files;
mod grow;
mod mutate;
mod random;
mod text;
mod trial;
mod watch;
mod words;

use random::Random;
use serde_json::Value;
use std::collections::BTreeMap;
use std::path::{Path, PathBuf};
use tempfile::TempDir;
use trial::{Ending, survive};

/// The shipped scenes, and the schema.
struct Stock {
    scenes: Vec<Value>,
    schema: Value,
}

fn folder() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("models")
}

impl Stock {
    fn new() -> Stock {
        let read = |path: &Path| serde_json::from_str(&std::fs::read_to_string(path).unwrap()).unwrap();
        let mut paths: Vec<PathBuf> = std::fs::read_dir(folder()).unwrap().map(|entry| entry.unwrap().path()).collect();
        paths.sort();
        let is_schema = |path: &PathBuf| path.to_string_lossy().ends_with(".schema.json");
        let is_scene = |path: &PathBuf| path.extension().is_some_and(|end| end == "json") && !is_schema(path);
        let schema = paths.iter().find(|path| is_schema(path)).unwrap();
        Stock {
            schema: read(schema),
            scenes: paths.iter().filter(|path| is_scene(path)).map(|path| read(path)).collect(),
        }
    }

    /// Scene `number`: a shipped one, or every eighth one that grew from the schema, with one to three changes, some of
    /// them with a part of another scene; some then damaged as text.
    fn mutant(&self, number: u64) -> Vec<u8> {
        let mut random = Random::new(number);
        let is_grown = number % 8 == 7;
        let mut scene = match random.pick(&self.scenes) {
            Some(scene) if !is_grown => scene.clone(),
            _ => grow::grow(&self.schema, &mut random),
        };
        if let (Some(other), true) = (random.pick(&self.scenes), random.is_one_in(6)) {
            mutate::splice(&mut scene, other, &mut random);
        }
        for _ in 0..random.one([1, 1, 1, 2, 2, 3]) {
            mutate::mutate(&mut scene, &mut random);
        }
        let text = serde_json::to_string_pretty(&scene).unwrap().into_bytes();
        if random.is_one_in(8) { text::damage(text, &mut random) } else { text }
    }
}

/// Every file that scenes may name beside them.
fn place() -> TempDir {
    let place = tempfile::tempdir().unwrap();
    for entry in std::fs::read_dir(folder()).unwrap().map(|entry| entry.unwrap().path()) {
        if entry.is_file() && entry.extension().is_none_or(|end| end != "json") {
            std::fs::copy(&entry, place.path().join(entry.file_name().unwrap())).unwrap();
        }
    }
    place
}

fn try_scenes(numbers: std::ops::Range<u64>) {
    let stock = Stock::new();
    let place = place();
    let numbers: Vec<u64> = numbers.collect();
    let endings = watch::each(&numbers, place.path(), |number, file| {
        std::fs::write(file, stock.mutant(number)).unwrap();
        survive(file)
    });
    let mut counts: BTreeMap<Ending, usize> = BTreeMap::new();
    let mut faults = Vec::new();
    for (number, ending) in endings {
        match ending {
            Ok(ending) => *counts.entry(ending).or_default() += 1,
            Err(fault) => faults.push(format!("scene {number}: {fault}")),
        }
    }
    println!("{counts:?}");
    assert!(faults.is_empty(), "{} of {}:\n{}", faults.len(), numbers.len(), faults.join("\n"));
    // Else the numerics behind the checks would never be tried.
    let runs: usize = counts.iter().filter(|(ending, _)| **ending != Ending::Refused).map(|(_, count)| count).sum();
    assert!(runs > numbers.len() / 8, "only {runs} of {} mutants ran", numbers.len());
}

#[test]
fn a_thousand_scenes() {
    try_scenes(0..1000);
}

#[test]
#[ignore = "takes minutes"]
fn ten_thousand_scenes() {
    try_scenes(0..10_000);
}

#[test]
#[ignore = "for looking at one scene"]
fn one() {
    let number = std::env::var("SCENE").ok().and_then(|text| text.parse().ok()).expect("SCENE is a number");
    let place = place();
    let file = place.path().join("scene.json");
    std::fs::write(&file, Stock::new().mutant(number)).unwrap();
    std::fs::copy(&file, std::env::temp_dir().join(format!("holonom-scene-{number}.json"))).unwrap();
    println!("{:?}", survive(&file));
}
