//! Where results come from: what it takes to repeat them, and what they replace.

use crate::error::Warning;
use crate::math::expression::Parameters;
use crate::simulate::Method;
use serde::{Deserialize, Serialize};
use serde_json::{Map, Value};
use std::fs::{File, Metadata};
use std::io::BufReader;
use std::path::Path;

/// What it takes to repeat a run, and reasons to doubt it.
#[derive(Clone, Debug, Serialize)]
pub struct Origin {
    pub holonom: &'static str,
    pub command: Vec<String>,
    pub parameters: Map<String, Value>,
    /// Reasons to doubt the result; empty where none is known.
    pub warnings: Vec<Warning>,
    /// Method by which the motion is simulated; none where nothing is, or where the result has it.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub simulation: Option<Method>,
}

impl Origin {
    pub fn new(parameters: &Parameters, warnings: Vec<Warning>) -> Self {
        let parameters = parameters.iter().map(|(name, value)| (name.to_string(), Value::from(value))).collect();
        Origin { holonom: env!("CARGO_PKG_VERSION"), command: Vec::new(), parameters, warnings, simulation: None }
    }
}

/// A result with its origin, and with the names of the files that were written with it.
#[derive(Clone, Debug, Serialize)]
pub struct Sealed<T> {
    /// None where the result has it.
    #[serde(flatten)]
    pub origin: Option<Origin>,
    #[serde(flatten)]
    pub result: T,
    /// Empty of what is printed alone.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    pub files: Vec<String>,
}

/// The settings of a result as its file has them.
#[derive(Deserialize, Default)]
#[serde(default)]
pub(super) struct ResultSettings {
    pub command: Vec<String>,
    parameters: Map<String, Value>,
    simulation: Option<Value>,
    method: Option<Value>,
    pub files: Vec<String>,
}

/// Options that change no result; those that take a value.
const SILENT: [&str; 3] = ["--json", "--quiet", "--resume"];
const SILENT_WITH_VALUE: [&str; 3] = ["--figures", "--format", "-o"];
/// Keys of a method that are settings.
const METHOD: [&str; 6] = ["formulation", "integrator", "projection", "rtol", "atol", "step"];
/// Largest number of settings that are named.
const NAMED: usize = 4;

impl ResultSettings {
    /// Reads those of a result. The file is large where there are many coordinates, and little of it is kept.
    pub fn read(path: &Path) -> Option<ResultSettings> {
        // A pipe would wait for a writer.
        let file = std::fs::metadata(path).ok().filter(Metadata::is_file).and_then(|_| File::open(path).ok())?;
        serde_json::from_reader(BufReader::new(file)).ok()
    }

    /// Returns what became of earlier results with other settings; `None` if these are the same.
    pub fn replaced_by(&self, new: &ResultSettings) -> Option<String> {
        let changes = self.changes(new);
        let goes_on = new.command.iter().any(|word| word == "--resume");
        let is_same = changes.is_empty() && (goes_on || self.telling() == new.telling());
        (!is_same).then(|| {
            let command = ["holonom"].into_iter().chain(self.telling()).collect::<Vec<_>>().join(" ");
            let changes = if changes.is_empty() { String::new() } else { format!(" ({})", changes.join(", ")) };
            format!("the results of `{command}`{changes}")
        })
    }

    /// Returns the words of the command on which results depend.
    fn telling(&self) -> Vec<&str> {
        let is_assigned =
            |word: &str, option: &str| word.strip_prefix(option).is_some_and(|rest| rest.starts_with('='));
        let mut words = self.command.iter().skip(1).map(String::as_str);
        let mut telling = Vec::new();
        while let Some(word) = words.next() {
            if SILENT_WITH_VALUE.contains(&word) {
                words.next();
            } else if !SILENT.contains(&word) && !SILENT_WITH_VALUE.iter().any(|option| is_assigned(word, option)) {
                telling.push(word);
            }
        }
        telling
    }

    /// Returns the settings that differ, with their earlier values.
    fn changes(&self, new: &ResultSettings) -> Vec<String> {
        let old = self.values();
        let new = new.values();
        let differs =
            |(name, value): &(&str, &Value)| new.iter().find(|(known, _)| known == name).map(|x| x.1) != Some(value);
        let mut changes: Vec<String> =
            old.into_iter().filter(differs).map(|(name, value)| format!("{name} was {}", plain(value))).collect();
        if changes.len() > NAMED {
            changes.truncate(NAMED);
            changes.push("...".to_string());
        }
        changes
    }

    fn values(&self) -> Vec<(&str, &Value)> {
        let method = self.simulation.as_ref().or(self.method.as_ref());
        let of_method = METHOD.into_iter().filter_map(|key| Some((key, method?.get(key)?)));
        self.parameters.iter().map(|(name, value)| (name.as_str(), value)).chain(of_method).collect()
    }
}

fn plain(value: &Value) -> String {
    match value {
        Value::Number(number) => number.as_f64().map_or(number.to_string(), crate::error::short),
        Value::Null => "not given".to_string(),
        other => other.as_str().map_or(other.to_string(), str::to_string),
    }
}
