//! `holonom reference`

use super::common::{pick, print, to_json};
use crate::error::Result;
use crate::math::expression::LANGUAGE;
use crate::prepared;
use crate::report::TextTable;
use crate::scene::units::Dimension;
use crate::scene::{Elements, MeasureKind};
use serde_json::Value;

#[derive(clap::Args)]
#[command(after_help = "Examples:
  holonom reference expressions
  holonom reference spring_damper")]
pub struct Args {
    /// A key of a scene or of an element, such as bodies, simulation or section; a type, such as revolute; a measure,
    /// such as reaction; expressions, units or measures (default: a list of all)
    #[arg(value_name = "TOPIC")]
    topic: Option<String>,
}

const ELEMENTS: [&str; 3] = ["bodies", "joints", "forces"];

/// References in references that are followed: a schema may refer to itself.
const DEEPEST: usize = 6;

const WIDTH: usize = 110;

pub fn run(args: Args) -> Result<()> {
    let reference = FormatReference { schema: prepared::schema(&Elements::default()) };
    let text = match &args.topic {
        None => reference.all(),
        Some(topic) => reference.topic(topic)?,
    };
    print(&text)
}

pub fn schema() -> Result<()> {
    print(&to_json(&prepared::schema(&Elements::default()))?)
}

/// A key of elements, with those that have it in this meaning.
struct InnerKey<'v> {
    name: &'v str,
    value: &'v Value,
    owners: Vec<&'v str>,
}

struct FormatReference {
    schema: Value,
}

impl FormatReference {
    fn all(&self) -> String {
        let mut text = format!("{}\n\n{}", wrapped(&plain(&self.schema), 0), self.keys(&self.schema));
        for key in ELEMENTS {
            text += &format!("\n{key}, each with a \"type\"\n{}", self.types(key));
        }
        text += &format!("\noutputs, each with a \"measure\"\n{}", self.measures());
        text + "\nMore: holonom reference TOPIC, a key or a type of these, expressions, or units; holonom methods\n"
    }

    fn topic(&self, topic: &str) -> Result<String> {
        let inner = self.inner_keys();
        let own = ["expressions", "units", "measures"].into_iter();
        let own = own.chain(self.own_keys()).chain(self.all_types().map(|kind| kind.0));
        let all = own.chain(self.measure_names()).chain(inner.iter().map(|key| key.name));
        let mut names: Vec<&str> = Vec::new();
        all.for_each(|name| {
            if !names.contains(&name) {
                names.push(name)
            }
        });
        let topic = if topic == "unit" { "units" } else { topic };
        let is_type = |name: &str| self.all_types().any(|kind| kind.0 == name);
        let is_measure = |name: &str| self.measure_names().any(|measure| measure == name);
        Ok(match pick("topic", topic, &names)? {
            "expressions" => language(),
            "units" => units(),
            "measures" => self.measures(),
            name if is_measure(name) && !is_type(name) => self.measure(name),
            name if !is_type(name) && !self.own_keys().any(|known| known == name) => {
                inner.iter().filter(|key| key.name == name).map(|key| self.inner(key)).collect::<Vec<_>>().join("\n")
            }
            key if ELEMENTS.contains(&key) => self.types(key),
            "outputs" => {
                let output = self.output();
                format!("{}\n\n{}\n{}", plain(output), self.keys(output), self.measures())
            }
            name => {
                let kind = self.all_types().find(|kind| kind.0 == name).map(|kind| kind.1);
                let place = kind.unwrap_or(&self.schema["properties"][name]);
                let object = self.resolved(place.get("items").unwrap_or(place));
                let is_object = object.get("properties").is_some();
                let own = plain(place);
                let about = if own.is_empty() { plain(object) } else { own };
                let gap = if is_object { "\n\n" } else { "\n" };
                format!("{name}: {}{gap}{}", wrapped(&about, 0), self.nested_keys(object))
            }
        })
    }

    fn own_keys(&self) -> impl Iterator<Item = &str> {
        properties(&self.schema).map(|(name, _)| name).filter(|name| !name.starts_with('$'))
    }

    fn elements(&self, key: &str) -> impl Iterator<Item = &Value> {
        list(&self.schema["properties"][key]["items"]["oneOf"])
    }

    fn all_types(&self) -> impl Iterator<Item = (&str, &Value)> {
        ELEMENTS.iter().flat_map(|key| self.elements(key)).map(|kind| (name(kind), kind))
    }

    fn output(&self) -> &Value {
        self.resolved(&self.schema["properties"]["outputs"]["items"])
    }

