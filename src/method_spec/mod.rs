//! A method as a user names it: `baumgarte:alpha=5,beta=5`, or `{"baumgarte": {"alpha": 5, "beta": 5}}` in a scene.

mod own;

pub(crate) use own::OwnMethods;

use crate::error::{Error, Result, excerpt, suggest};
use schemars::{JsonSchema, Schema, SchemaGenerator, json_schema};
use serde::{Deserialize, Deserializer, Serialize, Serializer};
use serde_json::Value;
use std::borrow::Cow;
use std::fmt;
use std::str::FromStr;

/// Name of a method, with options in the order in which they are given.
#[derive(Clone, Debug, PartialEq, Default)]
pub struct MethodSpec {
    /// Name of the method in its registry.
    pub name: String,
    /// Options as (key, value) texts; the last of a key counts.
    pub options: Vec<(String, String)>,
    /// Entries that are known besides those of the registry.
    own: OwnMethods,
}

/// An entry of a registry of methods.
pub trait Listed: Send + Sync + Sized + 'static {
    /// Kind of method in messages, such as `formulation`.
    const KIND: &'static str;

    /// The built-in entries.
    fn registry() -> &'static [Self];

    /// Name by which scenes and the command line choose the entry.
    fn name(&self) -> &'static str;

    /// Options that the entry takes.
    fn options(&self) -> &'static [OptionDoc];

    /// Specification of an entry from outside the crate, for [`Method`](crate::simulate::Method).
    fn spec(&'static self) -> MethodSpec {
        MethodSpec::named(self.name()).knowing(&OwnMethods::of(self))
    }
}

/// An option of a method.
#[derive(Clone, Copy, Debug, Serialize)]
pub struct OptionDoc {
    /// Key of the option.
    pub name: &'static str,
    /// Meaning of the option, with its unit and default.
    pub about: &'static str,
}

impl MethodSpec {
    /// A method by its name, without options.
    pub fn named(name: &str) -> Self {
        MethodSpec { name: name.to_string(), ..MethodSpec::default() }
    }

    /// The same where these own methods are known, unless it has its own entry already.
    pub(crate) fn knowing(self, own: &OwnMethods) -> Self {
        if self.own.is_empty() { MethodSpec { own: own.clone(), ..self } } else { self }
    }

    /// Adds an option.
    pub fn with(mut self, key: &str, value: &str) -> Self {
        self.options.push((key.to_string(), value.to_string()));
        self
    }

    /// Parses `name` or `name:key=value,key=value`; hyphens count as underscores.
    pub fn parse(text: &str) -> Result<Self> {
        let (name, rest) = text.split_once(':').unwrap_or((text, ""));
        let pairs = rest.split(',').filter(|pair| !pair.trim().is_empty());
        let options = pairs.map(|pair| match pair.split_once('=') {
            Some((key, value)) => Ok((canonical(key), value.trim().to_string())),
            None => Err(Error::input(format!("`{pair}` has no value")).hint(format!(
                "write {}:{}=VALUE",
                name.trim(),
                pair.trim()
            ))),
        });
        Ok(MethodSpec { name: canonical(name), options: options.collect::<Result<_>>()?, own: OwnMethods::default() })
    }

