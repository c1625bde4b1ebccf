//! The functions of the language by name.

use super::operation::{One, Two};
use crate::math::signal::Signal;
use std::sync::Arc;

/// Number and use of the arguments of a function.
#[derive(Clone, Debug, PartialEq)]
pub(super) enum ArgumentForm {
    /// f(x)
    One(One),
    /// f(a, b)
    Two(Two),
    /// f(a, b, c, ...) = f(a, f(b, f(c, ...))), at least two arguments.
    Many(Two),
    /// if(condition, a, b)
    If,
    /// table(x, x0, y0, x1, y1, ...)
    Table,
    /// A signal of the scene.
    Signal(Arc<Signal>),
}

/// All functions, in the order in which the documentation names them.
pub(super) const FUNCTIONS: [(&str, ArgumentForm); 27] = [
    ("sin", ArgumentForm::One(One::Sin)),
    ("cos", ArgumentForm::One(One::Cos)),
    ("tan", ArgumentForm::One(One::Tan)),
    ("asin", ArgumentForm::One(One::Asin)),
    ("acos", ArgumentForm::One(One::Acos)),
    ("atan", ArgumentForm::One(One::Atan)),
    ("sinh", ArgumentForm::One(One::Sinh)),
    ("cosh", ArgumentForm::One(One::Cosh)),
    ("tanh", ArgumentForm::One(One::Tanh)),
    ("exp", ArgumentForm::One(One::Exp)),
    ("ln", ArgumentForm::One(One::Ln)),
    ("log", ArgumentForm::One(One::Ln)),
    ("log10", ArgumentForm::One(One::Log10)),
    ("sqrt", ArgumentForm::One(One::Sqrt)),
    ("abs", ArgumentForm::One(One::Abs)),
    ("sign", ArgumentForm::One(One::Sign)),
    ("step", ArgumentForm::One(One::Step)),
    ("smoothstep", ArgumentForm::One(One::Smoothstep)),
    ("floor", ArgumentForm::One(One::Floor)),
    ("mod", ArgumentForm::Two(Two::Mod)),
    ("atan2", ArgumentForm::Two(Two::Atan2)),
    ("pow", ArgumentForm::Two(Two::Pow)),
    ("min", ArgumentForm::Many(Two::Min)),
    ("max", ArgumentForm::Many(Two::Max)),
    ("hypot", ArgumentForm::Two(Two::Hypot)),
    ("if", ArgumentForm::If),
    ("table", ArgumentForm::Table),
];

/// The constants that every expression knows.
pub(super) const CONSTANTS: [(&str, f64); 2] = [("pi", std::f64::consts::PI), ("π", std::f64::consts::PI)];

/// Words that cannot be names of parameters: those with a meaning in every expression, and time.
const WORDS: [&str; 4] = ["t", "and", "or", "not"];

pub(super) fn function(name: &str) -> Option<ArgumentForm> {
    FUNCTIONS.iter().find(|(known, _)| *known == name).map(|(_, form)| form.clone())
}

pub(super) fn constant(name: &str) -> Option<f64> {
    CONSTANTS.iter().find(|(known, _)| *known == name).map(|(_, value)| *value)
}

/// True if `name` has a meaning in every expression.
pub(super) fn is_reserved(name: &str) -> bool {
    function(name).is_some() || constant(name).is_some() || WORDS.contains(&name)
}

impl ArgumentForm {
    /// True if the function can take `count` arguments.
    pub fn takes(&self, count: usize) -> bool {
        match self {
            ArgumentForm::One(_) | ArgumentForm::Signal(_) => count == 1,
            ArgumentForm::Two(_) => count == 2,
            ArgumentForm::Many(_) => count >= 2,
            ArgumentForm::If => count == 3,
            ArgumentForm::Table => count >= 5 && count % 2 == 1,
        }
    }

    /// Number of its arguments as text.
    pub fn arity(&self) -> &'static str {
        match self {
            ArgumentForm::One(_) | ArgumentForm::Signal(_) => "1 argument",
            ArgumentForm::Two(_) => "2 arguments",
            ArgumentForm::Many(_) => "2 or more arguments",
            ArgumentForm::If => "3 arguments",
            ArgumentForm::Table => "x and at least 2 points",
        }
    }

    /// Form of the call as text, if the number of arguments does not determine it.
    pub fn usage(&self) -> Option<&'static str> {
        match self {
            ArgumentForm::If => Some("write `if(condition, a, b)`"),
            ArgumentForm::Table => Some("write `table(x, x0, y0, x1, y1)`"),
            ArgumentForm::Two(Two::Atan2) => Some("write `atan2(y, x)`"),
            ArgumentForm::Two(Two::Mod) => Some("write `mod(a, b)`"),
            _ => None,
        }
    }
}
