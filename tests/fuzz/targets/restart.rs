//! States that runs go on from.
#![no_main]

use holonom::analysis::Recorder;
use holonom::prepared::{Overrides, Model};
use holonom::simulate::{Checkpoint, Span, Start, simulate_from};
use libfuzzer_sys::fuzz_target;
use std::path::Path;

const SCENE: &str = concat!(env!("CARGO_MANIFEST_DIR"), "/../../../models/pendulum.json");
const SPAN: Span = Span { start: 0.0, end: 0.02, output_step: 0.01 };

fuzz_target!(|text: &str| {
    let Ok(saved) = serde_json::from_str::<Checkpoint>(text) else { return };
    let prepared = Model::load_with(Path::new(SCENE), &Overrides::default()).expect("a shipped scene");
    let mut recorder = Recorder::new(prepared.system());
    let _ = simulate_from(prepared.system(), &prepared.method, SPAN, Start::Saved(&saved), &mut recorder);
});
