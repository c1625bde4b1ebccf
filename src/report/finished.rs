//! A finished run, read back from its folder.

use super::figures::Ending;
use crate::analysis::{Drift, DriftLevel, EnergyBalance, Ledger, thin};
use crate::error::{Error, Failure, Result, suggest};
use crate::files;
use crate::math::expression::Number;
use crate::system::MechanicalSystem;
use crate::trajectory::Trajectory;
use serde::Deserialize;
use serde_json::{Map, Value};
use std::path::{Path, PathBuf};

/// A run of `simulate` as its files have it.
pub struct FinishedRun {
    pub parameters: Vec<(String, Number)>,
    pub failure: Option<Failure>,
    pub ending: Ending,
    path: PathBuf,
    files: Vec<String>,
    headings: Vec<String>,
    rows: Vec<Vec<f64>>,
}

/// The part of a `summary.json` that is read.
#[derive(Deserialize)]
struct FinishedSummary {
    parameters: Map<String, Value>,
    failure: Option<Failure>,
    files: Vec<String>,
    drift: Value,
    #[serde(default)]
    energy: Value,
}

impl FinishedSummary {
    /// Returns how the run ended. Null is what is not finite.
    fn ending(&self) -> Ending {
        let relative_max = self.drift["position"]["relative_max"].as_f64().unwrap_or(f64::NAN);
        let drift = Drift { position: DriftLevel { relative_max, ..DriftLevel::default() }, ..Drift::default() };
        let relative_max_error = self.energy["relative_max_error"].as_f64();
        let energy = EnergyBalance { relative_max_error, ..EnergyBalance::default() };
        Ending::of(self.failure.as_ref(), &drift, self.energy.is_object().then_some(&energy))
    }
}

type TrajectoryRows = (Vec<String>, Vec<Vec<f64>>);

impl FinishedRun {
    /// Reads the run of a folder, or of its `summary.json`; of a long one those rows that curves need, if `is_thinned`.
    ///
    /// # Errors
    /// A folder without a run, and files that are not as `simulate` writes them.
    pub fn read(path: &Path, is_thinned: bool) -> Result<FinishedRun> {
        let summary = if path.is_dir() { path.join("summary.json") } else { path.to_path_buf() };
        let written = "name the folder that `holonom simulate` has written";
        let text = files::read_json(&summary)
            .map_err(|error| Error::input(error.to_string()).hint(written).in_file(&summary))?;
        let saved: FinishedSummary = serde_json::from_str(&text).map_err(|error| {
            Error::input(format!("it is no summary of a run: {error}")).hint(written).in_file(&summary)
        })?;
        let known = ["trajectory.csv", "trajectory.npz"];
        let name = known.iter().find(|name| saved.files.iter().any(|file| file == *name)).ok_or_else(|| {
            Error::input("this run has no trajectory that is read")
                .hint("simulate again with --format csv or npz")
                .in_file(&summary)
        })?;
        let path = summary.with_file_name(name);
        let read = if *name == known[0] { read_table(&path, is_thinned) } else { read_arrays(&path) };
        let (headings, rows) = read.map_err(|error| error.in_file(&path))?;
        let number = |(name, value): (String, Value)| Some((name, Number::Value(value.as_f64()?)));
        let ending = saved.ending();
        let parameters = saved.parameters.into_iter().filter_map(number).collect();
        Ok(FinishedRun { parameters, failure: saved.failure, ending, path, files: saved.files, headings, rows })
    }

    /// Returns the largest |phi|, |phi'| and |phi''| at each row; none where they were not written.
    pub fn drift(&self) -> Result<Vec<[f64; 3]>> {
        self.levels("drift.csv")
    }

    /// Returns the energies at each row; none where they were not written.
    pub fn energy(&self) -> Result<Vec<Ledger>> {
        let rows = self.levels("energy.csv")?.into_iter();
        Ok(rows.map(|[kinetic, potential, work, error]| Ledger { kinetic, potential, work, error }).collect())
    }

