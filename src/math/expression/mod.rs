//! The expression language of scenes: a formula is parsed once and evaluated over any [`Scalar`], so that its
//! derivatives are exact.
//!
//! # Grammar
//!
//! From the weakest to the tightest binding; operators of one line associate to the left unless it says otherwise:
//!
//! | operator                      | meaning                                                                     |
//! |-------------------------------|-----------------------------------------------------------------------------|
//! | `a or b`, `a \|\| b`          | true where one is                                                           |
//! | `a and b`, `a && b`           | true where both are                                                         |
//! | `not a`                       | true where `a` is not                                                       |
//! | `<` `<=` `>` `>=` `==` `!=`   | comparisons, which do not chain                                             |
//! | `a + b`, `a - b`              |                                                                             |
//! | `a * b`, `a / b`              |                                                                             |
//! | `-a`, `+a`, `!a`              |                                                                             |
//! | `a ^ b`                       | power, associates to the right: `2^3^2` is 512, `-2^2` is -4, `2^-1` is 0.5 |
//! | `(a)`, `f(a, b)`, name, number|                                                                             |
//!
//! Truth values are the numbers 1 and 0, and every number but 0 is true.
//!
//! A number is `1`, `.5`, `1e-3`, `2.5E+4`. A name is letters (of any alphabet), digits and `_`, not beginning with a
//! digit; parts are joined by dots and rates end in primes: `l0`, `crank.C.x`, `theta'`. The constant `pi` (or `π`) is
//! always there; angles are in radians.
//!
//! # Functions
//!
//! | function                                | value                                                             |
//! |-----------------------------------------|-------------------------------------------------------------------|
//! | `sin cos tan asin acos atan`            | in radians                                                        |
//! | `atan2(y, x)`                           | angle of (x, y) in (-pi, pi]                                      |
//! | `sinh cosh tanh exp sqrt abs`           | `abs` has slope 1 at 0                                            |
//! | `ln(x)`, `log(x)`                       | natural logarithm, both                                           |
//! | `log10(x)`                              | decimal logarithm                                                 |
//! | `pow(x, y)`                             | `x^y`                                                             |
//! | `min(a, b, ...)`, `max(a, b, ...)`      | the first where both are equal                                    |
//! | `hypot(a, b)`                           | sqrt(a^2 + b^2), with zero derivatives at the origin              |
//! | `sign(x)`                               | -1, 0, 1                                                          |
//! | `step(x)`                               | 0 for x < 0, 1 for x >= 0                                         |
//! | `floor(x)`                              | largest whole number <= x; no value beyond 2^29                   |
//! | `mod(a, b)`                             | a - b floor(a/b), from 0 to b: a cycle                            |
//! | `smoothstep(x)`                         | 0 for x <= 0, 1 for x >= 1, 6 x^5 - 15 x^4 + 10 x^3 between: C2   |
//! | `if(c, a, b)`                           | `a` where `c` is true, otherwise `b`                              |
//! | `table(x, x0, y0, x1, y1, ...)`         | straight lines through two or more points, `y` constant outside   |
//!
//! The points of a table are constants with increasing `x`: it is a linear [`Signal`] that holds. At a point the slope
//! is that of the line to its right. A signal of the scene is a function of one argument by its name.
//!
//! `abs`, `min`, `max`, `sign`, `step`, `smoothstep`, `floor`, `mod`, comparisons, tables and signals change their form where an
//! argument passes a threshold: see [`Switch`].
//!
//! `x^n` with a constant whole n takes any x, and `0^0` is 1. Every other power wants x >= 0 and is not a number for
//! x < 0. Only the chosen one of `if`'s two values counts: the other may be infinite or not a number.

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
pub use number::Number;
#[doc(hidden)]
pub use number::constant;
pub use parameters::Parameters;
#[doc(hidden)]
pub use parameters::{ParameterError, ParameterSource};
#[doc(hidden)]
pub use scope::Scope;
#[doc(hidden)]
pub use switch::{Switch, TimeFunction};

use super::signal::Signal;
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

/// A compiled formula. Evaluation allocates nothing, does not recurse, and cannot fail.
#[derive(Clone, Debug, PartialEq)]
pub struct Expression {
    text: String,
    program: Program,
    variables: Vec<(usize, String)>,
    /// The number of its first switching function.
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
        Ok(Expression { text: text.to_string(), program, variables, first: 0 })
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
        self.program.arguments(variables, self.first, regime, &mut out[self.first..]);
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
        Expression { text: value.to_string(), program, variables: Vec::new(), first: 0 }
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