    /// The entry of this name; for unknown names and options an error that lists the known ones.
    pub fn entry<E: Listed>(&self) -> Result<&'static E> {
        let Some(entry) = self.lookup::<E>() else {
            let hint = suggest(&self.name, self.known().map(E::name));
            return Err(Error::input(format!("there is no {} `{}`", E::KIND, excerpt(&self.name))).hint(hint));
        };
        let known = entry.options();
        for (key, _) in &self.options {
            if known.iter().all(|option| option.name != key) {
                let hint = if known.is_empty() {
                    format!("{} takes no options", self.name)
                } else {
                    suggest(key, known.iter().map(|option| option.name))
                };
                return Err(Error::input(format!("{} {} has no option `{key}`", E::KIND, self.name)).hint(hint));
            }
        }
        Ok(entry)
    }

    /// The entry of this name, the user's own one if there is one.
    pub fn lookup<E: Listed>(&self) -> Option<&'static E> {
        self.known::<E>().find(|entry| entry.name() == self.name)
    }

    /// Own entries, then the built-in ones.
    fn known<E: Listed>(&self) -> impl Iterator<Item = &'static E> {
        self.own.entries::<E>().chain(E::registry())
    }

    /// Value of an option, the last one given.
    pub fn text(&self, key: &str) -> Option<&str> {
        self.options.iter().rev().find(|(known, _)| known == key).map(|(_, value)| value.as_str())
    }

    /// A finite number, or `default` if it is not given.
    pub fn number(&self, key: &str, default: f64) -> Result<f64> {
        let Some(text) = self.text(key) else { return Ok(default) };
        let value = text.parse::<f64>().ok().filter(|value| value.is_finite());
        value.ok_or_else(|| {
            Error::input(format!("{}: {key} is `{text}`", self.name)).hint(format!("give a number, as in {key}=5"))
        })
    }

    /// A number that is not negative.
    pub fn not_negative(&self, key: &str, default: f64) -> Result<f64> {
        let value = self.number(key, default)?;
        if value < 0.0 {
            Err(Error::input(format!("{}: {key} is {value}, but cannot be negative", self.name))
                .hint("give zero or more"))
        } else {
            Ok(value)
        }
    }

    /// A number above zero.
    pub fn positive(&self, key: &str, default: f64) -> Result<f64> {
        let value = self.number(key, default)?;
        if value > 0.0 {
            Ok(value)
        } else {
            Err(Error::input(format!("{}: {key} is {value}, but must be above zero", self.name))
                .hint(format!("give a number above zero, as in {key}={default}")))
        }
    }

    /// One of `known`; the first if it is not given.
    pub fn one_of<'k>(&self, key: &str, known: &[&'k str]) -> Result<&'k str> {
        let Some(text) = self.text(key) else { return Ok(known.first().copied().unwrap_or_default()) };
        let text = canonical(text);
        known.iter().find(|name| **name == text).copied().ok_or_else(|| {
            Error::input(format!("{}: {key} is `{text}`", self.name)).hint(format!("it can be {}", known.join(", ")))
        })
    }

    /// A whole number within `range`.
    pub fn whole(&self, key: &str, default: usize, range: std::ops::RangeInclusive<usize>) -> Result<usize> {
        let value = self.number(key, default as f64)?;
        let whole = value as usize;
        if whole as f64 == value && range.contains(&whole) {
            Ok(whole)
        } else {
            Err(Error::input(format!("{}: {key} is {value}", self.name)).hint(format!(
                "give a whole number from {} to {}",
                range.start(),
                range.end()
            )))
        }
    }
}

fn canonical(name: &str) -> String {
    name.trim().replace('-', "_").to_lowercase()
}

/// As [`MethodSpec::parse`].
impl FromStr for MethodSpec {
    type Err = Error;

    fn from_str(text: &str) -> Result<Self> {
        MethodSpec::parse(text)
    }
}

impl fmt::Display for MethodSpec {
    fn fmt(&self, out: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(out, "{}", self.name)?;
        let options: Vec<String> = self.options.iter().map(|(key, value)| format!("{key}={value}")).collect();
        if options.is_empty() { Ok(()) } else { write!(out, ":{}", options.join(",")) }
    }
}

impl Serialize for MethodSpec {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        serializer.collect_str(self)
    }
}

impl<'de> Deserialize<'de> for MethodSpec {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        from_json(&Value::deserialize(deserializer)?).map_err(serde::de::Error::custom)
    }
}

fn from_json(value: &Value) -> Result<MethodSpec> {
    let wrong = || {
        Error::input(format!(
            "expected the name of a method or an object with its options, found {}",
            crate::error::excerpt(&value.to_string())
        ))
        .hint("write \"baumgarte\" or {\"baumgarte\": {\"alpha\": 5, \"beta\": 5}}")
    };
    match value {
        Value::String(text) => MethodSpec::parse(text),
        Value::Object(map) if map.len() == 1 => {
            let (name, options) = map.iter().next().ok_or_else(wrong)?;
            let options = options.as_object().ok_or_else(wrong)?.iter().map(|(key, value)| {
                let value = value.as_str().map_or_else(|| value.to_string(), str::to_string);
                (canonical(key), value)
            });
            Ok(MethodSpec { name: canonical(name), options: options.collect(), own: OwnMethods::default() })
        }
        _ => Err(wrong()),
    }
}

impl JsonSchema for MethodSpec {
    fn schema_name() -> Cow<'static, str> {
        "MethodSpec".into()
    }
    fn json_schema(_: &mut SchemaGenerator) -> Schema {
        json_schema!({
            "description": "Name of a method, or an object {name: {option: value}}.",
            "oneOf": [
                { "type": "string" },
                { "type": "object", "minProperties": 1, "maxProperties": 1, "additionalProperties": {
                    "type": "object", "additionalProperties": { "type": ["number", "string"] } } }
            ]
        })
    }
}
