//! One simulation.

use super::cell::{Cell, Status};
use super::map::Map;
use super::subject::{Case, Subject};
use crate::analysis::{Record, Recorder};
use crate::clock::Stopwatch;
use crate::error::{Error, short};
use crate::formulation::StepError;
use crate::study::budget::{Limit, Over};
use crate::study::run::Ended;
use serde_json::Value;
use std::sync::Arc;

/// Returns the cell without a result. Its scene is not copied, since there would be many.
pub(super) fn blank(subject: &Subject, map: &Map, at: [usize; 3]) -> Cell {
    let mut case = Case { scene: Arc::new(Value::Null), ..subject.base.clone() };
    for change in map.changes(at) {
        // Changes of the scene do not affect the method.
        let _ = change.apply(&mut case);
    }
    let reason = Some("not begun: the budget was over, or the command was stopped".to_string());
    let [panel, row, column] = at;
    Cell { panel, column, row, method: case.method, reason, ..Cell::default() }
}

/// Runs a cell within a limit, that of all cells if `is_last`; returns it with the rows for its errors, and the part of
/// the motion completed.
pub(super) fn run(
    subject: &Subject,
    map: &Map,
    at: [usize; 3],
    limit: Limit,
    is_last: bool,
) -> (Cell, Vec<Vec<f64>>, f64) {
    let watch = Stopwatch::start();
    let mut case = subject.base.clone();
    let changed = map.changes(at).try_for_each(|change| change.apply(&mut case));
    let run = changed.and_then(|()| {
        subject.with(&case, |motion| {
            let mut recorder = Recorder::new(motion.system);
            let ended = motion.simulate(&case.method, Some(limit), &mut recorder)?;
            let fraction = (ended.outcome.t - motion.span.start) / case.duration;
            Ok((ended, recorder.finish(), fraction))
        })
    });
    let seconds = watch.wall().as_secs_f64();
    let blank = Cell { seconds, reason: None, method: case.method, ..blank(subject, map, at) };
    match run {
        Err(error) => (Cell { status: Status::Refused, reason: Some(message(&error)), ..blank }, Vec::new(), 1.0),
        Ok((ended, record, fraction)) => {
            let rows = record.trajectory.watched().collect();
            (with_result(blank, ended, record, is_last), rows, fraction)
        }
    }
}

/// Returns the first line of an error.
fn message(error: &Error) -> String {
    format!("{error:#}").lines().next().unwrap_or_default().to_string()
}

fn with_result(blank: Cell, ended: Ended, record: Record, is_last: bool) -> Cell {
    let status = status(&ended, &record, is_last);
    let outcome = ended.outcome;
    let reason = match (&outcome.failure, status) {
        (_, Status::LeftOut) => {
            Some(format!("its share of the budget was over, or the command was stopped, at t = {} s", short(outcome.t)))
        }
        (Some(failure), _) => Some(failure.reason.clone()),
        (None, Status::Diverged) => {
            Some(format!("the joints are open by {:.1e} of the scene's size", record.drift.position.relative_max))
        }
        (None, _) => None,
    };
    Cell {
        status,
        reason,
        t: outcome.t,
        energy_error: record.energy.map(|energy| energy.max_error),
        relative_energy_error: record.energy.and_then(|energy| energy.relative_max_error),
        drift: Some(record.drift),
        steps: outcome.statistics.steps,
        rhs_evaluations: outcome.statistics.whole().rhs_evaluations,
        ..blank
    }
}

fn status(ended: &Ended, record: &Record, is_last: bool) -> Status {
    let is_open = record.drift.has_open_joints();
    let is_blown = record.energy.is_some_and(|energy| energy.is_lost());
    match (&ended.outcome.failure, ended.over) {
        (None, _) if is_open => Status::Diverged,
        (None, _) => Status::Completed,
        (Some(_), Some(Over::Cpu)) if is_last => Status::TooSlow,
        (Some(_), Some(_)) => Status::LeftOut,
        (Some(failure), None) if is_open || is_blown || failure.reason.contains(&StepError::NotFinite.to_string()) => {
            Status::Diverged
        }
        (Some(_), None) => Status::Failed,
    }
}
