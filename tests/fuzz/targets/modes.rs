//! Modes of flexible bodies in archives of NumPy.
#![no_main]

use holonom::prepared::{Overrides, Model};
use libfuzzer_sys::fuzz_target;

const SCENE: &str = r#"{ "name": "link", "dimension": 2,
    "bodies": [{ "name": "m", "type": "modal_body", "file": "m.npz" }] }"#;

fuzz_target!(|bytes: &[u8]| {
    let place = tempfile::tempdir().expect("a temporary folder");
    std::fs::write(place.path().join("m.npz"), bytes).expect("a file");
    std::fs::write(place.path().join("scene.json"), SCENE).expect("a file");
    let _ = Model::load_with(&place.path().join("scene.json"), &Overrides::default());
});
