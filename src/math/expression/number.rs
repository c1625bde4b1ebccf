//! Numbers in scenes: plain, or expressions over the parameters.

use super::{Expression, ExpressionError, Names, finite};
use schemars::{JsonSchema, Schema, SchemaGenerator, json_schema};
use serde::Serialize;
use serde::de::{Deserialize, Deserializer, Error};
use serde_json::Value;
use std::borrow::Cow;
use std::fmt;

const EXPECTED: &str = "a number or an expression such as \"sqrt(2)*l\"";

/// A JSON number, or a JSON string with an expression.
#[derive(Serialize, Clone, Debug, PartialEq)]
#[serde(untagged)]
pub enum Number {
    /// A finite number.
    Value(f64),
    /// An expression, as written.
    Text(String),
}

impl Number {
    /// The value for given parameters.
    ///
    /// # Errors
    ///
    /// If the expression cannot be parsed, depends on anything but parameters, or its value is not finite.
    #[doc(hidden)]
    pub fn evaluate(&self, parameters: &dyn Names) -> Result<f64, ExpressionError> {
        match self {
            Number::Value(value) if value.is_finite() => Ok(*value),
            Number::Value(value) => finite(*value, &value.to_string()),
            Number::Text(text) => Expression::parse(text, parameters)?.constant(),
        }
    }

    /// The expression over `names`, for fields that may depend on time or on measures.
    ///
    /// # Errors
    ///
    /// If the expression cannot be parsed, or its value is constant and not finite.
    #[doc(hidden)]
    pub fn expression(&self, names: &dyn Names) -> Result<Expression, ExpressionError> {
        let expression = match self {
            Number::Value(value) => Expression::from(*value),
            Number::Text(text) => Expression::parse(text, names)?,
        };
        if expression.is_constant() {
            expression.constant()?;
        }
        Ok(expression)
    }
}

impl Default for Number {
    fn default() -> Self {
        Number::Value(0.0)
    }
}

impl From<f64> for Number {
    fn from(value: f64) -> Self {
        Number::Value(value)
    }
}

impl From<&str> for Number {
    fn from(text: &str) -> Self {
        Number::Text(text.to_string())
    }
}

impl fmt::Display for Number {
    fn fmt(&self, out: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Number::Value(value) => write!(out, "{value}"),
            Number::Text(text) => write!(out, "{text}"),
        }
    }
}

impl<'de> Deserialize<'de> for Number {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        let found = match Value::deserialize(deserializer)? {
            Value::Number(number) => return Ok(Number::Value(number.as_f64().unwrap_or(f64::NAN))),
            Value::String(text) => return Ok(Number::Text(text)),
            Value::Bool(value) => &format!("`{value}`"),
            Value::Null => "null",
            Value::Array(_) => "a list",
            Value::Object(_) => "an object",
        };
        // With the expected type first, unlike serde's message.
        Err(D::Error::custom(format_args!("expected {EXPECTED}, found {found}")))
    }
}

impl JsonSchema for Number {
    fn schema_name() -> Cow<'static, str> {
        "Number".into()
    }

    fn schema_id() -> Cow<'static, str> {
        concat!(module_path!(), "::Number").into()
    }

    fn json_schema(_: &mut SchemaGenerator) -> Schema {
        json_schema!({
            "description": "A number, or an expression over the scene's parameters.",
            "oneOf": [
                { "type": "number" },
                { "type": "string", "minLength": 1, "examples": ["sqrt(2)*l", "m*l^2/12"] }
            ]
        })
    }
}

#[cfg(test)]
mod tests {
    use super::super::Parameters;
    use super::*;

    fn read(json: &str) -> Result<Number, String> {
        serde_json::from_str(json).map_err(|error| error.to_string())
    }

    #[test]
    fn json_numbers_and_strings_are_read_and_written() {
        assert_eq!(read("3"), Ok(Number::Value(3.0)));
        assert_eq!(read("-2"), Ok(Number::Value(-2.0)));
        assert_eq!(read("9.81"), Ok(Number::Value(9.81)));
        assert_eq!(read("\"sqrt(2)*l\""), Ok(Number::from("sqrt(2)*l")));
        for number in [Number::Value(0.1), Number::from("2*l")] {
            assert_eq!(read(&serde_json::to_string(&number).unwrap()), Ok(number));
        }
    }

    #[test]
    fn anything_else_is_refused_with_what_is_expected() {
        let found = [("true", "`true`"), ("null", "null"), ("[1]", "a list"), ("{\"a\": 1}", "an object")];
        for (json, found) in found {
            let message = read(json).unwrap_err();
            let expected = format!("expected a number or an expression such as \"sqrt(2)*l\", found {found}");
            assert!(message.starts_with(&expected), "{message}");
        }
    }

    #[test]
    fn values_must_be_finite_and_constant() {
        let parameters = Parameters::resolve(&[("l".to_string(), Number::Value(2.0))], &[]).unwrap();
        let message = |number: Number| number.evaluate(&parameters).unwrap_err().to_string();
        assert_eq!(Number::from("l^2/8").evaluate(&parameters), Ok(0.5));
        assert_eq!(Number::Value(7.0).evaluate(&parameters), Ok(7.0));
        assert_eq!(message(Number::from("1/(l-2)")), "`1/(l-2)` is infinite; expected a finite number");
        assert_eq!(message(Number::Value(f64::NAN)), "`NaN` is not a number; expected a finite number");
        assert_eq!(
            message(Number::from("2*t")),
            "unknown name `t` at character 3; what stands here must not depend on time"
        );
    }

    #[test]
    fn the_schema_allows_a_number_or_a_string() {
        let schema = schemars::schema_for!(Number);
        let kinds = schema.as_value().pointer("/oneOf").and_then(|kinds| kinds.as_array()).unwrap();
        assert_eq!(
            kinds.iter().map(|kind| kind["type"].as_str()).collect::<Vec<_>>(),
            [Some("number"), Some("string")]
        );
    }
}
