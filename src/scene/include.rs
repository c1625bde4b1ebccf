//! Other scenes in a scene.
//!
//! `"include": [{ "file": "leg.json", "as": "left", "parameters": { "l": "2*a" } }]` adds the bodies, joints, forces,
//! states, signals, inputs, outputs, markers of the ground and the start of another scene. Its names, those of its
//! parameters among them, begin with `left_`.

use super::budget::Budget;
use super::format::Include;
use super::names::check_name;
use super::repeat::{self, Written};
use super::{folder, json, markers, place, read_text};
use crate::body::{parse, show};
use crate::error::{Error, Result, excerpt, suggest};
use crate::math::array::Each;
use crate::math::expression::{Number, Parameters};
use serde_json::{Map, Value};
use std::collections::HashSet;
use std::path::{Path, PathBuf};

/// Lists whose elements are added.
const LISTS: [&str; 7] = ["bodies", "joints", "forces", "states", "signals", "inputs", "outputs"];
/// Other keys that an included scene may have; what it says of gravity and simulation does not count.
const OTHERS: [&str; 12] = [
    "$schema",
    "name",
    "about",
    "references",
    "tags",
    "dimension",
    "parameters",
    "gravity",
    "ground",
    "initial",
    "assembly",
    "simulation",
];
/// Keys whose text is a word of the format, which names nothing.
const WORDS: [&str; 10] =
    ["type", "measure", "component", "coordinate", "unit", "free", "frame", "columns", "interpolation", "beyond"];
/// Includes in includes; more are taken for a mistake.
const DEEPEST: usize = 16;

/// Values of the scene's own parameters, for repetitions and includes; overrides of others are left to the whole scene.
pub fn own_parameters(scene: &Value, overrides: &[(String, Number)]) -> Result<Parameters> {
    let none = Map::new();
    let given = scene.get("parameters").and_then(Value::as_object).unwrap_or(&none);
    let own: Vec<_> = overrides.iter().filter(|(name, _)| given.contains_key(name)).cloned().collect();
    markers::resolve(given, &own)
}

/// Expands what is repeated and adds what is included, in `scene` whose files are found from `folder`.
pub fn complete(scene: &mut Value, folder: &Path, overrides: &[(String, Number)]) -> Result<Origins> {
    completed(scene, folder, overrides, (&[], &mut Budget::default()))
}

fn completed(
    scene: &mut Value,
    folder: &Path,
    overrides: &[(String, Number)],
    (around, budget): (&[PathBuf], &mut Budget),
) -> Result<Origins> {
    let mut origins = Origins::default();
    if repeat::is_used(scene) {
        origins.written = repeat::expand(scene, &own_parameters(scene, overrides)?, budget)?;
    }
    let Some(given) = scene.as_object_mut().and_then(|keys| keys.shift_remove("include")) else { return Ok(origins) };
    let includes: Vec<Include> = parse(given).map_err(|error| error.under("include"))?;
    let outer = own_parameters(scene, overrides)?;
    for (i, include) in includes.iter().enumerate() {
        let added = add(scene, include, (folder, around), (&outer, overrides), budget);
        origins.included.push(added.map_err(|error| match &error {
            Error::Input(input) if input.file.is_some() => error,
            _ => error.under(format!("include[{i}]")),
        })?);
    }
    Ok(origins)
}

/// Places of elements in the files that they are written in.
#[derive(Default)]
pub struct Origins {
    written: Written,
    included: Vec<Origin>,
}

/// An included scene.
struct Origin {
    path: PathBuf,
    text: String,
    prefix: String,
    /// Index of its first element, and their number, for each of [`LISTS`].
    ranges: [(usize, usize); 7],
    inner: Origins,
}

impl Origins {
    /// The error with its path as it is written, and the file if that is another.
    pub fn place(&self, error: Error) -> Error {
        let Error::Input(input) = &error else { return error };
        let found = self.included.iter().find_map(|origin| Some((origin, origin.own(&input.path)?)));
        match found {
            None => self.written.place(error),
            Some((origin, path)) => {
                let error = origin.inner.place(error.at(path));
                place(error, &origin.path, &origin.text)
            }
        }
    }
}

impl Origin {
    /// The path within the included scene, before its own repetitions and includes.
    fn own(&self, path: &str) -> Option<String> {
        for key in ["parameters.", "ground.markers."] {
            if let Some(rest) = path.strip_prefix(key).and_then(|rest| rest.strip_prefix(&self.prefix)) {
                return Some(format!("{key}{rest}"));
            }
        }
        let (list, rest) = path.split_once('[')?;
        let (index, rest) = rest.split_once(']')?;
        let (first, count) = self.ranges[LISTS.iter().position(|known| *known == list)?];
        let index = index.parse::<usize>().ok()?.checked_sub(first).filter(|index| *index < count)?;
        Some(format!("{list}[{index}]{rest}"))
    }
}

