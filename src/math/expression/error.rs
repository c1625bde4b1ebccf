//! Errors of expressions, with their position.

use crate::error::Error;
use std::fmt;

/// Longest part of a user's text that a message quotes, in characters.
const EXCERPT: usize = 60;

/// An expression that is not valid, or whose value cannot be used.
#[derive(Clone, Debug, PartialEq)]
pub struct ExpressionError {
    /// The fault, with the character at which it is.
    pub message: String,
    /// Remedy.
    pub hint: Option<String>,
    /// Column of the fault in [`text`](Self::text), in characters from one; `None` for a fault of the whole.
    pub position: Option<usize>,
    /// Text of the whole expression.
    pub text: String,
}

impl ExpressionError {
    /// A fault of the whole expression.
    pub(super) fn whole(text: &str, message: impl Into<String>) -> Self {
        ExpressionError { message: message.into(), hint: None, position: None, text: text.to_string() }
    }

    /// A fault at byte `start`; the message reads "`before` at character N`after`".
    pub(super) fn at(text: &str, start: usize, before: impl fmt::Display, after: impl fmt::Display) -> Self {
        let position = text.get(..start).unwrap_or(text).chars().count() + 1;
        let message = format!("{before} at character {position}{after}");
        ExpressionError { position: Some(position), ..Self::whole(text, message) }
    }

    pub(super) fn hint(mut self, hint: impl Into<String>) -> Self {
        self.hint.get_or_insert(hint.into());
        self
    }
}

impl fmt::Display for ExpressionError {
    fn fmt(&self, out: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(out, "{}", self.message)?;
        self.hint.iter().try_for_each(|hint| write!(out, "; {hint}"))
    }
}

impl std::error::Error for ExpressionError {}

/// Bad input that quotes the expression if a character of it is at fault; the caller adds path and element.
impl From<ExpressionError> for Error {
    fn from(problem: ExpressionError) -> Self {
        let error = Error::input(match problem.position {
            None => problem.message,
            Some(_) => format!("{} in \"{}\"", problem.message, around(&problem.text, problem.position)),
        });
        match problem.hint {
            Some(hint) => error.hint(hint),
            None => error,
        }
    }
}

/// The beginning of `text`, short enough for a message.
pub(super) fn excerpt(text: &str) -> String {
    around(text, None)
}

/// The part of `text` about character `position`, short enough for a message.
fn around(text: &str, position: Option<usize>) -> String {
    let length = text.chars().count();
    let first = position.unwrap_or(1).saturating_sub(1 + EXCERPT / 2).min(length.saturating_sub(EXCERPT));
    let middle: String = text.chars().skip(first).take(EXCERPT).collect();
    let before = if first > 0 { "..." } else { "" };
    let after = if first + EXCERPT < length { "..." } else { "" };
    format!("{before}{middle}{after}")
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_long_text_is_shown_about_its_fault() {
        let text = format!("{}stifness{}", "1+".repeat(100), "+1".repeat(100));
        let error = Error::from(ExpressionError::at(&text, 200, "unknown name `stifness`", ""));
        let shown = error.to_string();
        assert!(shown.starts_with("unknown name `stifness` at character 201 in \"...1+1+"), "{shown}");
        assert!(shown.contains("stifness+1+1") && shown.len() < 140, "{shown}");
    }

    #[test]
    fn a_fault_in_a_short_text_shows_all_of_it() {
        let error = Error::from(ExpressionError::at("2*x", 2, "unknown name `x`", "").hint("did you mean `y`?"));
        assert_eq!(error.to_string(), "unknown name `x` at character 3 in \"2*x\"\n  help: did you mean `y`?");
    }
}
