//! Runs whose rows become arrays of NumPy.

use super::errors::{raised, refused};
use super::force;
use super::rows::RunRows;
use super::signals::on_thread;
use crate::abandoned;
use crate::cli::common::to_json;
use crate::cli::run::RunOptions;
use crate::error::{Error, INTERRUPTED, Result, Warning};
use crate::files::with_given;
use crate::report::Summary;
use crate::simulate::Stop;
use crate::system::{Column, Names};
use crate::trajectory::{Trajectory, recorded};
use clap::Parser;
use pyo3::prelude::*;
use pyo3::types::PyDict;
use serde_json::{Map, Value, json};
use std::cell::RefCell;
use std::path::PathBuf;
use std::sync::Arc;
use std::sync::atomic::{AtomicBool, Ordering};

/// The options of `simulate` but those of files.
#[derive(Parser)]
#[command(no_binary_name = true, disable_help_flag = true)]
struct SimulateOptions {
    #[command(flatten)]
    options: RunOptions,
}

/// A run with its rows.
struct Finished {
    rows: RunRows,
    /// Columns of the rows; it has no rows itself.
    columns: Trajectory,
    summary: Summary,
}

/// Simulates with the texts `given` in the place of files. `words` are the scene and the options of `simulate`.
#[pyfunction]
pub fn simulate(py: Python<'_>, words: Vec<String>, given: Vec<(PathBuf, String)>) -> PyResult<Bound<'_, PyDict>> {
    let options = parsed(&words)?;
    let is_asked = Arc::new(AtomicBool::new(false));
    let flag = is_asked.clone();
    let work = move || {
        abandoned::keep();
        with_given(given, || finished(&options, words, &flag))
    };
    let (result, signal) = on_thread(py, || is_asked.store(true, Ordering::Relaxed), work)?;
    let Finished { rows, columns, summary } = result.map_err(raised)?;
    let names = &columns.names;
    let units: Vec<(&str, &str)> = columns.named_outputs().collect();
    let found = PyDict::new(py);
    found.set_item("columns", columns.headings())?;
    found.set_item("sizes", (names.q.len(), names.v.len(), names.lambda.len()))?;
    found.set_item("units", units)?;
    rows.put_into(&found)?;
    found.set_item("summary", to_json(&summary).map_err(raised)?)?;
    found.set_item("text", summary.text())?;
    found.set_item("warnings", summary.origin.warnings.iter().map(Warning::to_string).collect::<Vec<_>>())?;
    found.set_item("failure", summary.failure.clone().map(|failure| Error::from(failure).to_string()))?;
    found.set_item("raised", signal.or_else(force::failure))?;
    Ok(found)
}

/// Reads and assembles a scene; returns its names, parameters and warnings as JSON.
#[pyfunction]
pub fn describe(py: Python<'_>, words: Vec<String>, given: Vec<(PathBuf, String)>) -> PyResult<String> {
    let options = parsed(&words)?;
    let described = move || {
        let prepared = options.common.load()?;
        let system = prepared.system();
        let facts = system.facts();
        let Names { q, v, lambda } = &facts.names;
        let parameters: Map<String, Value> =
            prepared.parameters.iter().map(|(name, value)| (name.to_string(), value.into())).collect();
        to_json(&json!({
            "name": prepared.name, "parameters": parameters, "q": q, "v": v, "lambda": lambda,
            "outputs": units(recorded(system)), "inputs": units(facts.inputs.clone()),
            "warnings": prepared.doubts.iter().map(Warning::to_string).collect::<Vec<_>>(),
        }))
    };
    py.detach(move || with_given(given, described)).map_err(raised)
}

fn units(columns: Vec<Column>) -> Map<String, Value> {
    columns.into_iter().map(|column| (column.name, column.unit.into())).collect()
}

fn parsed(words: &[String]) -> PyResult<RunOptions> {
    // Warnings are returned, not printed.
    let quiet = [String::from("--quiet")];
    let parsed = SimulateOptions::try_parse_from(words.iter().chain(&quiet)).map_err(|error| refused(&error))?;
    Ok(parsed.options)
}

fn finished(options: &RunOptions, words: Vec<String>, is_asked: &AtomicBool) -> Result<Finished> {
    let ready = options.ready(true)?;
    let rows = RefCell::new(RunRows::default());
    let mut recorder = ready.recorder().with_stop(|| force::stop().or_else(|| stop(is_asked)));
    // A comparison of two runs needs all rows.
    if !options.check_error {
        recorder = recorder.with_rows(ready.curves(), |row| rows.borrow_mut().add(&row));
    }
    let mut done = ready.run(recorder)?;
    let mut rows = rows.into_inner();
    if options.check_error {
        rows.add_all(&done.record);
        if done.summary.failure.is_none() {
            done = done.checked(&ready, |_| {}, || stop(is_asked));
        }
    }
    let mut summary = done.summary;
    summary.origin.command = ["holonom", "simulate"].map(String::from).into_iter().chain(words).collect();
    Ok(Finished { rows, columns: ready.columns(), summary })
}

/// Returns a reason to end the run if that is asked for.
fn stop(is_asked: &AtomicBool) -> Option<Stop> {
    let hint = "the rows until then are in `partial`";
    is_asked.load(Ordering::Relaxed).then(|| Stop { reason: INTERRUPTED.to_string(), hint: hint.to_string() })
}
