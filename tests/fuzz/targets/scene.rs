//! Scenes in JSON: read, expanded and resolved.
#![no_main]

use holonom::scene::Scene;
use libfuzzer_sys::fuzz_target;

fuzz_target!(|text: &str| {
    let _ = Scene::parse(text, &[]);
});
