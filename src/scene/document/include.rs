//! Other scenes in a scene.
//!
//! `"include": [{ "file": "leg.json", "as": "left", "parameters": { "l": "2*a" } }]` adds the bodies, joints, forces,
//! states, signals, inputs, outputs, markers of the ground and the start of another scene. Its names, those of its
//! parameters among them, begin with `left_`.

use super::budget::Budget;
use super::edit::{carrier, change_names, changed, elements, object};
use super::repeat::{self, Written};
use crate::body::{parse, show};
use crate::error::{Error, Result, excerpt, suggest};
use crate::math::array::Each;
use crate::math::expression::{Number, Parameters};
use crate::scene::format::Include;
use crate::scene::names::check_name;
use crate::scene::{folder, json, markers, place, read_text};
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
/// Includes in includes; more are taken for a mistake.
const DEEPEST: usize = 16;

/// Expands what is repeated and adds what is included, in `scene` whose files are found from `folder`.
pub fn complete(scene: &mut Value, folder: &Path, overrides: &[(String, Number)]) -> Result<Origins> {
    let around = Around { folder, files: &[], overrides };
    around.complete(scene, &mut Budget::default())
}

/// What surrounds a scene that includes others.
struct Around<'a> {
    /// Folder from which files are found.
    folder: &'a Path,
    /// The included scenes around it, and itself.
    files: &'a [PathBuf],
    overrides: &'a [(String, Number)],
}

impl Around<'_> {
    fn complete(&self, scene: &mut Value, budget: &mut Budget) -> Result<Origins> {
        let mut origins = Origins::default();
        if repeat::is_used(scene) {
            origins.written = repeat::expand(scene, &self.parameters(scene)?, budget)?;
        }
        let Some(given) = scene.as_object_mut().and_then(|keys| keys.shift_remove("include")) else {
            return Ok(origins);
        };
        let includes: Vec<Include> = parse(given).map_err(|error| error.under("include"))?;
        let outer = self.parameters(scene)?;
        for (i, include) in includes.iter().enumerate() {
            origins.included.push(self.add(scene, include, &outer, budget).map_err(|error| match &error {
                Error::Input(input) if input.file.is_some() => error,
                _ => error.under(format!("include[{i}]")),
            })?);
        }
        Ok(origins)
    }

    /// Values of the scene's own parameters; overrides of others are left to the whole scene.
    fn parameters(&self, scene: &Value) -> Result<Parameters> {
        let none = Map::new();
        let given = scene.get("parameters").and_then(Value::as_object).unwrap_or(&none);
        let own: Vec<_> = self.overrides.iter().filter(|(name, _)| given.contains_key(name)).cloned().collect();
        markers::resolve(given, &own)
    }

    fn add(
        &self,
        scene: &mut Value,
        include: &Include,
        outer: &Parameters,
        budget: &mut Budget,
    ) -> Result<IncludedScene> {
        check_name(&include.prefix).map_err(|error| error.under("as"))?;
        let path = self.folder.join(&include.file);
        let real = path.canonicalize().unwrap_or_else(|_| path.clone());
        if self.files.contains(&real) || self.files.len() > DEEPEST {
            return Err(Error::input(format!("`{}` includes itself", excerpt(&include.file)))
                .under("file")
                .hint("remove one"));
        }
        let text = read_text(&path).map_err(|error| match error {
            Error::File { problem, .. } => {
                Error::input(format!("`{}`: {problem}", excerpt(&include.file))).under("file")
            }
            other => other,
        })?;
        budget.take_include(&text)?;
        let prefix = format!("{}_", include.prefix);
        let overrides = inner_overrides(include, &prefix, outer, self.overrides)?;
        let within = |error: Error| place(error, &path, &text);
        let read = json::read(&text);
        let mut inner = read.and_then(|inner| check(&inner, scene).map(|()| inner)).map_err(within)?;
        check_parameters(&inner, include)?;
        let files: Vec<PathBuf> = self.files.iter().cloned().chain([real]).collect();
        let inside = Around { folder: folder(Some(&path)), files: &files, overrides: &overrides };
        let origins = inside.complete(&mut inner, budget).map_err(within)?;
        let names = IncludedNames::of(&inner, prefix.clone(), folder(Some(Path::new(&include.file))));
        let ranges = LISTS.each(|list| append(scene, list, &mut inner, &names));
        names.add_entries(scene, inner, &include.parameters)?;
        Ok(IncludedScene { path, text, prefix, ranges, inner: origins })
    }
}

/// Places of elements in the files that they are written in.
#[derive(Default)]
pub struct Origins {
    written: Written,
    included: Vec<IncludedScene>,
}

