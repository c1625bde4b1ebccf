//! The rows of a study, with all that they depend on.

use super::plan::Plan;
use super::study::Study;
use crate::error::{Error, Result, excerpt};
use crate::prepared::Model;
use crate::study::pool::{cores, into_inner, locked, run_all};
use crate::system::Column;
use serde_json::{Map, Value, json};
use std::collections::BTreeMap;
use std::path::{Path, PathBuf};
use std::str::FromStr;
use std::sync::Mutex;

/// A part of the rows: every N-th, so that parts take equally long.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Shard {
    /// Number of the part, from 1.
    pub index: usize,
    /// Number of parts.
    pub count: usize,
}

impl FromStr for Shard {
    type Err = Error;

    fn from_str(text: &str) -> Result<Shard> {
        let numbers = text.split_once('/').and_then(|(i, n)| Some((i.trim().parse().ok()?, n.trim().parse().ok()?)));
        match numbers {
            Some((index, count)) if 1 <= index && index <= count => Ok(Shard { index, count }),
            _ => Err(Error::input(format!("`{text}` is no part; write I/N with I from 1 to N, as in 3/8"))),
        }
    }
}

impl Shard {
    /// True if a row belongs to it.
    pub fn has(self, row: usize) -> bool {
        row % self.count == self.index - 1
    }
}

/// A variant with its numbers.
#[derive(Clone, Debug, Default)]
pub struct StudyRow {
    /// Values of the parameters, then the recorded numbers; not a number where there is none.
    pub values: Vec<f64>,
    /// The reason why it failed; empty where it did not.
    pub failure: String,
}

/// Equal bit by bit.
impl PartialEq for StudyRow {
    fn eq(&self, other: &StudyRow) -> bool {
        let bits = |row: &StudyRow| row.values.iter().map(|value| value.to_bits()).collect::<Vec<u64>>();
        self.failure == other.failure && bits(self) == bits(other)
    }
}

/// The rows of a study that are there.
#[derive(Clone, Debug)]
pub struct StudyTable {
    /// All that the rows depend on, by its name: scene, variants, method, version.
    pub identity: Map<String, Value>,
    /// Beginning of the commands that compute one variant alone, which its values follow.
    pub again: Vec<Vec<String>>,
    /// Number of variants of the whole study.
    pub count: usize,
    /// Number of parameters, which are the first columns.
    pub parameters: usize,
    /// Names and units of the parameters and of the recorded numbers.
    pub columns: Vec<Column>,
    /// The rows that are done, by their number from 0.
    pub rows: BTreeMap<usize, StudyRow>,
}

/// Heading of the numbers of the rows.
const ROW: &str = "row";
/// Heading of the reasons why variants failed.
const FAILURE: &str = "failure";

impl StudyTable {
    /// A table without rows, of a study whose nominal variant is `prepared`; `again` is the beginning of the commands
    /// that compute one variant alone.
    pub fn new(study: &Study, plan: &Plan, prepared: &Model, again: Vec<Vec<String>>) -> StudyTable {
        let parameter = |name: &String| Column { name: name.clone(), unit: String::new() };
        let columns: Vec<Column> = plan.names.iter().map(parameter).chain(study.columns()).collect();
        let nominal: Map<String, Value> =
            prepared.parameters.iter().map(|(name, value)| (name.to_string(), value.into())).collect();
        let identity = json!({
            "scene": prepared.name,
            "scene_hash": prepared.fingerprint,
            "holonom": env!("CARGO_PKG_VERSION"),
            "parameters": nominal,
            "method": prepared.method,
            "span": prepared.span().ok(),
            "plan": plan.words,
            "variants": plan.rows.len(),
            "varied": plan.names.len(),
            "columns": columns.iter().map(|Column { name, unit }| json!({ "name": name, "unit": unit })).collect::<Vec<_>>(),
            "commands": again.iter().map(|words| words.get(3..)).collect::<Vec<_>>(),
        });
        let identity = identity.as_object().cloned().unwrap_or_default();
        let count = plan.rows.len();
        StudyTable { identity, again, count, parameters: plan.names.len(), columns, rows: BTreeMap::new() }
    }

    /// Computes rows on all cores until `is_over`; only whole rows are added. `done` is called after each.
    #[must_use]
    pub fn filled(
        self,
        study: &Study,
        plan: &Plan,
        rows: Vec<usize>,
        is_over: &(dyn Fn() -> bool + Sync),
        done: impl FnMut(&StudyTable) + Send,
    ) -> StudyTable {
        let none = vec![f64::NAN; self.columns.len() - self.parameters];
        let shared = Mutex::new((self, done));
        run_all(cores(), rows.into_iter(), |row| {
            let values = &plan.rows[row];
            let Some(found) = study.run(values, is_over) else { return };
            let (numbers, failure) =
                found.map_or_else(|failure| (none.clone(), failure), |numbers| (numbers, String::new()));
            let mut shared = locked(&shared);
            let (table, done) = &mut *shared;
            table.rows.insert(row, StudyRow { values: [&values[..], &numbers].concat(), failure });
            done(table);
        });
        into_inner(shared).0
    }

    /// Headings of the table.
    pub fn headings(&self) -> impl Iterator<Item = String> {
        let columns = self.columns.iter().map(|column| column.name.clone());
        [ROW.to_string()].into_iter().chain(columns).chain([FAILURE.to_string()])
    }

