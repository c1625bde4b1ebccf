//! Robots in URDF and models in MJCF.
#![no_main]

use holonom::import::{Options, import};
use libfuzzer_sys::fuzz_target;

fuzz_target!(|text: &str| {
    let _ = import(text, &Options::default());
});