/// An included scene.
struct IncludedScene {
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

impl IncludedScene {
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
fn append(scene: &mut Value, list: &str, inner: &mut Value, names: &IncludedNames) -> (usize, usize) {
    let added = inner.get_mut(list).and_then(Value::as_array_mut).map(std::mem::take).unwrap_or_default();
    let Some(keys) = scene.as_object_mut() else { return (0, 0) };
    match keys.entry(list).or_insert_with(|| Value::Array(Vec::new())) {
        Value::Array(all) => {
            let range = (all.len(), added.len());
            all.extend(added.into_iter().map(|element| names.element(element)));
            range
        }
        _ => (0, 0),
    }
}

/// The names of an included scene, which get a prefix.
struct IncludedNames<'a> {
    prefix: String,
    /// Folder of the included scene from that of the including one.
    folder: &'a Path,
    known: HashSet<String>,
    /// Those that stand before brackets.
    signals: HashSet<String>,
    ground: HashSet<String>,
}

impl<'a> IncludedNames<'a> {
    fn of(inner: &Value, prefix: String, folder: &'a Path) -> Self {
        let of = |list: &str| -> Vec<String> {
            elements(inner, list)
                .iter()
                .filter_map(|element| Some(element.get("name")?.as_str()?.to_string()))
                .collect()
        };
        let keys = |pointer: &str| -> Vec<String> {
            inner.pointer(pointer).and_then(Value::as_object).map_or(Vec::new(), |map| map.keys().cloned().collect())
        };
        let known = LISTS.iter().flat_map(|list| of(list)).chain(keys("/parameters")).collect();
        let signals = of("signals").into_iter().collect();
        IncludedNames { prefix, folder, known, signals, ground: keys("/ground/markers").into_iter().collect() }
    }

    /// Adds parameters, markers of the ground and the start; `given` are parameters in terms of the including scene.
    fn add_entries(&self, scene: &mut Value, mut inner: Value, given: &Map<String, Value>) -> Result<()> {
        let Some(scene) = scene.as_object_mut() else { return Ok(()) };
        let mut taken = |pointer: &str| match inner.pointer_mut(pointer).map(Value::take) {
            Some(Value::Object(map)) => map,
            _ => Map::new(),
        };
        let with_prefix = |name: &str| format!("{}{name}", self.prefix);
        let parameters = taken("/parameters").into_iter().map(|(name, own)| {
            let value = given.get(&name).cloned().unwrap_or_else(|| self.renamed(own));
            (with_prefix(&name), value)
        });
        extend(object(scene, &["parameters"]), parameters)?;
        let markers = taken("/ground/markers").into_iter();
        let markers = markers.map(|(name, marker)| (with_prefix(&name), self.renamed(marker)));
        extend(object(scene, &["ground", "markers"]), markers)?;
        let start = taken("/initial").into_iter().map(|(name, value)| (self.text(&name), self.renamed(value)));
        extend(object(scene, &["initial"]), start)?;
        let hold = inner.pointer_mut("/assembly/hold").and_then(Value::as_array_mut).map(std::mem::take);
        let all = object(scene, &["assembly"]).map(|map| map.entry("hold").or_insert_with(|| Value::Array(Vec::new())));
        if let (Some(hold), Some(Value::Array(all))) = (hold, all) {
            all.extend(hold.into_iter().map(|name| self.renamed(name)));
        }
        Ok(())
    }

    fn element(&self, element: Value) -> Value {
        let mut element = self.renamed(element);
        if let Some(Value::String(name)) = element.get_mut("name") {
            *name = self.text(name);
        }
        if let Some(Value::String(file)) = element.get_mut("file") {
            *file = self.folder.join(&file).display().to_string();
        }
        element
    }

    fn renamed(&self, mut value: Value) -> Value {
        change_names(&mut value, &mut |word, after| self.word(word, after));
        value
    }

    fn text(&self, text: &str) -> String {
        changed(text, &mut |word, after| self.word(word, after))
    }

    /// The name with its parts, such as `crank.C.x`, with the prefix; `None` if it is none of the included scene's.
    fn word(&self, word: &str, after: &str) -> Option<String> {
        let of_ground = word.strip_prefix("ground.").filter(|marker| self.ground.contains(carrier(marker)));
        if let Some(marker) = of_ground {
            return Some(format!("ground.{}{marker}", self.prefix));
        }
        let known = if after.starts_with('(') { &self.signals } else { &self.known };
        known.contains(carrier(word)).then(|| format!("{}{word}", self.prefix))
    }
}

/// Adds entries with new names.
fn extend(all: Option<&mut Map<String, Value>>, added: impl Iterator<Item = (String, Value)>) -> Result<()> {
    // The checks of the whole scene refuse what is no object.
    let Some(all) = all else { return Ok(()) };
    for (name, value) in added {
        if all.contains_key(&name) {
            return Err(Error::input(format!("the name `{}` is taken", excerpt(&name)))
                .under("as")
                .hint("choose another \"as\""));
        }
        all.insert(name, value);
    }
    Ok(())
}