    /// Number of variants that failed.
    pub fn failed(&self) -> usize {
        self.rows.values().filter(|row| !row.failure.is_empty()).count()
    }

    /// Reads `study.json` and `study.csv` of a folder.
    ///
    /// # Errors
    /// Files that cannot be read, or are no study.
    pub fn read(folder: &Path) -> Result<StudyTable> {
        let [json, csv] = ["study.json", "study.csv"].map(|name| folder.join(name));
        let text = |path: &Path| {
            crate::files::read_text(path).map_err(|error| Error::file(path, format!("there is no study: {error}")))
        };
        let no_study = || Error::file(&json, "this is no result of `study`");
        let read: Value = serde_json::from_str(&text(&json)?).map_err(|_| no_study())?;
        let mut table = StudyTable::of_json(&read).ok_or_else(no_study)?;
        table.read_rows(&text(&csv)?).map_err(|problem| Error::file(&csv, problem))?;
        Ok(table)
    }

    /// Joins the tables of some folders, of the scene with this hash.
    ///
    /// # Errors
    /// As [`StudyTable::read`] and [`StudyTable::add`]; a study of another scene.
    pub fn merged(folders: &[PathBuf], scene_hash: &str) -> Result<StudyTable> {
        let mut tables = folders.iter().map(|folder| Ok((StudyTable::read(folder)?, folder)));
        let (mut whole, first) = tables.next().unwrap_or_else(|| Err(Error::input("there is no folder to merge")))?;
        if whole.identity.get("scene_hash").and_then(Value::as_str) != Some(scene_hash) {
            return Err(Error::file(first, "this is a study of another scene; name the scene of the parts"));
        }
        tables.try_for_each(|table| table.and_then(|(table, folder)| whole.add(table, folder)))?;
        Ok(whole)
    }

    fn of_json(json: &Value) -> Option<StudyTable> {
        let identity = json.get("study")?.as_object()?.clone();
        let text = |value: &Value, key: &str| Some(value.get(key)?.as_str()?.to_string());
        let column = |value: &Value| Some(Column { name: text(value, "name")?, unit: text(value, "unit")? });
        let number = |key: &str| Some(identity.get(key)?.as_u64()? as usize);
        Some(StudyTable {
            again: serde_json::from_value(json.get("again")?.clone()).ok()?,
            count: number("variants")?,
            parameters: number("varied")?,
            columns: identity.get("columns")?.as_array()?.iter().map(column).collect::<Option<_>>()?,
            rows: BTreeMap::new(),
            identity,
        })
    }

    fn read_rows(&mut self, text: &str) -> Result<(), String> {
        let mut reader = csv::Reader::from_reader(text.as_bytes());
        let headings = reader.headers().map_err(|error| error.to_string())?;
        if !self.headings().eq(headings.iter().map(str::to_string)) {
            return Err("its columns are not those that study.json names".to_string());
        }
        for record in reader.records() {
            let record = record.map_err(|error| error.to_string())?;
            let cell = |i: usize| record.get(i).unwrap_or_default();
            let wrong = |cell: &str| format!("`{}` is no number", excerpt(cell));
            let place: usize = cell(0).parse().map_err(|_| wrong(cell(0)))?;
            if place >= self.count {
                return Err(format!("row {place} is beyond the {} variants", self.count));
            }
            let number =
                |cell: &str| if cell.is_empty() { Ok(f64::NAN) } else { cell.parse().map_err(|_| wrong(cell)) };
            let values = (1..=self.columns.len()).map(|i| number(cell(i))).collect::<Result<_, String>>()?;
            self.rows.insert(place, StudyRow { values, failure: cell(self.columns.len() + 1).to_string() });
        }
        Ok(())
    }

    /// Adds the rows of another table, of the same study, that came from a folder.
    ///
    /// # Errors
    /// Another study; a row that is there with other numbers.
    pub fn add(&mut self, other: StudyTable, folder: &Path) -> Result<()> {
        let refused = |problem: String| Error::input(problem).in_file(folder);
        if let Some(Difference { name, own, found }) = difference(&self.identity, &other.identity) {
            let found = excerpt(&found.to_string());
            let own = excerpt(&own.to_string());
            return Err(refused(format!("this is another study: its `{name}` is {found}, not {own}"))
                .hint("all rows need the same scene, options and version of holonom; name another folder with -o"));
        }
        for (place, row) in other.rows {
            match self.rows.get(&place) {
                Some(known) if *known != row => {
                    return Err(refused(format!("row {place} has other numbers than before"))
                        .hint("compute it again on one machine: `--again` prints how"));
                }
                _ => {
                    self.rows.insert(place, row);
                }
            }
        }
        Ok(())
    }
}

/// An entry that two identities do not have in common.
struct Difference<'v> {
    name: String,
    own: &'v Value,
    found: &'v Value,
}

/// Returns the first difference, within objects such as that of the method, too.
fn difference<'v>(a: &'v Map<String, Value>, b: &'v Map<String, Value>) -> Option<Difference<'v>> {
    let key = a.keys().chain(b.keys()).find(|key| a.get(*key) != b.get(*key))?;
    let own = a.get(key).unwrap_or(&Value::Null);
    let found = b.get(key).unwrap_or(&Value::Null);
    if let (Value::Object(a), Value::Object(b)) = (own, found) {
        return difference(a, b).map(|inner| Difference { name: format!("{key}.{}", inner.name), ..inner });
    }
    Some(Difference { name: key.clone(), own, found })
}