/// Adds an included scene.
fn add(
    scene: &mut Value,
    include: &Include,
    (folder_of_scene, around): (&Path, &[PathBuf]),
    (outer, overrides): (&Parameters, &[(String, Number)]),
    budget: &mut Budget,
) -> Result<Origin> {
    check_name(&include.prefix).map_err(|error| error.under("as"))?;
    let path = folder_of_scene.join(&include.file);
    let real = path.canonicalize().unwrap_or_else(|_| path.clone());
    if around.contains(&real) || around.len() > DEEPEST {
        return Err(Error::input(format!("`{}` includes itself", excerpt(&include.file)))
            .under("file")
            .hint("remove one"));
    }
    let text = read_text(&path).map_err(|error| match error {
        Error::File { problem, .. } => Error::input(format!("`{}`: {problem}", excerpt(&include.file))).under("file"),
        other => other,
    })?;
    budget.take_include(&text)?;
    let prefix = format!("{}_", include.prefix);
    let overrides = inner_overrides(include, &prefix, outer, overrides)?;
    let within = |error: Error| place(error, &path, &text);
    let read = json::read(text.strip_prefix('\u{feff}').unwrap_or(&text));
    let mut inner = read.and_then(|inner| check(&inner, scene).map(|()| inner)).map_err(within)?;
    check_parameters(&inner, include)?;
    let around: Vec<PathBuf> = around.iter().cloned().chain([real]).collect();
    let origins = completed(&mut inner, folder(Some(&path)), &overrides, (&around, budget)).map_err(within)?;
    let names = Names::of(&inner, prefix.clone(), folder(Some(Path::new(&include.file))));
    let ranges = LISTS.each(|list| append(scene, list, &mut inner, &names));
    names.add_entries(scene, inner, &include.parameters)?;
    Ok(Origin { path, text, prefix, ranges, inner: origins })
}

/// Values of the included scene's parameters that are given from outside.
fn inner_overrides(
    include: &Include,
    prefix: &str,
    outer: &Parameters,
    overrides: &[(String, Number)],
) -> Result<Vec<(String, Number)>> {
    let given = markers::parameters(&include.parameters)?;
    let set =
        overrides.iter().filter_map(|(name, number)| Some((name.strip_prefix(prefix)?.to_string(), number.clone())));
    let value = |(name, number): (String, Number)| match number.evaluate(outer) {
        Ok(value) => Ok((name, Number::Value(value))),
        Err(error) => Err(Error::from(error).under(&name).under("parameters")),
    };
    given.into_iter().chain(set).map(value).collect()
}

/// Refuses what is no scene to include.
fn check(inner: &Value, scene: &Value) -> Result<()> {
    let Some(keys) = inner.as_object() else {
        return Err(Error::input(format!("a scene is a JSON object, found {}", show(inner))));
    };
    let known = || LISTS.into_iter().chain(OTHERS).chain(["include"]);
    if let Some(key) = keys.keys().find(|key| !known().any(|known| known == *key)) {
        return Err(Error::input(format!("a scene with `{}` cannot be included", excerpt(key)))
            .under(key)
            .hint(suggest(key, known())));
    }
    if inner.get("dimension") == scene.get("dimension") {
        Ok(())
    } else {
        Err(Error::input("the dimension is not that of the scene that includes it").under("dimension"))
    }
}

fn check_parameters(inner: &Value, include: &Include) -> Result<()> {
    let none = Map::new();
    let known = inner.get("parameters").and_then(Value::as_object).unwrap_or(&none);
    match include.parameters.keys().find(|name| !known.contains_key(*name)) {
        None => Ok(()),
        Some(name) => Err(Error::input(format!("the included scene has no parameter `{}`", excerpt(name)))
            .under("parameters")
            .hint(suggest(name, known.keys().map(String::as_str)))),
    }
}

/// Appends the elements of a list; returns the index of the first and their number.
fn append(scene: &mut Value, list: &str, inner: &mut Value, names: &Names) -> (usize, usize) {
    let added = inner.get_mut(list).and_then(Value::as_array_mut).map(std::mem::take).unwrap_or_default();
    let Some(keys) = scene.as_object_mut() else { return (0, 0) };
    match keys.entry(list).or_insert_with(|| Value::Array(Vec::new())) {
        Value::Array(all) => {
            let range = (all.len(), added.len());
            all.extend(added.into_iter().map(|element| names.renamed(element, "")));
            range
        }
        _ => (0, 0),
    }
}

/// The names of an included scene, which get a prefix.
struct Names<'a> {
    prefix: String,
    /// Folder of the included scene from that of the including one.
    folder: &'a Path,
    known: HashSet<String>,
    /// Those that stand before brackets.
    signals: HashSet<String>,
    ground: HashSet<String>,
}

impl<'a> Names<'a> {
    fn of(inner: &Value, prefix: String, folder: &'a Path) -> Self {
        let of = |list: &str| -> Vec<String> {
            let elements = inner.get(list).and_then(Value::as_array).into_iter().flatten();
            elements.filter_map(|element| element.get("name")?.as_str().map(str::to_string)).collect()
        };
        let names = LISTS.iter().flat_map(|list| of(list));
        let keys = |value: Option<&Value>| -> Vec<String> {
            value.and_then(Value::as_object).map_or(Vec::new(), |map| map.keys().cloned().collect())
        };
        let known = names.chain(keys(inner.get("parameters"))).collect();
        let ground = keys(inner.pointer("/ground/markers")).into_iter().collect();
        Names { prefix, folder, known, signals: of("signals").into_iter().collect(), ground }
    }

