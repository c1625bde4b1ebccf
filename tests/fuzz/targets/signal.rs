//! Tables in CSV that signals are read from.
#![no_main]

use holonom::prepared::{Overrides, Model};
use libfuzzer_sys::fuzz_target;

const SCENE: &str = r#"{ "name": "push", "dimension": 2,
    "signals": [{ "name": "f", "file": "f.csv", "columns": ["t", "f"] }],
    "bodies": [{ "name": "m", "type": "point_mass", "mass": 1 }],
    "forces": [{ "name": "push", "type": "applied_force", "at": "m", "force": ["f(t)", 0] }] }"#;

fuzz_target!(|bytes: &[u8]| {
    let place = tempfile::tempdir().expect("a temporary folder");
    std::fs::write(place.path().join("f.csv"), bytes).expect("a file");
    std::fs::write(place.path().join("scene.json"), SCENE).expect("a file");
    let _ = Model::load_with(&place.path().join("scene.json"), &Overrides::default());
});
