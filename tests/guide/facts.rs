//! A known fact of each scene of the gallery.

use serde_json::Value;
use std::fs;
use std::path::Path;
use std::process::Command;

/// Values of a column of a table.
fn column(path: &Path, name: &str) -> Vec<f64> {
    let mut reader = csv::Reader::from_path(path).unwrap_or_else(|error| panic!("{}: {error}", path.display()));
    let headings = reader.headers().unwrap().clone();
    let place = headings.iter().position(|heading| heading == name);
    let place = place.unwrap_or_else(|| panic!("{}: no column {name} in {headings:?}", path.display()));
    let rows = reader.records().map(|row| row.unwrap()[place].parse().unwrap_or(f64::NAN));
    rows.filter(|x: &f64| !x.is_nan()).collect()
}

fn found(kind: &str, values: &[f64]) -> f64 {
    let max = values.iter().copied().fold(f64::NEG_INFINITY, f64::max);
    let min = values.iter().copied().fold(f64::INFINITY, f64::min);
    match kind {
        "final" => *values.last().unwrap(),
        "max" => max,
        "min" => min,
        "range" => max - min,
        "max_abs_difference" => max.abs().max(min.abs()),
        other => panic!("no kind {other}"),
    }
}

#[test]
fn every_scene_of_the_gallery_does_what_is_known_of_it() {
    let root = Path::new(env!("CARGO_MANIFEST_DIR"));
    let facts: Value =
        serde_json::from_str(&fs::read_to_string(root.join("tests/data/gallery.json")).unwrap()).unwrap();
    let facts = facts.as_array().unwrap();
    assert!(facts.len() >= 20);
    for fact in facts {
        let text = |key: &str| fact[key].as_str().unwrap_or_else(|| panic!("{fact}: no {key}"));
        let place = tempfile::tempdir().unwrap();
        let scene = root.join(format!("models/{}.json", text("scene")));
        let words = fact["command"].as_array().unwrap().iter().map(|word| word.as_str().unwrap());
        let words = words.map(|word| word.replace("{scene}", scene.to_str().unwrap()));
        let mut command = Command::new(env!("CARGO_BIN_EXE_holonom"));
        let output = command.args(words).args(["-o", "out"]).current_dir(&place).output().unwrap();
        assert!(output.status.success(), "{fact}: {}", String::from_utf8_lossy(&output.stderr));
        let value = found(text("kind"), &column(&place.path().join("out").join(text("file")), text("column")));
        let expected = fact["expected"].as_f64().unwrap();
        let tolerance = fact["tolerance"].as_f64().unwrap();
        assert!(
            (value - expected).abs() <= tolerance,
            "{}: {value}, expected {expected} ({})",
            text("scene"),
            text("what")
        );
    }
}
