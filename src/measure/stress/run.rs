//! All cells of a map, in parallel, each under its deadline.

use super::case::Case;
use super::cell::{Cell, Status};
use super::map::Map;
use super::reference::Reference;
use super::subject::Subject;
use crate::error::{Error, Result};
use crate::formulation::Halt;
use crate::math::memory::at_once;
use crate::measure::{Record, Recorder};
use crate::simulate::{Outcome, Stop, simulate};
use rayon::prelude::*;
use std::cell::Cell as Flag;
use std::time::{Duration, Instant};

/// How long cells may take.
#[derive(Clone, Copy, Debug)]
pub struct Limits {
    /// Each of them.
    pub cell: Duration,
    /// All of them: what has not begun then is left out, and what runs ends.
    pub end: Instant,
}

/// Memory of a cell, over what the process took at most until now, which has run the subject once: implicit methods take
/// more.
const MEMORY: f64 = 2.0;

/// A map with its cells, by method, then row, then column.
pub struct Stressed {
    pub map: Map,
    pub cells: Vec<Cell>,
}

impl Stressed {
    pub fn cell(&self, method: usize, row: usize, column: usize) -> Option<&Cell> {
        let (columns, rows) = (self.map.x.entries.len(), self.map.y.entries.len());
        self.cells.get((method * rows + row) * columns + column).filter(|_| column < columns && row < rows)
    }
}

/// Simulates every cell; `progress` hears of each that is done. The cells do not depend on the order in which they are run,
/// but for deadlines: cheap ones come first, so that dear ones are left out.
pub fn stress(subject: &Subject, map: Map, limits: Limits, progress: &(impl Fn() + Sync)) -> Stressed {
    let reference = map.keeps_motion().then(|| Reference::of(subject, 3 * limits.cell)).flatten();
    let (columns, rows) = (map.x.entries.len(), map.y.entries.len());
    let place = |index: usize| [index / (rows * columns), index / columns % rows, index % columns];
    let mut order: Vec<(usize, f64)> =
        (0..map.len()).map(|index| (index, Place::of(subject, &map, place(index)).cost())).collect();
    order.sort_by(|a, b| a.1.total_cmp(&b.1));
    let one = |(index, _): (usize, f64)| {
        let cell = Place::of(subject, &map, place(index)).cell(subject, limits, reference.as_ref());
        progress();
        (index, cell)
    };
    let all = || order.into_iter().par_bridge().map(one).collect();
    let threads = at_once(MEMORY).min(rayon::current_num_threads());
    let mut cells: Vec<(usize, Cell)> = match rayon::ThreadPoolBuilder::new().num_threads(threads).build() {
        Ok(pool) => pool.install(all),
        Err(_) => all(),
    };
    cells.sort_by_key(|(index, _)| *index);
    Stressed { map, cells: cells.into_iter().map(|(_, cell)| cell).collect() }
}

/// A cell before it is run.
struct Place {
    at: [usize; 3],
    case: Case,
    /// What was wrong with its changes.
    refused: Option<Error>,
}

impl Place {
    fn of(subject: &Subject, map: &Map, at: [usize; 3]) -> Self {
        let [panel, row, column] = at;
        let mut case = subject.base.clone();
        let entries = [&map.methods[panel], &map.x.entries[column], &map.y.entries[row]];
        let mut changes = entries.into_iter().flat_map(|entry| &entry.changes);
        let refused = changes.try_for_each(|change| change.apply(&mut case)).err();
        Place { at, case, refused }
    }

    /// About how many steps it will take.
    fn cost(&self) -> f64 {
        let Case { method, duration, typical, .. } = &self.case;
        duration / method.step.unwrap_or(typical.step * (method.rtol / 1e-8).powf(1.0 / 8.0))
    }

    fn cell(self, subject: &Subject, limits: Limits, reference: Option<&Reference>) -> Cell {
        let Place { at: [panel, row, column], case, refused } = self;
        let clock = Instant::now();
        let blank = Cell {
            panel,
            column,
            row,
            method: case.method.clone(),
            status: Status::LeftOut,
            reason: None,
            t: 0.0,
            drift: None,
            energy_error: None,
            relative_energy_error: None,
            error: None,
            steps: 0,
            rhs_evaluations: 0,
            seconds: 0.0,
        };
        if clock >= limits.end {
            return blank;
        }
        let run = refused.map_or_else(|| run(subject, &case, limits), Err);
        let seconds = clock.elapsed().as_secs_f64();
        match run {
            Err(error) => Cell { status: Status::Refused, reason: Some(message(&error)), seconds, ..blank },
            Ok(run) => Cell { seconds, ..run.cell(blank, reference) },
        }
    }
}

/// The first line of an error, which says what is wrong.
fn message(error: &Error) -> String {
    error.to_string().lines().next().unwrap_or_default().to_string()
}

struct Run {
    outcome: Outcome,
    record: Record,
    /// How a run that was stopped from outside is called.
    stopped: Option<Status>,
}

fn run(subject: &Subject, case: &Case, limits: Limits) -> Result<Run> {
    subject.with(case, |system, span, start| {
        let (begin, stopped) = (Instant::now(), Flag::new(None));
        let stop = || {
            let now = Instant::now();
            let status = match () {
                () if now.duration_since(begin) > limits.cell => Status::TooSlow,
                () if now > limits.end => Status::LeftOut,
                () => return None,
            };
            stopped.set(Some(status));
            Some(Stop::deadline(limits.cell))
        };
        let mut recorder = Recorder::new(system).with_stop(stop);
        let outcome = simulate(system, &case.method, span, start, &mut recorder)?;
        let record = recorder.finish();
        Ok(Run { outcome, record, stopped: stopped.get() })
    })
}

/// Joints that are open by this part of the scene's size make a motion meaningless.
const OPEN: f64 = 0.1;
/// A run that stopped had diverged before if its energy error is this part of the energy turned over.
const BLOWN: f64 = 0.5;

impl Run {
    fn cell(self, blank: Cell, reference: Option<&Reference>) -> Cell {
        let status = self.status();
        let Run { outcome, record, .. } = self;
        let reason = match (&outcome.failure, status) {
            (_, Status::LeftOut) => None,
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
            error: reference.filter(|_| status == Status::Completed).and_then(|reference| reference.error(&record)),
            drift: Some(record.drift),
            steps: outcome.statistics.steps,
            rhs_evaluations: outcome.statistics.rhs_evaluations,
            ..blank
        }
    }

    fn status(&self) -> Status {
        let open = self.record.drift.position.relative_max;
        let is_open = open.is_nan() || open > OPEN;
        let Some(failure) = &self.outcome.failure else {
            return if is_open { Status::Diverged } else { Status::Completed };
        };
        let is_blown = self
            .record
            .energy
            .and_then(|energy| energy.relative_max_error)
            .is_some_and(|part| part.is_nan() || part > BLOWN);
        match self.stopped {
            Some(status) => status,
            None if is_open || is_blown || failure.reason.contains(&Halt::NotFinite.to_string()) => Status::Diverged,
            None => Status::Failed,
        }
    }
}