    /// Adds parameters, markers of the ground and the start; `given` are parameters in terms of the including scene.
    fn add_entries(&self, scene: &mut Value, mut inner: Value, given: &Map<String, Value>) -> Result<()> {
        let mut taken = |pointer: &str| match inner.pointer_mut(pointer).map(Value::take) {
            Some(Value::Object(map)) => map,
            _ => Map::new(),
        };
        let parameters = taken("/parameters").into_iter().map(|(name, own)| {
            let value = given.get(&name).cloned().unwrap_or_else(|| self.renamed(own, ""));
            (format!("{}{name}", self.prefix), value)
        });
        extend(object(scene, "parameters"), parameters.collect())?;
        let markers = taken("/ground/markers").into_iter();
        let markers = markers.map(|(name, marker)| (format!("{}{name}", self.prefix), self.renamed(marker, "")));
        let ground = object(scene, "ground")
            .and_then(|ground| ground.entry("markers").or_insert_with(|| Value::Object(Map::new())).as_object_mut());
        extend(ground, markers.collect())?;
        let start = taken("/initial").into_iter().map(|(name, value)| (self.text(&name), self.renamed(value, "")));
        extend(object(scene, "initial"), start.collect())?;
        let hold = inner.pointer_mut("/assembly/hold").and_then(Value::as_array_mut).map(std::mem::take);
        let all = object(scene, "assembly")
            .and_then(|assembly| assembly.entry("hold").or_insert_with(|| Value::Array(Vec::new())).as_array_mut());
        if let (Some(hold), Some(all)) = (hold, all) {
            all.extend(hold.into_iter().map(|name| self.renamed(name, "")));
        }
        Ok(())
    }

    /// The value with prefixes in its text; `key` is the one that it belongs to.
    fn renamed(&self, value: Value, key: &str) -> Value {
        match value {
            Value::String(text) if WORDS.contains(&key) => Value::String(text),
            Value::String(text) if key == "file" => Value::String(self.folder.join(text).display().to_string()),
            Value::String(text) => Value::String(self.text(&text)),
            Value::Array(items) => Value::Array(items.into_iter().map(|item| self.renamed(item, key)).collect()),
            Value::Object(map) => {
                Value::Object(map.into_iter().map(|(key, value)| (key.clone(), self.renamed(value, &key))).collect())
            }
            other => other,
        }
    }

    /// A reference or expression with prefixes before the names of the included scene.
    fn text(&self, text: &str) -> String {
        let mut out = String::new();
        let mut rest = text;
        while let Some(first) = rest.chars().next() {
            let length = word_length(rest).max(first.len_utf8());
            let (word, after) = rest.split_at(length);
            let is_name = first.is_alphabetic() || first == '_';
            out += &if is_name { self.word(word, after.starts_with('(')) } else { word.to_string() };
            rest = after;
        }
        out
    }

    /// A name with its parts, such as `crank.C.x`.
    fn word(&self, word: &str, is_function: bool) -> String {
        let (first, rest) = word.split_once('.').map_or((word, None), |(first, rest)| (first, Some(rest)));
        let name = first.trim_end_matches('\'');
        match rest {
            Some(rest) if first == "ground" && self.ground.contains(rest.split('.').next().unwrap_or("")) => {
                format!("ground.{}{rest}", self.prefix)
            }
            _ if if is_function { &self.signals } else { &self.known }.contains(name) => {
                format!("{}{word}", self.prefix)
            }
            _ => word.to_string(),
        }
    }
}

/// Bytes of the name with its dots and primes, or of the number, at the beginning.
fn word_length(text: &str) -> usize {
    let is_number = text.starts_with(|c: char| c.is_ascii_digit());
    let mut last = ' ';
    let mut end = 0;
    for (at, c) in text.char_indices() {
        // The sign of an exponent.
        let is_sign = is_number && "+-".contains(c) && "eE".contains(last);
        if !(c.is_alphanumeric() || "_.'".contains(c) || is_sign) {
            break;
        }
        (last, end) = (c, at + c.len_utf8());
    }
    end
}

/// Adds entries with new names.
fn extend(all: Option<&mut Map<String, Value>>, added: Vec<(String, Value)>) -> Result<()> {
    // The checks of the whole scene refuse what is no object.
    let Some(all) = all else { return Ok(()) };
    match added.iter().find(|(name, _)| all.contains_key(name)) {
        Some((name, _)) => Err(Error::input(format!("the name `{}` is taken", excerpt(name)))
            .under("as")
            .hint("choose another \"as\"")),
        None => {
            all.extend(added);
            Ok(())
        }
    }
}

/// The object at a key of the scene, made if it is missing.
fn object<'a>(scene: &'a mut Value, key: &str) -> Option<&'a mut Map<String, Value>> {
    scene.as_object_mut()?.entry(key).or_insert_with(|| Value::Object(Map::new())).as_object_mut()
}
