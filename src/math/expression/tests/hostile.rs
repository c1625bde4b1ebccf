//! No text makes the parser or evaluation panic or grow without bound.

use super::*;
use crate::math::Taylor;

#[test]
fn depth_is_bounded() {
    let deep = "nested more than 150 levels deep at character 151";
    for piece in ["(", "-", "!", "not ", "2^", "sin(", "max(x,", "if(", "+"] {
        let text = piece.repeat(100_000);
        let error = Expression::parse(&text, &Fixture).unwrap_err().to_string();
        assert!(error.starts_with("nested more than 150 levels deep at character "), "{piece}: {error}");
    }
    assert_eq!(message(&"(".repeat(100_000)), deep);
    let nested = |n: usize| format!("{}x{}", "x+(".repeat(n), ")".repeat(n));
    assert_eq!(value(&nested(60)), 183.0);
    assert_eq!(
        message(&nested(70)),
        "expression needs more than 64 intermediate results at once; \
         take a part of it out into a parameter, or nest it less"
    );
    assert_eq!(value(&format!("{}x{}", "(".repeat(90), ")".repeat(90))), 3.0);
    assert_eq!(message(&"1+".repeat(600_000)), "expression longer than 1000000 bytes");
}

#[test]
fn long_flat_expressions_and_tables_are_fine() {
    assert_eq!(value(&format!("x{}", "+x".repeat(100_000))), 300_003.0);
    let points: Vec<String> = (0..20_000).map(|i| format!("{i},{}", 2 * i)).collect();
    assert_eq!(value(&format!("table(1000*x + 0.25, {})", points.join(","))), 6000.5);
}

/// Parses, and evaluates what parses.
fn survive(text: &str) {
    match Expression::parse(text, &Fixture) {
        Ok(parsed) => {
            let x = [0.0, 1.5, -2.0, 1e300].map(Taylor::time);
            let value: f64 = parsed.eval(&x).x;
            let plain: f64 = parsed.eval(&[0.0, 1.5, -2.0, 1e300]);
            let near = (value - plain).abs() <= 1e-6 * plain.abs().max(1.0);
            assert!(near || !plain.is_finite() || !value.is_finite() || plain.abs() > 1e3, "{text}: {value} {plain}");
            let _ = (parsed.constant(), parsed.variables().count());
        }
        Err(error) => {
            let at = error.position.unwrap_or(1);
            assert!(at >= 1 && at <= text.chars().count() + 1 && !error.to_string().is_empty());
            let _ = crate::error::Error::from(error).to_string();
        }
    }
}

const TOKENS: [&str; 46] = [
    "1",
    "0",
    ".5",
    "1e-3",
    "2.5E+4",
    "x",
    "y",
    "t",
    "crank.angle'",
    "k",
    "n",
    "pi",
    "+",
    "-",
    "*",
    "/",
    "^",
    "(",
    ")",
    "(",
    ")",
    ",",
    "<",
    "<=",
    ">",
    ">=",
    "==",
    "!=",
    "and",
    "or",
    "not",
    "!",
    "sin(",
    "sqrt(",
    "exp(",
    "atan2(",
    "min(",
    "hypot(",
    "if(",
    "table(",
    "log10(",
    "smoothstep(",
    "acos(",
    " ",
    "'",
    ".",
];

const TEXTS: usize = 2000;

fn random() -> fastrand::Rng {
    fastrand::Rng::with_seed(1)
}

#[test]
fn random_bytes_never_panic() {
    let mut random = random();
    for _ in 0..TEXTS {
        let bytes: Vec<u8> = (0..random.usize(..60)).map(|_| random.u8(..)).collect();
        survive(&String::from_utf8_lossy(&bytes));
    }
}

#[test]
fn random_characters_never_panic() {
    let mut random = random();
    for _ in 0..TEXTS {
        survive(&(0..random.usize(..40)).map(|_| random.char(..)).collect::<String>());
    }
}

#[test]
fn random_tokens_never_panic() {
    let mut random = random();
    for _ in 0..TEXTS {
        survive(&(0..random.usize(..25)).map(|_| TOKENS[random.usize(..TOKENS.len())]).collect::<String>());
    }
}

#[test]
fn random_formulas_are_the_same_over_all_numbers() {
    let mut random = random();
    for _ in 0..TEXTS {
        let text = formula(&mut random, 6);
        assert!(Expression::parse(&text, &Fixture).is_ok(), "{text}");
        survive(&text);
    }
}

/// A text that parses, nested at most `depth` times.
fn formula(random: &mut fastrand::Rng, depth: usize) -> String {
    let mut one_of = |texts: &[&str]| texts[random.usize(..texts.len())].to_string();
    let leaf = one_of(&["x", "y", "t", "k", "0", "1.5"]);
    let two = one_of(&["+", "-", "*", "/", "^", " and ", "^2*"]);
    let one = one_of(&["-", "sin", "exp", "sqrt", "abs", "tanh", "asin", "step", "not "]);
    let many = one_of(&["min", "hypot", "atan2", "pow"]);
    if depth == 0 {
        return leaf;
    }
    let kind = random.u8(..6);
    let mut inner = || formula(random, depth - 1);
    match kind {
        0 => format!("{}{two}{}", inner(), inner()),
        1 => format!("({one}({}))", inner()),
        2 => format!("{many}({},{})", inner(), inner()),
        3 => format!("if({} > 1, {}, {})", inner(), inner(), inner()),
        _ => leaf,
    }
}

#[test]
fn the_deepest_text_fits_a_small_stack() {
    let deepest = format!("{}x{}", "max(x, ".repeat(62), ")".repeat(62));
    let refused = "max(x, (".repeat(1000);
    let parse = move || (Expression::parse(&deepest, &Fixture).is_ok(), Expression::parse(&refused, &Fixture).is_err());
    let small = std::thread::Builder::new().stack_size(1024 * 1024).spawn(parse);
    assert_eq!(small.unwrap().join().unwrap(), (true, true));
}
