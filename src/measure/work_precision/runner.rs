//! The order in which runs are made, and for how long.

use super::cell::{Cell, Outcome};
use super::grid::Triple;
use super::reference::{Given, Reference};
use super::sample::{Sample, sample};
use super::yardstick::Watched;
use super::{WorkPrecision, advice};
use crate::error::Result;
use crate::simulate::{Method, Span};
use crate::system::MechanicalSystem;
use std::time::{Duration, Instant};

/// What is measured on.
#[derive(Clone, Copy)]
pub struct Motion<'a> {
    pub system: &'a dyn MechanicalSystem,
    /// Consistent q and v.
    pub start: (&'a [f64], &'a [f64]),
    /// From when to when, s.
    pub between: (f64, f64),
    /// atol over rtol.
    pub ratio: f64,
    /// Whether the user wants it to end.
    pub is_stopped: &'a (dyn Fn() -> bool + Sync),
}

/// What to measure.
#[derive(Clone, Debug)]
pub struct Plan {
    pub triples: Vec<Triple>,
    /// For all of it.
    pub budget: Duration,
    /// Runs of each method that is worth it.
    pub repeats: usize,
    /// Times at which motions are compared.
    pub rows: usize,
    /// For which explicit and implicit methods are compared, however slow one kind is.
    pub digits: u32,
    /// Whether methods are tried on that have fallen behind.
    pub is_exhaustive: bool,
    /// Values to compare with, in the place of a computed reference.
    pub given: Option<Given>,
}

/// Part of the budget for the reference.
const REFERENCE: f64 = 0.25;
/// Runs are repeated that are up to so many times as slow as the best for their digits.
pub(super) const WORTH_REPEATING: f64 = 3.0;
/// A time below is taken over several runs, s.
const SHORTEST: f64 = 1e-3;

/// Makes the runs.
pub struct Runner<'a> {
    pub(super) motion: Motion<'a>,
    pub(super) plan: &'a Plan,
    watched: Watched,
    pub(super) clock: Instant,
    /// Called before every run with what it will be.
    watch: Box<Watch<'a>>,
}

/// Hears what is measured so far, and what comes next.
type Watch<'a> = dyn FnMut(&WorkPrecision, &str) + 'a;

/// Why no more runs are made.
pub(super) enum Pause {
    Budget,
    Asked,
}

impl<'a> Runner<'a> {
    pub fn new(
        motion: Motion<'a>,
        plan: &'a Plan,
        watched: Watched,
        watch: impl FnMut(&WorkPrecision, &str) + 'a,
    ) -> Self {
        Runner { motion, plan, watched, clock: Instant::now(), watch: Box::new(watch) }
    }

    /// Goes on from what `result` holds until all is measured, the budget is spent, or the user wants it to end.
    ///
    /// # Errors
    /// A motion that no method brings to its end; bad input.
    pub fn run(mut self, result: &mut WorkPrecision) -> Result<()> {
        let before = result.seconds;
        (result.left_out, self.clock) = (None, Instant::now());
        if result.reference.is_none() {
            (self.watch)(result, "reference");
            let allowed = self.plan.budget.mul_f64(REFERENCE);
            let given = self.plan.given.as_ref();
            let reference = Reference::find(&self.motion, &self.watched, (self.span(result), given), allowed);
            // One that was cut short is none.
            if (self.motion.is_stopped)() {
                result.left_out = Some("all: the measurement was interrupted".to_string());
                return Ok(());
            }
            result.reference = Some(reference?);
        }
        let paused = self.measure(result)?;
        result.seconds = before + self.clock.elapsed().as_secs_f64();
        let name = |cell: &Cell| {
            let Method { formulation, integrator, projection, .. } = &cell.method;
            self.plan.triples.iter().position(|triple| {
                (&triple.formulation, &triple.integrator, &triple.projection) == (formulation, integrator, projection)
            })
        };
        result.cells.sort_by_key(|cell| (name(cell), cell.decades));
        result.left_out = paused.map(|(pause, what)| match pause {
            Pause::Budget => format!("{what} did not fit into the budget of {} s", self.plan.budget.as_secs_f64()),
            Pause::Asked => format!("{what}: the measurement was interrupted"),
        });
        Ok(())
    }

    fn span(&self, result: &WorkPrecision) -> Span {
        let (start, end) = self.motion.between;
        Span { start, end, output_step: (end - start) / result.rows as f64 }
    }

    pub(super) fn left(&self) -> Duration {
        self.plan.budget.saturating_sub(self.clock.elapsed())
    }

    /// Whether to go on, with what comes next.
    pub(super) fn pauses(&mut self, result: &WorkPrecision, next: &str) -> Option<Pause> {
        (self.watch)(result, next);
        let is_over = self.left() == Duration::ZERO;
        if (self.motion.is_stopped)() { Some(Pause::Asked) } else { is_over.then_some(Pause::Budget) }
    }

    fn measure(&mut self, result: &mut WorkPrecision) -> Result<Option<(Pause, String)>> {
        let paused = self.climb(result)?;
        if let Some((Pause::Asked, _)) = paused {
            return Ok(paused);
        }
        self.settle(result)?;
        Ok(self.repeat(result)?.or(paused))
    }

    pub(super) fn sample(&self, result: &WorkPrecision, method: &Method, allowed: Duration) -> Result<Sample> {
        sample(&self.motion, &self.watched, method, self.span(result), allowed)
    }

    /// Rounds over all runs that are near the best for their digits.
    fn repeat(&mut self, result: &mut WorkPrecision) -> Result<Option<(Pause, String)>> {
        for round in 1..self.plan.repeats {
            let worth = advice::near_best(&result.cells, WORTH_REPEATING);
            for index in worth {
                let Outcome::Completed { cpu_seconds, .. } = &result.cells[index].outcome else { continue };
                let Some(seconds) = cpu_seconds.first().filter(|_| cpu_seconds.len() <= round) else { continue };
                let runs = (SHORTEST / seconds).ceil().clamp(1.0, 20.0);
                if let Some(pause) = self.pauses(result, &format!("repeat {round}")) {
                    return Ok(Some((pause, format!("repeats from number {} on", round + 1))));
                }
                let mut sum = 0.0;
                for _ in 0..runs as usize {
                    sum += self.sample(result, &result.cells[index].method, self.plan.budget)?.seconds;
                }
                if let Outcome::Completed { cpu_seconds, .. } = &mut result.cells[index].outcome {
                    cpu_seconds.push(sum / runs);
                }
            }
        }
        Ok(None)
    }
}
