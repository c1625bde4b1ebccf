//! The expression language of scenes: a formula is parsed once and evaluated over any [`Scalar`], so that its
//! derivatives are exact.
//!
#![doc = include_str!("language.md")]

mod builder;
mod error;
mod function;
mod lexer;
mod number;
mod operation;
mod parameters;
mod parser;
mod program;
mod scope;
mod switch;
#[cfg(test)]
mod tests;

#[doc(hidden)]
pub use error::ExpressionError;
pub(crate) use lexer::{is_plain_name, with_names, words};
pub use number::Number;
pub use parameters::Parameters;
#[doc(hidden)]
pub use parameters::{ParameterError, ParameterSource, constant};
#[doc(hidden)]
pub use scope::Scope;
#[doc(hidden)]
pub use switch::{Switch, TimeFunction};

use super::signal::Signal;
/// Grammar, functions and names as text.
#[doc(hidden)]
pub const LANGUAGE: &str = include_str!("language.md");

use super::{Regime, Scalar};
use error::excerpt;
use program::{Op, Program};
use std::fmt;
use std::sync::Arc;

/// Meaning of a name in an expression.
#[derive(Clone, Copy, Debug, PartialEq)]
#[doc(hidden)]
pub enum Name {
    /// A number known when the expression is parsed.
    Constant(f64),
    /// The entry at this index of the variables of [`Expression::eval`].
    Variable(usize),
}

/// The names that an expression may use in addition to functions and `pi`.
#[doc(hidden)]
pub trait Names {
    /// Meaning of a name; `None` if it is not known.
    fn resolve(&self, name: &str) -> Option<Name>;

    /// All known names, for suggestions in error messages.
    fn known(&self) -> Vec<String>;

    /// The signals by whose names the expression may call them. Default: none.
    fn signals(&self) -> &[Arc<Signal>] {
        &[]
    }
}

/// A number beyond all of a scene: no regime prescribes its piece.
const UNNUMBERED: usize = usize::MAX / 2;

/// A compiled formula. Evaluation allocates nothing, does not recurse, and cannot fail.
#[derive(Clone, Debug, PartialEq)]
pub struct Expression {
    text: String,
    program: Program,
    variables: Vec<(usize, String)>,
    /// The number of its first switching function; [`UNNUMBERED`] where it is not part of the equations of a scene.
    first: usize,
}

impl Expression {
    /// Compiles `text`, see the grammar in the module's documentation. Constant parts are computed at once.
    ///
    /// # Errors
    ///
    /// For text that is not an expression, unknown names and functions, wrong numbers of arguments, tables that are
    /// not constant and increasing, more than 150 levels of nesting, and more than 64 intermediate results at once.
    /// A division by zero is no error here: see [`constant`](Self::constant).
    pub fn parse(text: &str, names: &dyn Names) -> Result<Self, ExpressionError> {
        let (program, variables) = parser::parse(text, names)?;
        Ok(Expression { text: text.to_string(), program, variables, first: UNNUMBERED })
    }

    /// The value at `variables`, with the indices that [`Names::resolve`] returned.
    ///
    /// # Panics
    ///
    /// If `variables` is shorter than the indices that [`variables`](Self::variables) names.
    #[inline]
    pub fn eval<S: Scalar>(&self, variables: &[S]) -> S {
        self.program.eval(variables)
    }

    /// The value with the pieces of `regime`, see [`number_switches`](Self::number_switches).
    #[inline]
    pub fn eval_held<S: Scalar>(&self, variables: &[S], regime: Regime) -> S {
        if regime.is_free() { self.eval(variables) } else { self.program.eval_held(variables, self.first, regime) }
    }

    /// Writes the arguments of its switching functions to `out` at their numbers, with the pieces of `regime`.
    pub fn arguments<S: Scalar>(&self, variables: &[S], regime: Regime, out: &mut [S]) {
        if let Some(own) = out.get_mut(self.first..) {
            self.program.arguments(variables, self.first, regime, own);
        }
    }

    /// The text that was parsed.
    pub fn text(&self) -> &str {
        &self.text
    }

    /// Index and name of each variable the value depends on, in the order of first mention.
    pub fn variables(&self) -> impl ExactSizeIterator<Item = (usize, &str)> {
        self.variables.iter().map(|(index, name)| (*index, name.as_str()))
    }

    /// True if the value may change with variable `index`.
    pub fn depends_on(&self, index: usize) -> bool {
        self.variables.iter().any(|(known, _)| *known == index)
    }

    /// True if the value depends on no variable.
    pub fn is_constant(&self) -> bool {
        self.variables.is_empty()
    }

    /// The value of a constant expression.
    ///
    /// # Errors
    ///
    /// If it depends on a variable, is infinite, or is not a number.
    pub fn constant(&self) -> Result<f64, ExpressionError> {
        let value = match (self.program.ops.as_slice(), self.variables.first()) {
            ([Op::Constant(value)], _) => *value,
            (_, Some((_, name))) => {
                let message =
                    format!("expected a constant, found `{}`, which depends on `{name}`", excerpt(&self.text));
                return Err(ExpressionError::whole(&self.text, message));
            }
            (_, None) => self.eval::<f64>(&[]),
        };
        finite(value, &self.text)
    }
}

/// A constant expression, with the number as its text.
impl From<f64> for Expression {
    fn from(value: f64) -> Self {
        let program = Program::constant(value);
        Expression { text: value.to_string(), program, variables: Vec::new(), first: UNNUMBERED }
    }
}

impl fmt::Display for Expression {
    fn fmt(&self, out: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(out, "{}", self.text)
    }
}

fn finite(value: f64, text: &str) -> Result<f64, ExpressionError> {
    let fault = match value {
        v if v.is_finite() => return Ok(v),
        v if v.is_nan() => "not a number",
        _ => "infinite",
    };
    let error = ExpressionError::whole(text, format!("`{}` is {fault}", excerpt(text)));
    Err(error.hint("expected a finite number"))
}
