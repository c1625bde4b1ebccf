//! Runs whose rows become arrays of NumPy.

use super::errors::{raised, refused};
use super::force;
use super::rows::Rows;
use super::signals::{Ended, ended_early, on_thread};
use crate::analysis::Recorder;
use crate::cli::common::{Common, to_json};
use crate::cli::restart;
use crate::error::{Error, INTERRUPTED, Result, Warning};
use crate::files::with_given;
use crate::prepared::Model;
use crate::report::{MOST_COORDINATES, Summary, summarize};
use crate::simulate::{Start, Stop, spread};
use crate::study::{Completed, error_bars};
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
use std::time::Instant;

/// The options of `simulate` but those of files.
#[derive(Parser)]
#[command(no_binary_name = true, disable_help_flag = true)]
struct Options {
    #[command(flatten)]
    common: Common,
    #[arg(long)]
    outputs_only: bool,
    #[arg(long)]
    check_error: bool,
    #[arg(long, conflicts_with_all = ["check_error", "equilibrium"])]
    start: Option<PathBuf>,
    #[arg(long, requires = "start")]
    changed: bool,
}

/// A run with its rows.
struct Finished {
    rows: Rows,
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
    let work = move || with_given(given, || finished(options, words, &flag));
    let Ended { result, signal } = on_thread(py, || is_asked.store(true, Ordering::Relaxed), work)?;
    let Some(result) = result else { return Err(ended_early(signal)) };
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

fn parsed(words: &[String]) -> PyResult<Options> {
    // Warnings are returned, not printed.
    let quiet = [String::from("--quiet")];
    Options::try_parse_from(words.iter().chain(&quiet)).map_err(|error| refused(&error))
}

fn finished(options: Options, words: Vec<String>, is_asked: &AtomicBool) -> Result<Finished> {
    let prepared = options.common.load()?;
    let system = prepared.system();
    let span = options.common.span(&prepared)?;
    let saved = options.start.as_ref().map(|path| restart::read(path, &prepared, options.changed)).transpose()?;
    let stiffness = prepared.stiffness(span);
    let doubt = saved.as_ref().and_then(|saved| restart::doubt(saved, &prepared));
    let of_method = stiffness.as_ref().map(Warning::from).into_iter().chain(prepared.method.doubts(system));
    let early: Vec<Warning> = prepared.doubts.iter().cloned().chain(of_method).chain(doubt).collect();
    let rows = RefCell::new(Rows::default());
    let mut recorder = recorder(&options, &prepared, &rows).with_stop(|| force::stop().or_else(|| stop(is_asked)));
    let clock = Instant::now();
    let (q, v) = prepared.start();
    let start = saved.as_ref().map_or(Start::State(q, v), Start::Saved);
    let (outcome, legs, restart) = spread(|| prepared.simulate_from(&prepared.method, span, start, &mut recorder))?;
    let seconds = clock.elapsed().as_secs_f64();
    let record = recorder.finish();
    let mut summary = summarize((&prepared, stiffness, &early), (&outcome, &legs), &record, seconds);
    summary.restart = restart;
    summary.origin.command = ["holonom", "simulate"].map(String::from).into_iter().chain(words).collect();
    if options.check_error && summary.failure.is_none() {
        let run = Completed { span, trajectory: &record.trajectory, legs: &legs, statistics: outcome.statistics };
        summary = summary.checked(spread(|| error_bars(&prepared, run, |_| {}, || stop(is_asked))));
    }
    let mut rows = rows.into_inner();
    if options.check_error {
        rows.add_all(&record);
    }
    let columns = columns(&options, &prepared);
    Ok(Finished { rows, columns, summary })
}

/// Returns a reason to end the run if that is asked for.
fn stop(is_asked: &AtomicBool) -> Option<Stop> {
    let hint = "the rows until then are in `partial`";
    is_asked.load(Ordering::Relaxed).then(|| Stop { reason: INTERRUPTED.to_string(), hint: hint.to_string() })
}

/// Returns a recorder that passes the rows on, unless a comparison of two runs needs all of them.
fn recorder<'a>(options: &Options, prepared: &'a Model, rows: &'a RefCell<Rows>) -> Recorder<'a> {
    let mut recorder = Recorder::new(prepared.system()).with_jumps();
    if options.outputs_only {
        recorder = recorder.with_outputs_only();
    }
    if options.check_error {
        return recorder;
    }
    let coordinates = if recorded(prepared.system()).is_empty() { MOST_COORDINATES } else { 0 };
    recorder.with_rows(coordinates, |row| rows.borrow_mut().add(&row))
}

fn columns(options: &Options, prepared: &Model) -> Trajectory {
    let system = prepared.system();
    if options.outputs_only { Trajectory::of_outputs(system, 0) } else { Trajectory::new(system) }
}
