//! Names that an expression may use: parameters and variables.

use super::{Name, Names, Parameters};
use crate::math::signal::Signal;
use std::sync::Arc;

/// Parameters as constants, and variables by their index in a list: `&["t"]` for fields that may depend on time.
#[derive(Clone, Copy, Debug)]
pub struct Scope<'a, T = &'a str> {
    /// Names that stand for constants.
    pub parameters: &'a Parameters,
    /// Their indices are those of the numbers given to [`Expression::eval`](super::Expression::eval).
    pub variables: &'a [T],
}

impl<T: AsRef<str>> Names for Scope<'_, T> {
    fn resolve(&self, name: &str) -> Option<Name> {
        let variable = self.variables.iter().position(|known| known.as_ref() == name);
        variable.map(Name::Variable).or_else(|| self.parameters.resolve(name))
    }
    fn known(&self) -> Vec<String> {
        let variables = self.variables.iter().map(|name| name.as_ref().to_string());
        variables.chain(self.parameters.known()).collect()
    }
    fn signals(&self) -> &[Arc<Signal>] {
        self.parameters.signals()
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::math::expression::Number;

    #[test]
    fn a_scope_adds_variables() {
        let parameters = Parameters::resolve(&[("l".to_string(), Number::Value(2.0))], &[]).unwrap();
        let scope = Scope { parameters: &parameters, variables: &["t", "theta'"] };
        assert_eq!(scope.resolve("theta'"), Some(Name::Variable(1)));
        assert_eq!(scope.resolve("l"), Some(Name::Constant(2.0)));
        assert_eq!((scope.resolve("x"), scope.known()), (None, vec!["t".into(), "theta'".into(), "l".into()]));
    }
}