    fn measure_kinds(&self) -> impl Iterator<Item = &Value> {
        list(&self.schema["$defs"]["MeasureKind"]["oneOf"])
    }

    fn about(&self, value: &Value) -> String {
        let own = plain(value);
        if own.is_empty() { plain(self.resolved(value)) } else { own }
    }

    /// Returns the types of an element with the first sentence on each.
    fn types(&self, key: &str) -> String {
        let mut table = TextTable::left(&["type", ""]);
        for kind in self.elements(key) {
            let about = plain(kind);
            let first = about.split_once(": ").filter(|(head, _)| !head.contains('.')).map_or(about.as_str(), |x| x.0);
            let first = first.split_once(". ").map_or(first, |x| x.0).trim_end_matches('.');
            table.row([name(kind).to_string(), first.to_string()]);
        }
        table.to_string()
    }

    /// Returns the keys of elements and outputs, each once for each meaning that it has.
    fn inner_keys(&self) -> Vec<InnerKey<'_>> {
        let mut found: Vec<InnerKey> = Vec::new();
        for (owner, object) in self.all_types().chain([("outputs", self.output())]) {
            for (name, value) in properties(object).filter(|(name, _)| *name != "type") {
                match found.iter_mut().find(|key| key.name == name && key.value == value) {
                    Some(key) => key.owners.push(owner),
                    None => found.push(InnerKey { name, value, owners: vec![owner] }),
                }
            }
        }
        found
    }

    /// Returns what a key of elements means, and what it contains.
    fn inner(&self, InnerKey { name, value, owners }: &InnerKey) -> String {
        let text = format!("{name} of {}: {}", owners.join(", "), self.about(value));
        format!(
            "{}\n{}{}",
            wrapped(text.trim_end_matches([':', ' ']), 0),
            self.choices(value).trim_start_matches('\n'),
            self.contents(value)
        )
    }

    /// Returns the keys of each form that a value may have, with those of the values in them.
    fn contents(&self, value: &Value) -> String {
        let mut text = String::new();
        for form in self.forms(value, DEEPEST) {
            let keys: Vec<&str> = properties(form).map(|(name, _)| name).collect();
            let about = format!("{{ {} }} {}", keys.join(", "), plain(form));
            text += &format!("\n  {}\n{}", wrapped(&about, 2), self.keys(form));
            for (name, value) in properties(form) {
                for inner in self.forms(value, DEEPEST) {
                    text += &format!("\n{name}\n{}", self.keys(inner));
                }
            }
        }
        text
    }

    /// Returns the objects that a value may be, or that it has by name.
    fn forms<'v>(&'v self, value: &'v Value, deepest: usize) -> Vec<&'v Value> {
        if properties(value).next().is_some() {
            return vec![value];
        }
        if deepest == 0 {
            return Vec::new();
        }
        let reference = value["$ref"].as_str().and_then(|path| self.schema.pointer(path.trim_start_matches('#')));
        let choices = ["anyOf", "oneOf"].into_iter().flat_map(|key| list(&value[key]));
        let parts = ["items", "additionalProperties"].into_iter().filter_map(|key| value.get(key));
        choices.chain(parts).chain(reference).flat_map(|one| self.forms(one, deepest - 1)).collect()
    }

    fn measure_names(&self) -> impl Iterator<Item = &str> {
        self.measure_kinds().filter_map(|kind| kind["const"].as_str())
    }

    /// Returns what a measure is, and the keys that go with it.
    fn measure(&self, measure: &str) -> String {
        let kind = self.measure_kinds().find(|kind| kind["const"] == measure).unwrap_or(&Value::Null);
        let keys = keys_of(kind);
        let mut object = self.output().clone();
        if let Some(all) = object["properties"].as_object_mut() {
            all.retain(|name, _| keys.contains(&name.as_str()) || ["name", "unit"].contains(&name.as_str()));
        }
        format!("measure {measure}: {}\n\n{}", wrapped(&plain(kind), 0), self.keys(&object))
    }

    fn measures(&self) -> String {
        let mut table = TextTable::left(&["measure", "keys", "unit, and what it is"]);
        for kind in self.measure_kinds() {
            let name = kind["const"].as_str().unwrap_or_default();
            table.row([name.to_string(), keys_of(kind).join(", "), plain(kind)]);
        }
        table.to_string()
    }

    /// Returns the keys of an object, and of objects in it, with what they mean.
    fn nested_keys(&self, object: &Value) -> String {
        let mut text = self.keys(object);
        for (name, value) in properties(object) {
            let inner = self.contents(value);
            if !inner.is_empty() {
                text += &format!("\n{name}\n{}", inner.trim_start_matches('\n'));
            }
        }
        text
    }

    fn keys(&self, object: &Value) -> String {
        let required = |name: &str| list(&object["required"]).any(|one| one == name);
        let keys = properties(object).filter(|(name, _)| !name.starts_with('$'));
        let line = |(name, value): (&str, &Value)| {
            let about = self.about(value);
            let needed = if required(name) { " (required)" } else { "" };
            let about = if about.is_empty() { about } else { format!("\n      {}", wrapped(&about, 6)) };
            format!("  {name}{needed}{about}{}\n", self.choices(value))
        };
        keys.map(line).collect()
    }

    fn choices(&self, value: &Value) -> String {
        let alternatives = value["anyOf"].as_array().map_or(vec![value], |all| all.iter().collect());
        let words = alternatives.into_iter().map(|one| self.resolved(one)).flat_map(|one| {
            let named = list(&one["oneOf"]).filter_map(|each| each.get("const"));
            list(&one["enum"]).chain(named).map(Value::to_string)
        });
        let words: Vec<String> = words.map(|word| word.trim_matches('"').to_string()).collect();
        if words.is_empty() { String::new() } else { format!("\n      {}", wrapped(&words.join(", "), 6)) }
    }

    /// Returns the definition that a value refers to, the last of a chain of them, or the value.
    fn resolved<'v>(&'v self, value: &'v Value) -> &'v Value {
        let reference = [value].into_iter().chain(list(&value["anyOf"])).find_map(|one| one["$ref"].as_str());
        let found = reference.and_then(|path| self.schema.pointer(path.trim_start_matches('#')));
        found.map_or(value, |found| if found.get("properties").is_some() { found } else { self.resolved(found) })
    }
}

