//! Whatever is typed, nothing panics and nothing grows without bound.

use super::*;
use crate::math::Taylor;
use proptest::prelude::*;

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
            let _ = crate::Error::from(error).to_string();
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

proptest! {
    #![proptest_config(ProptestConfig { cases: 2000, failure_persistence: None, ..ProptestConfig::default() })]

    #[test]
    fn random_bytes_never_panic(bytes in proptest::collection::vec(any::<u8>(), 0..60)) {
        survive(&String::from_utf8_lossy(&bytes));
    }

    #[test]
    fn random_characters_never_panic(text in "\\PC{0,40}") {
        survive(&text);
    }

    #[test]
    fn random_tokens_never_panic(words in proptest::collection::vec(0..TOKENS.len(), 0..25)) {
        survive(&words.iter().map(|i| TOKENS[*i]).collect::<String>());
    }

    #[test]
    fn random_formulas_are_the_same_over_all_numbers(text in formula()) {
        prop_assert!(Expression::parse(&text, &Fixture).is_ok(), "{}", text);
        survive(&text);
    }
}

/// Texts that parse.
fn formula() -> impl Strategy<Value = String> {
    let leaf = prop_oneof![Just("x"), Just("y"), Just("t"), Just("k"), Just("0"), Just("1.5")].prop_map(String::from);
    leaf.prop_recursive(6, 40, 3, |inner| {
        let two = ["+", "-", "*", "/", "^", " and ", "^2*"];
        let one = ["-", "sin", "exp", "sqrt", "abs", "tanh", "asin", "step", "not "];
        let many = ["min", "hypot", "atan2", "pow"];
        prop_oneof![
            (inner.clone(), 0..two.len(), inner.clone()).prop_map(move |(a, i, b)| format!("{a}{}{b}", two[i])),
            (0..one.len(), inner.clone()).prop_map(move |(i, a)| format!("({}({a}))", one[i])),
            (0..many.len(), inner.clone(), inner.clone()).prop_map(move |(i, a, b)| format!("{}({a},{b})", many[i])),
            (inner.clone(), inner.clone(), inner).prop_map(|(c, a, b)| format!("if({c} > 1, {a}, {b})")),
        ]
    })
}

#[test]
fn the_deepest_text_fits_a_small_stack() {
    let deepest = format!("{}x{}", "max(x, ".repeat(62), ")".repeat(62));
    let refused = "max(x, (".repeat(1000);
    let parse = move || (Expression::parse(&deepest, &Fixture).is_ok(), Expression::parse(&refused, &Fixture).is_err());
    let small = std::thread::Builder::new().stack_size(1024 * 1024).spawn(parse);
    assert_eq!(small.unwrap().join().unwrap(), (true, true));
}
