//! Switching functions of expressions, and their values on prescribed pieces.

use super::super::{Expression, Name, Names};
use crate::math::{Piece, Rate, Regime, Thresholds, piece_of_whole};

/// t is variable 0, x variable 1.
struct Moving;

impl Names for Moving {
    fn resolve(&self, name: &str) -> Option<Name> {
        ["t", "x"].iter().position(|known| *known == name).map(Name::Variable)
    }
    fn known(&self) -> Vec<String> {
        vec!["t".to_string(), "x".to_string()]
    }
}

fn numbered(text: &str, first: usize) -> (Expression, Vec<super::super::Switch>) {
    let mut expression = Expression::parse(text, &Moving).unwrap();
    let switches = expression.number_switches(first);
    (expression, switches)
}

#[test]
fn thresholds_and_what_passes_them() {
    let (_, switches) = numbered("if(t > 2, abs(x), table(t, 0, 1, 3, 4)) + smoothstep(x - t) + min(1, 2*t)", 0);
    let thresholds: Vec<Thresholds> = switches.iter().map(|switch| switch.thresholds.clone()).collect();
    assert_eq!(
        thresholds,
        [vec![0.0], vec![0.0], vec![0.0, 3.0], vec![0.0, 1.0], vec![0.0]].map(|all| Thresholds::At(all.into()))
    );
    let of_time: Vec<bool> = switches.iter().map(|switch| switch.of_time.is_some()).collect();
    assert_eq!(of_time, [true, false, true, false, true]);
    let value = |k: usize| switches[k].of_time.as_ref().map(|argument| argument.at(5.0, Regime::FREE));
    assert_eq!([value(0), value(2), value(4)], [Some(3.0), Some(5.0), Some(-9.0)]);
}

/// On a prescribed piece a function is the smooth continuation of that piece.
#[test]
fn a_piece_goes_on_beyond_its_threshold() {
    let held = |text: &str, pieces: &[Piece], x: f64| numbered(text, 0).0.eval_held(&[0.0, x], Regime::held(pieces));
    assert_eq!(held("abs(x)", &[2], -3.0), -3.0);
    assert_eq!(held("if(x < 1, 5, x^2)", &[0], 3.0), 5.0);
    assert_eq!(held("if(x < 1, 5, x^2)", &[2], -3.0), 9.0);
    assert_eq!(held("table(x, 0, 0, 1, 2, 2, 2)", &[2], 4.0), 8.0);
    assert_eq!(held("max(0, x)", &[0], -4.0), -4.0);
    assert_eq!(held("smoothstep(x)", &[0], 0.5), 0.0);
    assert_eq!(held("sign(x)", &[1], 0.5), 0.0);
    let one = piece_of_whole(1.5).unwrap();
    assert_eq!([held("floor(x)", &[one], 4.5), held("mod(x, 2)", &[one], 4.5)], [1.0, 2.5]);
    // If the prescribed piece has no value there, that of the argument is used.
    assert_eq!(held("max(0, x)^1.5", &[0], -4.0), 0.0);
    assert_eq!(held("max(0, x)^1.5", &[0], 4.0), 8.0);
}

/// Switching functions of switching functions, numbered from the middle of a scene's.
#[test]
fn arguments_are_written_at_their_numbers() {
    let (expression, switches) = numbered("abs(1 - abs(x))", 3);
    assert_eq!(switches.len(), 2);
    let mut out = [Rate::fixed(7.0); 5];
    let x = Rate::seeded(-4.0, 0);
    expression.arguments(&[Rate::fixed(0.0), x], Regime::FREE, &mut out);
    assert_eq!([out[2].re, out[3].re, out[4].re], [7.0, -4.0, -3.0]);
    assert_eq!([out[3].eps[0], out[4].eps[0]], [1.0, 1.0]);
    // With the inner one on its other piece.
    expression.arguments(&[Rate::fixed(0.0), x], Regime::held(&[0, 0, 0, 2, 0]), &mut out);
    assert_eq!([out[3].re, out[4].re], [-4.0, 5.0]);
}

#[test]
fn parts_of_time_are_the_largest() {
    let count = |text: &str| numbered(text, 0).0.time_functions().len();
    assert_eq!(count("x*exp(-t^2)*sin(t)"), 2);
    assert_eq!(count("exp(-t^2)*sin(t)"), 1);
    assert_eq!(count("x + t"), 0, "t itself is none");
    assert_eq!(count("x^2"), 0);
    let function = &numbered("x*if(t < 1, t, 2)", 0).0.time_functions()[0];
    assert_eq!([0.5, 3.0].map(|t| function.at(t, Regime::FREE)), [0.5, 2.0]);
}
