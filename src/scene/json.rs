//! Parses JSON text: an error has its line, column and remedy, and a repeated key is an error.

use super::locate::line_and_column;
use crate::error::{Error, Result};
use serde::de::{self, Deserialize, Deserializer, MapAccess, SeqAccess, Visitor};
use serde_json::map::Entry;
use serde_json::{Map, Number, Value};
use std::fmt;

/// Reads JSON text, which may begin with a byte order mark.
pub fn read(text: &str) -> Result<Value> {
    let text = text.strip_prefix('\u{feff}').unwrap_or(text);
    let hint = "give long tables as files: signals as CSV, modes as npz";
    crate::files::refuse_many_values(text).map_err(|error| Error::input(error.to_string()).hint(hint))?;
    serde_json::from_str::<Strict>(text).map(|strict| strict.0).map_err(|error| explain(text, &error))
}

/// A value in which a repeated key is an error; serde_json would silently take the last one.
struct Strict(Value);

struct StrictVisitor;

const TWICE: &str = "the key is given twice: ";

impl<'de> Deserialize<'de> for Strict {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        deserializer.deserialize_any(StrictVisitor).map(Strict)
    }
}

impl<'de> Visitor<'de> for StrictVisitor {
    type Value = Value;

    fn expecting(&self, out: &mut fmt::Formatter<'_>) -> fmt::Result {
        out.write_str("JSON")
    }
    fn visit_bool<E>(self, value: bool) -> Result<Value, E> {
        Ok(Value::Bool(value))
    }
    fn visit_i64<E>(self, value: i64) -> Result<Value, E> {
        Ok(Value::Number(value.into()))
    }
    fn visit_u64<E>(self, value: u64) -> Result<Value, E> {
        Ok(Value::Number(value.into()))
    }
    fn visit_f64<E>(self, value: f64) -> Result<Value, E> {
        Ok(Number::from_f64(value).map_or(Value::Null, Value::Number))
    }
    fn visit_str<E>(self, text: &str) -> Result<Value, E> {
        Ok(Value::String(text.to_string()))
    }
    fn visit_string<E>(self, text: String) -> Result<Value, E> {
        Ok(Value::String(text))
    }
    fn visit_unit<E>(self) -> Result<Value, E> {
        Ok(Value::Null)
    }
    fn visit_seq<A: SeqAccess<'de>>(self, mut items: A) -> Result<Value, A::Error> {
        let mut list = Vec::new();
        while let Some(Strict(item)) = items.next_element()? {
            list.push(item);
        }
        Ok(Value::Array(list))
    }
    fn visit_map<A: MapAccess<'de>>(self, mut entries: A) -> Result<Value, A::Error> {
        let mut map = Map::new();
        while let Some(key) = entries.next_key::<String>()? {
            match map.entry(key) {
                Entry::Occupied(known) => return Err(de::Error::custom(format_args!("{TWICE}`{}`", known.key()))),
                Entry::Vacant(place) => place.insert(entries.next_value::<Strict>()?.0),
            };
        }
        Ok(Value::Object(map))
    }
}

fn explain(text: &str, error: &serde_json::Error) -> Error {
    let full = error.to_string();
    let message = full.rsplit_once(" at line").map_or(full.as_str(), |(message, _)| message);
    let offset = offset(text, error.line(), error.column());
    let error = match message.strip_prefix(TWICE) {
        Some(key) => Error::input(format!("the key {key} is given twice")).hint("keep one of the two"),
        None if other_format(text).is_some() => {
            let format = other_format(text).unwrap_or_default();
            Error::input(format!("this is {format}, not JSON")).hint("a scene is a JSON object; see `holonom schema`")
        }
        None => {
            let (found, hint) = fault(message, &text[..offset], &text[offset..]);
            Error::input(format!("this is not JSON: {found}")).hint(hint)
        }
    };
    error.placed(line_and_column(text, offset))
}

/// Name of another format (XML, YAML, TOML) that the first line of the text suggests.
fn other_format(text: &str) -> Option<&'static str> {
    let first = text.lines().map(str::trim).find(|line| !line.is_empty() && !line.starts_with('#'))?;
    let is_word = |word: &str| !word.is_empty() && word.chars().all(|c| c.is_alphanumeric() || "_-. ".contains(c));
    let is_key = |line: &str, sign: char| line.split_once(sign).is_some_and(|(key, _)| is_word(key));
    match first {
        _ if first.starts_with('<') => Some("XML"),
        _ if first.starts_with("---") || first.starts_with("%YAML") || is_key(first, ':') => Some("YAML"),
        _ if is_key(first, '=') || first.strip_prefix('[')?.strip_suffix(']').is_some_and(is_word) => Some("TOML"),
        _ => None,
    }
}

/// The byte at serde_json's line and column, which counts bytes and may point behind the end of a line.
fn offset(text: &str, line: usize, column: usize) -> usize {
    let start = match line.checked_sub(2) {
        None => 0,
        Some(before) => text.match_indices('\n').nth(before).map_or(text.len(), |(at, _)| at + 1),
    };
    let mut offset = (start + column).saturating_sub(1).min(text.len());
    while !text.is_char_boundary(offset) {
        offset -= 1;
    }
    offset
}

