//! Error messages of the parser.

use super::Parser;
use crate::error::suggest;
use crate::math::expression::error::{ExpressionError, excerpt};
use crate::math::expression::function::{self, ArgumentForm, FUNCTIONS};
use crate::math::expression::lexer::{Token, TokenKind};
use std::fmt::Display;

impl Parser<'_> {
    pub(super) fn error(&self, token: Token, before: impl Display, after: impl Display) -> ExpressionError {
        self.error_at(token.start, before, after)
    }

    pub(super) fn error_at(&self, start: usize, before: impl Display, after: impl Display) -> ExpressionError {
        ExpressionError::at(self.text, start, before, after)
    }

    pub(super) fn show(&self, token: Token) -> String {
        match token.kind {
            TokenKind::End => "the end".to_string(),
            _ => format!("`{}`", excerpt(self.slice(token))),
        }
    }

    /// Error for a missing operand at `token`, which has been consumed.
    pub(super) fn missing_operand(&self, token: Token) -> ExpressionError {
        let after = match self.next.checked_sub(2).and_then(|i| self.tokens.get(i)) {
            Some(before) => format!(" after {}", self.show(*before)),
            None => String::new(),
        };
        self.error(token, format!("expected a value{after}"), format!(", found {}", self.show(token)))
    }

    pub(super) fn missing_operator(&self, token: Token) -> ExpressionError {
        let error = self.error(token, "expected an operator", format!(", found {}", self.show(token)));
        match token.kind {
            TokenKind::Number(_) | TokenKind::Name | TokenKind::Open => error.hint("a product is written `*`"),
            _ => error,
        }
    }

    pub(super) fn wrong_arity(&self, token: Token, form: &ArgumentForm, found: usize) -> ExpressionError {
        let error = self.error(token, format!("{} takes {}, found {found},", self.slice(token), form.arity()), "");
        match form.usage() {
            Some(usage) => error.hint(usage),
            None => error,
        }
    }

    pub(super) fn unknown_function(&self, token: Token) -> ExpressionError {
        let name = self.slice(token);
        let shown = excerpt(name);
        if function::constant(name).is_some() || self.names.resolve(name).is_some() {
            let error = self.error(token, format!("`{shown}` is not a function,"), "");
            return error.hint(format!("a product is written `{shown}*(...)`"));
        }
        let signals = self.names.signals().iter().map(|signal| signal.name().to_string());
        let known = FUNCTIONS.iter().map(|(known, _)| known.to_string()).chain(signals).collect();
        self.error(token, format!("unknown function `{shown}`"), "").hint(nearest(name, known))
    }

    pub(super) fn unknown_name(&self, token: Token) -> ExpressionError {
        let name = self.slice(token);
        if function::function(name).is_some() {
            return self.error_at(token.end, format!("expected '(' after the function `{name}`"), "");
        }
        if self.names.signals().iter().any(|signal| signal.name() == name) {
            let error = self.error_at(token.end, format!("expected '(' after the signal `{}`", excerpt(name)), "");
            return error.hint(format!("a signal is a function of one argument, such as `{}(t)`", excerpt(name)));
        }
        let error = self.error(token, format!("unknown name `{}`", excerpt(name)), "");
        let held = name.strip_suffix('\'').filter(|held| self.names.resolve(held).is_some());
        if let Some(held) = held {
            return error.hint(format!("a rate of this order cannot stand here; `{held}` can"));
        }
        match name {
            "t" => error.hint("what stands here must not depend on time"),
            "e" => error.hint("Euler's number is `exp(1)`"),
            _ => {
                let mut known = self.names.known();
                known.push("pi".to_string());
                error.hint(nearest(name, known))
            }
        }
    }
}

/// Suggestion of a known name; one that differs in case only comes first.
fn nearest(found: &str, known: Vec<String>) -> String {
    match known.iter().find(|name| name.to_lowercase() == found.to_lowercase()) {
        Some(name) => format!("did you mean `{name}`?"),
        None => suggest(found, known.iter().map(String::as_str)),
    }
}
