//! All cells of a map, in parallel, each under its deadline.

use super::cell::{Cell, Status};
use super::map::Map;
use super::reference::{self, ReferenceSearch};
use super::simulation::{blank, run};
use super::subject::{Case, Subject};
use crate::clock::Stopwatch;
use crate::math::memory::at_once;
use crate::study::budget::{Budget, Limit};
use crate::study::metric::ErrorMetric;
use crate::study::pool::{cores, into_inner, locked, run_all};
use crate::study::queue::{Job, Queues};
use crate::study::second_opinion::SecondOpinion;
use std::sync::Mutex;
use std::time::Duration;

/// Memory of a cell relative to the peak of the process after one run of the subject; implicit methods take more.
const MEMORY: f64 = 2.0;
/// CPU time of a reference, which serves many cells, in limits of a cell.
const REFERENCE: u32 = 3;

/// Limits of the computation time.
#[derive(Clone, Copy, Debug)]
pub struct Limits {
    /// CPU time of each cell.
    pub cell: Duration,
    /// Time for all cells: those not begun by then are skipped, and runs end.
    pub all: Duration,
}

/// A map with its cells, by method, then row, then column.
pub struct Stressed {
    /// The map.
    pub map: Map,
    /// Names of the quantities whose errors the cells give.
    pub watched: Vec<String>,
    /// The difference of the reference in the middle of the map from a run of diffsol; none without such a reference.
    #[doc(hidden)]
    pub second_opinion: Option<SecondOpinion>,
    /// Cells, columns fastest.
    pub cells: Vec<Cell>,
}

impl Stressed {
    /// Returns the cell of a method, row and column; none outside the map.
    pub fn cell(&self, method: usize, row: usize, column: usize) -> Option<&Cell> {
        let columns = self.map.x.entries.len();
        let rows = self.map.y.entries.len();
        self.cells.get((method * rows + row) * columns + column).filter(|_| column < columns && row < rows)
    }

    /// True if no cell has a value of the map's quantity.
    pub fn is_empty(&self) -> bool {
        self.cells.iter().all(|cell| self.map.quantity.of(cell).is_none())
    }
}

/// Simulates every cell, and every motion once more as a reference; `progress` is called for each cell that is done.
///
/// The cost of a cell is known only after its run. So each has a short time first, and those that do not complete wait
/// until others have had as much, cheaper neighbours first, from the middle of the map on, where cells are cheap. The
/// methods, and their references, have equal times. Deadlines decide which cells are done, but not their values.
pub fn stress(subject: &Subject, map: Map, limits: Limits, progress: &(impl Fn() + Sync)) -> Stressed {
    let work = Work::new(subject, &map, limits.cell);
    let threads = at_once(MEMORY).min(cores());
    run_all(threads, 0..threads, |_| work.run(&Budget::begin(limits.all), progress));
    let second_opinion = work.confirm();
    let (watched, cells) = work.finish();
    Stressed { map, watched, second_opinion, cells }
}

/// The runs to make, and their results.
struct Work<'a> {
    subject: &'a Subject<'a>,
    map: &'a Map,
    /// CPU time of each cell.
    limit: Duration,
    cells: Vec<Slot>,
    /// Indices of one of its cells, and the reference.
    motions: Vec<([usize; 3], Mutex<ReferenceSearch>)>,
    queues: Mutex<Queues<What>>,
}

#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
enum What {
    /// The reference of this motion.
    Motion(usize),
    Cell(usize),
}

/// A cell with its result.
struct Slot {
    at: [usize; 3],
    motion: usize,
    came: Mutex<(Cell, Vec<Vec<f64>>)>,
}

impl<'a> Work<'a> {
    fn new(subject: &'a Subject<'a>, map: &'a Map, limit: Duration) -> Self {
        let mut order: Vec<usize> = (0..map.cell_count()).collect();
        let distance = |index: &usize| map.eccentricity(map.place(*index));
        order.sort_by(|a, b| distance(a).total_cmp(&distance(b)));
        let mut ranks = vec![0; order.len()];
        order.into_iter().enumerate().for_each(|(rank, index)| ranks[index] = rank);
        let mut cells = Vec::new();
        let mut motions = Vec::new();
        let mut queues = Queues::new();
        let mut known: Vec<[Option<usize>; 3]> = Vec::new();
        for (index, rank) in ranks.into_iter().enumerate() {
            let at = map.place(index);
            let key = map.motion(at);
            let motion = known.iter().position(|other| *other == key).unwrap_or_else(|| {
                queues.add("", Job::new(rank, What::Motion(known.len())));
                known.push(key);
                motions.push((at, Mutex::new(ReferenceSearch::Pending(0.0))));
                known.len() - 1
            });
            let blank = blank(subject, map, at);
            queues.add(&format!("{} {}", at[0], blank.method.integrator), Job::new(rank, What::Cell(index)));
            cells.push(Slot { at, motion, came: Mutex::new((blank, Vec::new())) });
        }
        Work { subject, map, limit, cells, motions, queues: Mutex::new(queues) }
    }