    /// Returns the columns after the time of another table of the run.
    fn levels<const N: usize>(&self, name: &str) -> Result<Vec<[f64; N]>> {
        if !self.files.iter().any(|file| file == name) {
            return Ok(Vec::new());
        }
        let path = self.path.with_file_name(name);
        let (_, rows) = read_table(&path, false).map_err(|error| error.in_file(&path))?;
        let values = |row: &Vec<f64>| row.get(1..).and_then(|row| row.try_into().ok());
        rows.iter()
            .map(values)
            .collect::<Option<_>>()
            .ok_or_else(|| Error::input(format!("this table does not have a time and {N} columns")).in_file(&path))
    }

    /// Returns the motion of the system; with time and outputs alone where that is all that was written.
    ///
    /// # Errors
    /// A run of another system.
    pub fn trajectory(self, system: &dyn MechanicalSystem) -> Result<Trajectory> {
        let all = [Trajectory::new(system), Trajectory::of_outputs(system, 0)];
        let known = all[0].headings();
        let other = |heading: &&String| !known.contains(&heading.as_str());
        let unknown = self.headings.iter().find(other).cloned();
        let missing =
            || known.iter().find(|known| self.headings.iter().all(|found| found != *known)).map(|x| x.to_string());
        let found = all.iter().find(|trajectory| trajectory.headings() == self.headings).cloned();
        match found {
            Some(trajectory) => Ok(Trajectory { rows: self.rows, ..trajectory }),
            None => {
                let hint = unknown.as_ref().map(|name| suggest(name, known.iter().copied()));
                let error = match unknown.or_else(missing) {
                    Some(name) => format!("it is of another scene: they do not share the column `{name}`"),
                    None => "it is of another scene: its columns are in another order".to_string(),
                };
                let hint = hint.unwrap_or("draw the scene as it was when it was simulated".to_string());
                Err(Error::input(error).hint(hint).in_file(self.path))
            }
        }
    }
}

/// Reads a table row by row; an empty cell is no value.
fn read_table(path: &Path, is_thinned: bool) -> Result<TrajectoryRows> {
    let wrong = |error: &dyn std::fmt::Display| Error::input(format!("this is no trajectory: {error}"));
    let file = files::open(path).and_then(|file| {
        let fits = if is_thinned { Ok(()) } else { files::refuse_large(&file) };
        fits.map(|()| file)
    });
    let mut reader = csv::Reader::from_reader(file.map_err(|error| wrong(&error))?);
    let headings: Vec<String> = reader.headers().map_err(|error| wrong(&error))?.iter().map(String::from).collect();
    let mut rows = Vec::new();
    let mut record = csv::StringRecord::new();
    while reader.read_record(&mut record).map_err(|error| wrong(&error))? {
        let value = |cell: &str| match cell {
            "" => Ok(f64::NAN),
            cell => cell.parse::<f64>().map_err(|_| wrong(&format!("`{}` is no number", crate::error::excerpt(cell)))),
        };
        let mut row = Vec::with_capacity(headings.len());
        record.iter().try_for_each(|cell| value(cell).map(|value| row.push(value)))?;
        rows.push(row);
        if is_thinned {
            thin(&mut rows, &mut Vec::new(), &mut Vec::new());
        }
    }
    Ok((headings, rows))
}

#[cfg(feature = "npz")]
fn read_arrays(path: &Path) -> Result<TrajectoryRows> {
    use files::{npy::Npy, npz};
    let mut archive = npz::open(path)?;
    let mut member =
        |key: &str| npz::member(&mut archive, key)?.ok_or_else(|| Error::input(format!("there is no array `{key}`")));
    let headings = Npy::parse(&member("columns")?)?.texts()?;
    let bytes = member("rows")?;
    let rows = Npy::parse(&bytes)?;
    let values = rows.numbers()?;
    match rows.shape[..] {
        [_, columns] if columns == headings.len() && columns > 0 => {
            Ok((headings, values.chunks(columns).map(<[f64]>::to_vec).collect()))
        }
        _ => Err(Error::input("`rows` and `columns` do not fit together")),
    }
}

#[cfg(not(feature = "npz"))]
fn read_arrays(_: &Path) -> Result<TrajectoryRows> {
    Err(Error::input("files of NumPy are not read without the feature `npz`"))
}
