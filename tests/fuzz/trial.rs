//! What a scene must survive: being read, assembled, checked, simulated for a while and linearized.

use holonom::analysis::{Record, Recorder};
use holonom::error::{Error, Result};
use holonom::linearize::{Linear, State};
use holonom::prepared::{Model, Overrides};
use holonom::report::{cell, check, summarize, table};
use holonom::simulate::{Stop, simulate};
use holonom::system::Dimensions;
use std::cell::Cell;
use std::panic::{AssertUnwindSafe, catch_unwind};
use std::path::Path;

/// How a scene ended.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum Ending {
    /// Fine, and so large that a step of it may rightly take seconds.
    Large,
    /// With a message that says what is wrong.
    Refused,
    Completed,
    /// The work of the test was done.
    Stopped,
    /// Where the motion cannot go on.
    Failed,
}

/// Velocities and multipliers of a system whose dense matrices take a tenth of a second.
const LARGE: usize = 300;

/// Of one whose eigenvalues do not take long, also where they do not converge.
const MEDIUM: usize = 60;

/// Steps and rows of a run of a scene that is fine, times its velocities and multipliers.
const ALLOWED: usize = 2000;
const STOPPED: &str = "enough";

/// The ending, or what is wrong with the program.
pub fn survive(path: &Path) -> Result<Ending, String> {
    let found = catch_unwind(AssertUnwindSafe(|| try_all(path)));
    found.unwrap_or_else(|panic| {
        let text = panic.downcast_ref::<String>().cloned();
        Err(format!(
            "panicked: {}",
            text.or(panic.downcast_ref::<&str>().map(|text| text.to_string())).unwrap_or_default()
        ))
    })
}

fn try_all(path: &Path) -> Result<Ending, String> {
    let prepared = match Model::load_with(path, &Overrides::default()) {
        Ok(prepared) => prepared,
        Err(error) => return refused(&error),
    };
    let (q, v) = prepared.start();
    sound(q.iter().chain(v).all(|x| x.is_finite()), "the start is not finite")?;
    // Names may be anything, that too.
    let has_name = std::fs::read_to_string(path).is_ok_and(|text| text.contains("NaN"));
    sound(has_name || !check(&prepared).text().contains("NaN"), "the check prints NaN")?;
    let dimensions = prepared.system().dimensions();
    if dimensions.v + dimensions.lambda > LARGE {
        return Ok(Ending::Large);
    }
    let ending = run(&prepared)?;
    if dimensions.v > MEDIUM {
        return Ok(ending);
    }
    let model = State::start(&prepared).variation(&prepared).and_then(|mut variation| {
        variation.linearize(&Linear { method: holonom::method_spec::MethodSpec::named("mcs"), chart: None })
    });
    match model {
        Ok(model) => sound(model.a.iter().chain(model.b.iter()).all(|x| x.is_finite()), "the model is not finite")?,
        Err(error) => drop(refused(&error)?),
    }
    Ok(ending)
}

fn run(prepared: &Model) -> Result<Ending, String> {
    let Ok(span) = prepared.span() else { return Ok(Ending::Completed) };
    prepared.stiffness(span);
    let Dimensions { v, lambda, .. } = prepared.system().dimensions();
    let work = Cell::new(0);
    let stop = || {
        work.set(work.get() + v + lambda);
        (work.get() > ALLOWED).then(|| Stop { reason: STOPPED.to_string(), hint: "none".to_string() })
    };
    let mut recorder = Recorder::new(prepared.system()).with_stop(stop);
    let outcome = match simulate(prepared.system(), &prepared.method, span, prepared.start(), &mut recorder) {
        Ok(outcome) => outcome,
        Err(error) => return refused(&error),
    };
    let record = recorder.finish();
    rows_are_sound(&record)?;
    let summary = summarize(prepared, None, &[], &outcome, &[], &record, 0.0);
    sound(serde_json::to_string(&summary).is_ok(), "the summary is no JSON")?;
    match &outcome.failure {
        None => Ok(Ending::Completed),
        Some(failure) if failure.reason == STOPPED => Ok(Ending::Stopped),
        Some(failure) => {
            sound(failure.t.is_finite() && failure.reason.len() > 8, &format!("{failure:?}"))?;
            sound(!failure.hint.is_empty() && is_told(&failure.reason), &format!("{failure:?}"))?;
            Ok(Ending::Failed)
        }
    }
}

fn rows_are_sound(record: &Record) -> Result<(), String> {
    let times: Vec<f64> = record.trajectory.times().collect();
    sound(times.windows(2).all(|pair| pair[0] < pair[1]), "rows without order")?;
    let headings = record.trajectory.headings().into_iter().map(String::from);
    let cells = record.trajectory.rows.iter().map(|row| row.iter().map(|value| cell(*value)).collect());
    let table = table(headings, cells).map_err(|error| error.to_string())?;
    let text = String::from_utf8_lossy(&table);
    // An output may have no value.
    let is_number = |cell: &str| cell.is_empty() || cell.parse::<f64>().is_ok_and(f64::is_finite);
    // Names of columns may be anything.
    let rows =
        csv::Reader::from_reader(table.as_slice()).into_records().map(|row| row.map_err(|error| error.to_string()));
    for row in rows {
        let row = row?;
        sound(row.iter().all(is_number), &format!("not a number in {row:?}"))?;
    }
    sound(text.ends_with('\n'), "half a row")
}

fn sound(is_so: bool, otherwise: &str) -> Result<(), String> {
    if is_so { Ok(()) } else { Err(otherwise.to_string()) }
}

/// A message must be one that a person can use.
fn refused(error: &Error) -> Result<Ending, String> {
    let message = error.to_string();
    let longest = message.lines().map(|line| line.chars().count()).max().unwrap_or(0);
    sound(message.len() > 10 && longest < 700, &format!("a message of {longest} characters: {message}"))?;
    sound(is_told(&message), &message)?;
    Ok(Ending::Refused)
}

/// Not in the words of the program's own types.
fn is_told(message: &str) -> bool {
    ["invalid type", "untagged", " variant", "struct ", "index out of", "Some(", "None"]
        .iter()
        .all(|word| !message.contains(word))
}
