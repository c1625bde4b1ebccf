//! The functions of the language by name.

use super::operation::{One, Two};
use crate::math::signal::Signal;
use std::sync::Arc;

/// Number and use of the arguments of a function.
#[derive(Clone, Debug, PartialEq)]
pub(super) enum Form {
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
pub(super) const FUNCTIONS: [(&str, Form); 27] = [
    ("sin", Form::One(One::Sin)),
    ("cos", Form::One(One::Cos)),
    ("tan", Form::One(One::Tan)),
    ("asin", Form::One(One::Asin)),
    ("acos", Form::One(One::Acos)),
    ("atan", Form::One(One::Atan)),
    ("sinh", Form::One(One::Sinh)),
    ("cosh", Form::One(One::Cosh)),
    ("tanh", Form::One(One::Tanh)),
    ("exp", Form::One(One::Exp)),
    ("ln", Form::One(One::Ln)),
    ("log", Form::One(One::Ln)),
    ("log10", Form::One(One::Log10)),
    ("sqrt", Form::One(One::Sqrt)),
    ("abs", Form::One(One::Abs)),
    ("sign", Form::One(One::Sign)),
    ("step", Form::One(One::Step)),
    ("smoothstep", Form::One(One::Smoothstep)),
    ("floor", Form::One(One::Floor)),
    ("mod", Form::Two(Two::Mod)),
    ("atan2", Form::Two(Two::Atan2)),
    ("pow", Form::Two(Two::Pow)),
    ("min", Form::Many(Two::Min)),
    ("max", Form::Many(Two::Max)),
    ("hypot", Form::Two(Two::Hypot)),
    ("if", Form::If),
    ("table", Form::Table),
];

/// The constants that every expression knows.
pub(super) const CONSTANTS: [(&str, f64); 2] = [("pi", std::f64::consts::PI), ("π", std::f64::consts::PI)];

/// Words that cannot be names of parameters: those with a meaning in every expression, and time.
const WORDS: [&str; 4] = ["t", "and", "or", "not"];

pub(super) fn function(name: &str) -> Option<Form> {
    FUNCTIONS.iter().find(|(known, _)| *known == name).map(|(_, form)| form.clone())
}

pub(super) fn constant(name: &str) -> Option<f64> {
    CONSTANTS.iter().find(|(known, _)| *known == name).map(|(_, value)| *value)
}

/// True if `name` has a meaning in every expression.
pub(super) fn is_reserved(name: &str) -> bool {
    function(name).is_some() || constant(name).is_some() || WORDS.contains(&name)
}

impl Form {
    /// True if the function can take `count` arguments.
    pub fn takes(&self, count: usize) -> bool {
        match self {
            Form::One(_) | Form::Signal(_) => count == 1,
            Form::Two(_) => count == 2,
            Form::Many(_) => count >= 2,
            Form::If => count == 3,
            Form::Table => count >= 5 && count % 2 == 1,
        }
    }

    /// Number of its arguments as text.
    pub fn arity(&self) -> &'static str {
        match self {
            Form::One(_) | Form::Signal(_) => "1 argument",
            Form::Two(_) => "2 arguments",
            Form::Many(_) => "2 or more arguments",
            Form::If => "3 arguments",
            Form::Table => "x and at least 2 points",
        }
    }

    /// Form of the call as text, if the number of arguments does not determine it.
    pub fn usage(&self) -> Option<&'static str> {
        match self {
            Form::If => Some("write `if(condition, a, b)`"),
            Form::Table => Some("write `table(x, x0, y0, x1, y1)`"),
            Form::Two(Two::Atan2) => Some("write `atan2(y, x)`"),
            Form::Two(Two::Mod) => Some("write `mod(a, b)`"),
            _ => None,
        }
    }
}
