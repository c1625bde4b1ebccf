//! Expressions of constants.
#![no_main]

use holonom::math::expression::constant;
use libfuzzer_sys::fuzz_target;

fuzz_target!(|text: &str| {
    let _ = constant(text);
});