    /// Runs jobs until all are done, the time is over or the subject is stopped.
    fn run(&self, budget: &Budget, progress: &(impl Fn() + Sync)) {
        let is_over = || budget.left().is_zero() || (self.subject.is_stopped)();
        loop {
            let next = locked(&self.queues).take(self.limit);
            let Some((queue, job)) = next.filter(|_| !is_over()) else { return };
            let watch = Stopwatch::start();
            let cut = self.attempt(job, budget);
            if cut.is_none() && matches!(job.what, What::Cell(_)) {
                progress();
            }
            let took = watch.cpu();
            locked(&self.queues).give_back(queue, job, self.limit, took, cut, self.neighbours(job.what));
        }
    }

    /// Makes an attempt; returns the part of the motion completed if it was stopped.
    fn attempt(&self, job: Job<What>, budget: &Budget) -> Option<f64> {
        let share = job.share(self.limit);
        let is_last = share == self.limit;
        match job.what {
            What::Motion(index) => {
                let (at, found) = &self.motions[index];
                let search = self.case(*at).map_or(ReferenceSearch::Hopeless, |case| {
                    let cpu = if is_last { share.saturating_mul(REFERENCE) } else { share };
                    ReferenceSearch::run(self.subject, &case, cpu, budget)
                });
                if (self.subject.is_stopped)() {
                    return None;
                }
                let cut = match search {
                    ReferenceSearch::Pending(part) if !is_last => Some(part),
                    _ => None,
                };
                *locked(found) = search;
                cut
            }
            What::Cell(index) => {
                let slot = &self.cells[index];
                let limit = Limit { cpu: share, wall: budget.left() };
                let (cell, rows, part) = run(self.subject, self.map, slot.at, limit, is_last);
                if (self.subject.is_stopped)() {
                    return Some(part);
                }
                let cut = (cell.status == Status::LeftOut).then_some(part);
                *locked(&slot.came) = (cell, rows);
                cut
            }
        }
    }

    /// Returns the motion of a cell; none where its changes do not apply.
    fn case(&self, at: [usize; 3]) -> Option<Case> {
        let mut case = self.subject.base.clone();
        let mut changes = self.map.changes(at).filter(|change| !change.keeps_motion());
        changes.try_for_each(|change| change.apply(&mut case)).ok().map(|()| case)
    }

    /// Returns the neighbouring jobs on the map, or their references for a reference.
    fn neighbours(&self, what: What) -> impl Iterator<Item = What> {
        let at = match what {
            What::Motion(index) => self.motions[index].0,
            What::Cell(index) => self.cells[index].at,
        };
        self.map.beside(at).map(move |index| match what {
            What::Motion(_) => What::Motion(self.cells[index].motion),
            What::Cell(_) => What::Cell(index),
        })
    }

    /// Compares the first reference, in the middle of the map, with a run of diffsol.
    fn confirm(&self) -> Option<SecondOpinion> {
        let (at, search) = self.motions.first()?;
        let search = locked(search);
        let ReferenceSearch::Found(found) = &*search else { return None };
        let (reference, method) = &**found;
        let case = Case { method: method.clone(), ..self.case(*at)? };
        reference::confirmed(self.subject, &case, reference, self.limit.saturating_mul(REFERENCE))
    }

    /// Returns the names of the quantities, and the cells with their errors.
    fn finish(self) -> (Vec<String>, Vec<Cell>) {
        let found = |(_, search): ([usize; 3], Mutex<ReferenceSearch>)| match into_inner(search) {
            ReferenceSearch::Found(found) => Some(found.0),
            _ => None,
        };
        let references: Vec<Option<ErrorMetric>> = self.motions.into_iter().map(found).collect();
        let judged = |slot: Slot| {
            let (cell, rows) = into_inner(slot.came);
            let reference = references[slot.motion].as_ref();
            match reference.filter(|_| cell.status == Status::Completed) {
                Some(reference) => cell.judged(&reference.names, reference.errors(&rows)),
                None => cell.judged(&[], Vec::new()),
            }
        };
        let cells = self.cells.into_iter().map(judged).collect();
        let watched = references.iter().flatten().next().map_or(Vec::new(), |reference| reference.names.clone());
        (watched, cells)
    }
}