fn list(value: &Value) -> impl Iterator<Item = &Value> {
    value.as_array().into_iter().flatten()
}

fn keys_of(kind: &Value) -> &'static [&'static str] {
    serde_json::from_value(kind["const"].clone()).map_or(&[][..], MeasureKind::keys)
}

fn properties(object: &Value) -> impl Iterator<Item = (&str, &Value)> {
    object["properties"].as_object().into_iter().flatten().map(|(name, value)| (name.as_str(), value))
}

fn name(kind: &Value) -> &str {
    kind["properties"]["type"]["const"].as_str().unwrap_or_default()
}

fn plain(value: &Value) -> String {
    value["description"].as_str().unwrap_or_default().replace('\n', " ")
}

/// Returns the text in lines of at most 110 characters, all but the first with this indentation.
fn wrapped(text: &str, indentation: usize) -> String {
    let mut wrapped = String::new();
    let mut width = indentation;
    for word in text.split_whitespace() {
        let length = word.chars().count() + 1;
        if width + length > WIDTH {
            wrapped += &format!("\n{}", " ".repeat(indentation));
            width = indentation;
        } else if !wrapped.is_empty() {
            wrapped.push(' ');
        }
        wrapped += word;
        width += length;
    }
    wrapped
}

fn language() -> String {
    let mut text = String::new();
    let mut table: Option<TextTable> = None;
    for line in LANGUAGE.lines().chain([""]) {
        let cells = line.strip_prefix('|').and_then(|line| line.strip_suffix('|'));
        let Some(cells) = cells.map(|cells| cells.replace("\\|", "\u{0}").replace('`', "")) else {
            text.extend(table.take().map(|table| table.to_string()));
            text += &format!("{}\n", line.trim_start_matches("# ").replace('`', ""));
            continue;
        };
        let cells: Vec<String> = cells.split('|').map(|cell| cell.trim().replace('\u{0}', "|")).collect();
        match &mut table {
            _ if cells[0].starts_with("--") => {}
            Some(table) => table.row(cells),
            none => *none = Some(TextTable::left(&cells.iter().map(String::as_str).collect::<Vec<_>>())),
        }
    }
    text.trim_end().to_string() + "\n"
}

fn units() -> String {
    let mut table = TextTable::left(&["quantity", "units, that of the SI first"]);
    for dimension in Dimension::all() {
        table.row([dimension.word().to_string(), dimension.units().collect::<Vec<_>>().join(", ")]);
    }
    format!(
        "{table}\nAn expression is converted from the SI to its \"unit\"; a word that is not here stands on axes alone.\n"
    )
}