/// Text that people write in place of JSON: its beginning, its name and the remedy.
const FOREIGN: [(&str, &str, &str); 16] = [
    ("NaN", "`NaN`", "every number of a scene must be finite; remove the key where the default is meant"),
    ("nan", "`nan`", "every number of a scene must be finite; remove the key where the default is meant"),
    ("Infinity", "`Infinity`", "every number of a scene must be finite; remove the key where the default is meant"),
    ("inf", "`inf`", "every number of a scene must be finite; remove the key where the default is meant"),
    ("//", "a comment", "remove it; \"about\" has room for words"),
    ("/*", "a comment", "remove it; \"about\" has room for words"),
    ("#", "a comment", "remove it; \"about\" has room for words"),
    ("'", "a single quote", "text and keys go in double quotes"),
    ("\u{201c}", "a typographic quote", "text and keys go in straight double quotes"),
    ("\u{201d}", "a typographic quote", "text and keys go in straight double quotes"),
    ("True", "`True`", "write true"),
    ("False", "`False`", "write false"),
    ("None", "`None`", "write null, or remove the key"),
    (".", "a number that begins with a point", "write 0.5 in place of .5"),
    ("+", "a number that begins with `+`", "write 5 in place of +5"),
    ("=", "`=`", "a key and its value are joined by a colon"),
];

/// The fault at the border of `before` and `after`, and its remedy.
fn fault(message: &str, before: &str, after: &str) -> (String, &'static str) {
    let told = |found: &str, hint| (found.to_string(), hint);
    if message.starts_with("EOF") {
        return told("the file ends too early", "close the bracket or quotes that are open, or save the file again");
    }
    if let Some((_, found, hint)) = FOREIGN.iter().find(|(start, ..)| after.starts_with(start)) {
        return told(found, hint);
    }
    let next = after.chars().next().unwrap_or(' ');
    match message {
        "trailing comma" => told("a comma after the last entry", "remove the comma"),
        "trailing characters" => told("text after the end of the scene", "remove it, or check the brackets before"),
        "key must be a string" => told("a key without quotes", "write {\"name\": ...}"),
        "expected `:`" => told("no colon after a key", "write \"key\": value"),
        "number out of range" => told("a number beyond 1.8e308", "every number of a scene must be finite"),
        "recursion limit exceeded" => told("brackets more than 100 deep", "a scene needs no more than ten"),
        "invalid number" if before.ends_with(['0', '-']) => {
            told("an incomplete number", "write 10 and not 010, 0.5 and not -.5")
        }
        "invalid number" => told("an incomplete number", "digits are needed before and after a point, and after e"),
        "expected value" if next.is_alphabetic() || next == '(' => {
            told("text without quotes", "an expression goes in double quotes, as in \"2*l\"")
        }
        "expected value" => (format!("a value is missing before `{next}`"), "give a value, or remove the comma or key"),
        "expected ident" => {
            told("text without quotes", "text goes in double quotes; the words without are true, false and null")
        }
        "invalid escape" => told("a backslash that means nothing", "write \\\\ for a backslash"),
        _ if message.starts_with("expected `,` or") => {
            told("no comma between two entries", "put a comma after the entry before, or check its quotes and brackets")
        }
        _ if message.starts_with("control character") => {
            told("a line break or control character within text", "close the quotes on the line where they open")
        }
        _ => (message.to_string(), "check brackets, commas and quotes here and just before"),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn text_becomes_the_same_value_as_with_serde() {
        let text = r#"{ "a": [1, -2, 2.5e3, 18446744073709551615], "b": { "c": null, "a": true }, "ü": "x\n\u00e4" }"#;
        assert_eq!(read(text), Ok(serde_json::from_str(text).unwrap()));
    }

    #[test]
    fn faults_have_a_place_and_a_remedy() {
        let table = [
            ("{\"a\": 1, \"a\": 2}", "1:12", "the key `a` is given twice"),
            ("{\"a\": {\"x\": 1,\n\"x\": 2}}", "2:3", "the key `x` is given twice"),
            ("{\"a\": NaN}", "1:7", "`NaN`"),
            ("{\"a\": -Infinity}", "1:8", "`Infinity`"),
            ("{\"a\": 1e400}", "1:11", "a number beyond 1.8e308"),
            ("{\"a\": 1,}", "1:9", "a comma after the last entry"),
            ("{\"a\": 1 // one\n}", "1:9", "a comment"),
            ("{'a': 1}", "1:2", "a single quote"),
            ("{a: 1}", "1:2", "a key without quotes"),
            ("{\"ä\" 1}", "1:6", "no colon after a key"),
            ("{\"a\": l*2}", "1:7", "text without quotes"),
            ("{\"a\": }", "1:7", "a value is missing before `}`"),
            ("{\"a\": 010}", "1:8", "an incomplete number"),
            ("{\"a\": .5}", "1:7", "a number that begins with a point"),
            ("{\"a\": \"x\ny\"}", "1:9", "a line break or control character within text"),
            ("{\"a\": 1\n\"b\": 2}", "2:1", "no comma between two entries"),
            ("{\"a\": [1", "1:8", "the file ends too early"),
            ("{} }", "1:4", "text after the end of the scene"),
        ];
        for (text, place, found) in table {
            let Err(Error::Input(input)) = read(text) else { unreachable!("{text}") };
            let (line, column) = input.place.unwrap();
            assert_eq!(format!("{line}:{column}"), place, "{text}: {}", input.message);
            assert!(input.message.ends_with(found) && input.hint.is_some(), "{text}: {}", input.message);
        }
    }

    #[test]
    fn deep_brackets_are_refused() {
        let text = "[".repeat(100_000);
        assert!(read(&text).unwrap_err().to_string().contains("brackets more than 100 deep"));
    }
}
