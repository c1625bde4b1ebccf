//! What a hostile or careless hand may write.

use crate::random::Random;
use serde_json::{Value, json};

const NUMBERS: [f64; 20] = [
    0.0, -0.0, 1.0, -1.0, 2.0, 1e-3, -1e3, 1e9, 1e15, -1e15, 1e-15, 1e100, 1e-100, 1e308, -1e308, 1e-308, 5e-324, 0.5,
    3.5, 65536.0,
];

/// None of them has a value that a scene can use, most have none at all.
const EXPRESSIONS: [&str; 24] = [
    "0/0",
    "1/0",
    "-1/0",
    "sqrt(-1)",
    "log(0)",
    "1e999",
    "10^10^10",
    "t",
    "1e308*t",
    "sqrt(t - 1e-3)",
    "sin(1e300*t)",
    "table(t, 0, 0, 0, 1)",
    "step(t, 0, 1, 0, 2)",
    "nan",
    "inf",
    "pi",
    "self",
    "a.b.c",
    "((((((((1))))))))",
    "1 +",
    "",
    " ",
    "1;2",
    "2**3",
];

const WORDS: [&str; 20] = [
    "ground",
    "ground.O",
    "ground.ground",
    "",
    ".",
    "a.b.c",
    "t",
    "pi",
    "x",
    "angle",
    "rigid",
    "weld",
    "point_mass",
    "Träger 🦀",
    "\u{0}",
    "\u{202e}neg",
    "e\u{301}",
    "../../etc/passwd",
    "NaN",
    "null",
];

pub fn number(random: &mut Random) -> Value {
    match random.below(4) {
        0 => json!(random.one([i64::MAX, i64::MIN, 0, -1, 1_000_000_000])),
        _ => json!(random.one(NUMBERS)),
    }
}

pub fn expression(random: &mut Random) -> Value {
    match random.below(12) {
        0 => json!(format!("{}1{}", "(".repeat(3000), ")".repeat(3000))),
        1 => json!(vec!["1"; 3000].join("+")),
        2 => json!(format!("{}1", "-".repeat(3000))),
        _ => json!(random.one(EXPRESSIONS)),
    }
}

pub fn word(random: &mut Random) -> String {
    match random.below(12) {
        0 => "n".repeat(20_000),
        _ => random.one(WORDS).to_string(),
    }
}

/// Control characters, directions of writing, markup, formats, paths and noncharacters, alone or within a word.
const HOSTILE: [&str; 16] = [
    "\u{1b}[2J\u{1b}]0;title\u{7}",
    "\u{9b}31m",
    "\u{0}\u{1}\u{7f}\r\n",
    "\u{202e}\u{2066}\u{200f}",
    "\u{2028}\u{2029}\u{feff}",
    "</text><script>&amp;]]>",
    "{msg}{}%s%n{0:9999999999}",
    "`\n  help: obey",
    "\"\\\"",
    "/dev/zero",
    "../../../../../../dev/full",
    "con.nul\u{0}.json",
    "\u{10ffff}\u{fffe}",
    "a\u{300}\u{301}\u{302}\u{303}",
    "=cmd()",
    "--help",
];

pub fn hostile(random: &mut Random) -> String {
    let text = random.one(HOSTILE);
    match random.below(6) {
        0 => text.repeat(1000),
        1 => format!("x{text}y"),
        _ => text.to_string(),
    }
}

/// Of any type.
pub fn thing(random: &mut Random) -> Value {
    match random.below(9) {
        0 => Value::Null,
        1 => json!(random.is_one_in(2)),
        2 => json!([]),
        3 => json!({}),
        4 => json!([1, 2, 3, 4, 5, 6, 7]),
        5 => json!({ "name": "x", "type": "rigid" }),
        6 => json!(word(random)),
        7 => expression(random),
        _ => number(random),
    }
}

/// Text that no tree of values can hold.
pub fn token(random: &mut Random) -> &'static str {
    random.one([
        "NaN", "Infinity", "1e999", "-1e-999", "01", "+1", ".5", "1.", "'x'", "//", "/* */", "\\u12", "\u{feff}", ",,",
        "]", "}", "{\"a\":", "\"", "\\", "\u{0}",
    ])
}
