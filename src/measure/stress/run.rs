//! All cells of a map, in parallel, in rounds of growing deadlines.

use super::case::Case;
use super::cell::{Cell, Status};
use super::map::Map;
use super::place::{Limits, Place};
use super::reference::{Rows, Search};
use super::subject::Subject;
use crate::math::memory::at_once;
use rayon::prelude::*;
use std::time::{Duration, Instant};

/// Memory of a cell, over what the process took at most until now, which has run the subject once: implicit methods take
/// more.
const MEMORY: f64 = 2.0;
/// A reference, which serves many cells, may take so many times their limit.
const REFERENCE: u32 = 3;

/// A map with its cells, by method, then row, then column.
pub struct Stressed {
    pub map: Map,
    /// The quantities whose errors the cells tell.
    pub watched: Vec<String>,
    pub cells: Vec<Cell>,
}

impl Stressed {
    pub fn cell(&self, method: usize, row: usize, column: usize) -> Option<&Cell> {
        let (columns, rows) = (self.map.x.entries.len(), self.map.y.entries.len());
        self.cells.get((method * rows + row) * columns + column).filter(|_| column < columns && row < rows)
    }

    /// Whether no cell has a value to show.
    pub fn is_empty(&self) -> bool {
        self.cells.iter().all(|cell| self.map.quantity.of(cell).is_none())
    }
}

/// Simulates every cell, and every motion of them once more as a reference; `progress` hears of each cell that is done.
///
/// What a cell costs is known only when it is run. So all are run in rounds: each has the same time, as much as lets the
/// round take about half of what is left, and what does not come through has more in the next round. Thus cheap cells come before
/// dear ones, and no method takes the time of another. In a round the middle of the map comes first. Which cells are done
/// depends on deadlines, what they hold does not.
pub fn stress(subject: &Subject, map: Map, limits: Limits, progress: &(impl Fn() + Sync)) -> Stressed {
    // Cells are what runs in parallel: matrices on other threads would wait for them.
    faer::set_global_parallelism(faer::Par::Seq);
    let threads = at_once(MEMORY).min(rayon::current_num_threads());
    let mut work = Work::new(subject, &map);
    let mut all = || work.run(subject, limits, threads, progress);
    match rayon::ThreadPoolBuilder::new().num_threads(threads).build() {
        Ok(pool) => pool.install(all),
        Err(_) => all(),
    }
    work.finish(map)
}

/// What is to be run, and what came of it.
struct Work {
    cells: Vec<Slot>,
    motions: Vec<(Case, Search)>,
    /// Everything, from the middle of the map outwards: a motion, then its cells.
    order: Vec<Job>,
}

/// A cell and what is known of it.
struct Slot {
    place: Place,
    motion: Option<usize>,
    cell: Cell,
    rows: Rows,
    is_done: bool,
}

#[derive(Clone, Copy)]
enum Job {
    Motion(usize),
    Cell(usize),
}

enum Came {
    Motion(usize, Search),
    Cell(usize, Box<(Cell, Rows)>),
}

impl Work {
    fn new(subject: &Subject, map: &Map) -> Self {
        let mut work = Work { cells: Vec::new(), motions: Vec::new(), order: Vec::new() };
        let mut known: Vec<[Option<usize>; 3]> = Vec::new();
        for at in (0..map.len()).map(|index| map.place(index)) {
            let place = Place::of(subject, map, at);
            let motion = place.is_possible().then(|| {
                let key = map.motion(at);
                known.iter().position(|other| *other == key).unwrap_or_else(|| {
                    known.push(key);
                    work.motions.push((motion(subject, map, at), Search::Pending));
                    known.len() - 1
                })
            });
            let cell = place.blank();
            work.cells.push(Slot { place, motion, cell, rows: Rows::new(), is_done: false });
        }
        let mut cells: Vec<usize> = (0..map.len()).collect();
        let distance = |index: &usize| map.eccentricity(map.place(*index));
        cells.sort_by(|a, b| distance(a).total_cmp(&distance(b)));
        let mut is_listed = vec![false; work.motions.len()];
        for index in cells {
            let motion = work.cells[index].motion.filter(|motion| !std::mem::replace(&mut is_listed[*motion], true));
            work.order.extend(motion.map(Job::Motion));
            work.order.push(Job::Cell(index));
        }
        work
    }

    fn run(&mut self, subject: &Subject, limits: Limits, threads: usize, progress: &(impl Fn() + Sync)) {
        let mut share = Duration::ZERO;
        loop {
            let pending: Vec<Job> = self.order.iter().copied().filter(|job| self.is_pending(*job)).collect();
            let left = limits.end.saturating_duration_since(Instant::now());
            if pending.is_empty() || left.is_zero() {
                return;
            }
            let half = left.mul_f64(0.5 * threads as f64 / pending.len() as f64);
            share = half.max(2 * share).min(left).min(limits.cell);
            let is_last = share == limits.cell;
            for came in self.round(&pending, subject, limits, share) {
                self.take(came, is_last, progress);
            }
        }
    }

    fn is_pending(&self, job: Job) -> bool {
        match job {
            Job::Motion(index) => matches!(self.motions[index].1, Search::Pending),
            Job::Cell(index) => !self.cells[index].is_done,
        }
    }

    /// Runs what is pending in order, each for its share; what the end comes before is not begun.
    fn round(&self, pending: &[Job], subject: &Subject, limits: Limits, share: Duration) -> Vec<Came> {
        let one = |job: &Job| {
            let came = || match *job {
                Job::Motion(index) => {
                    let allowed = if share == limits.cell { REFERENCE * share } else { share };
                    Came::Motion(index, Search::run(subject, &self.motions[index].0, allowed, limits.end))
                }
                Job::Cell(index) => Came::Cell(index, Box::new(self.cells[index].place.run(subject, limits, share))),
            };
            (Instant::now() < limits.end).then(came)
        };
        pending.iter().par_bridge().filter_map(one).collect()
    }

    fn take(&mut self, came: Came, is_last: bool, progress: &impl Fn()) {
        match came {
            Came::Motion(index, Search::Pending) if is_last => self.motions[index].1 = Search::Hopeless,
            Came::Motion(index, search) => self.motions[index].1 = search,
            Came::Cell(index, came) => {
                let slot = &mut self.cells[index];
                (slot.cell, slot.rows) = *came;
                slot.is_done = slot.cell.status != Status::LeftOut;
                if slot.is_done {
                    progress();
                }
            }
        }
    }

    fn finish(self, map: Map) -> Stressed {
        let reference = |motion: Option<usize>| match self.motions.get(motion?)? {
            (_, Search::Found(reference)) => Some(reference),
            _ => None,
        };
        let names = |motion| reference(motion).map_or(&[][..], |reference| &reference.names);
        let judged = |slot: &Slot| {
            let is_completed = slot.cell.status == Status::Completed;
            let errors = reference(slot.motion).filter(|_| is_completed).map(|reference| reference.errors(&slot.rows));
            slot.cell.clone().judged(names(slot.motion), errors.unwrap_or_default())
        };
        let watched = (0..self.motions.len()).map(|motion| names(Some(motion))).find(|names| !names.is_empty());
        Stressed { watched: watched.unwrap_or_default().to_vec(), cells: self.cells.iter().map(judged).collect(), map }
    }
}

/// The case without what does not change its motion.
fn motion(subject: &Subject, map: &Map, at: [usize; 3]) -> Case {
    let mut case = subject.base.clone();
    for change in map.changes(at).filter(|change| !change.keeps_motion()) {
        // It was made before without an error.
        let _ = change.apply(&mut case);
    }
    case
}
