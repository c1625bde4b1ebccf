//! Order and duration of the runs.

use super::WorkPrecision;
use super::cell::Cell;
use super::given::GivenValues;
use super::grid::Triple;
use super::reference::Reference;
use crate::error::Result;
use crate::simulate::Method;
use crate::study::budget::{Budget, Limit};
use crate::study::run::{Motion, RunSample};
use std::time::Duration;

/// Plan of a measurement.
#[derive(Clone, Debug)]
pub struct TradeoffPlan {
    /// Methods.
    pub triples: Vec<Triple>,
    /// Total time.
    pub budget: Duration,
    /// Repetitions of a short run; the least time counts.
    pub repeats: usize,
    /// Number of times at which motions are compared.
    pub rows: usize,
    /// Digits that the reference must have, and for which explicit and implicit methods are compared, however slow one
    /// kind is.
    pub digits: u32,
    /// True if methods far behind are tried at tighter tolerances too.
    pub is_exhaustive: bool,
    /// Reference values that replace a computed reference.
    #[doc(hidden)]
    pub given: Option<GivenValues>,
}

/// Part of the budget after which no more runs are begun.
const GRID: f64 = 0.95;

/// Makes the runs.
pub struct Runner<'a> {
    pub(super) motion: Motion<'a>,
    pub(super) plan: &'a TradeoffPlan,
    pub(super) budget: Budget,
    /// Called before every run with its description.
    watch: Box<ProgressWatch<'a>>,
}

/// Called with the results so far, and the next run.
type ProgressWatch<'a> = dyn FnMut(&WorkPrecision, &str) + 'a;

/// Reason why no more runs are made.
pub(super) enum Pause {
    Budget,
    Asked,
}

impl<'a> Runner<'a> {
    /// A runner for a plan; `watch` is called before every run.
    pub fn new(motion: Motion<'a>, plan: &'a TradeoffPlan, watch: impl FnMut(&WorkPrecision, &str) + 'a) -> Self {
        Runner { motion, plan, budget: Budget::begin(plan.budget), watch: Box::new(watch) }
    }

    /// Continues from `result` until all is measured, the budget is spent, or the user stops it.
    ///
    /// # Errors
    /// A motion that no method completes; bad input.
    pub fn run(mut self, result: &mut WorkPrecision) -> Result<()> {
        let before = result.seconds;
        result.left_out = None;
        self.budget = Budget::begin(self.plan.budget);
        self.motion.span.output_step = self.motion.duration() / result.rows as f64;
        if result.reference.is_none() {
            (self.watch)(result, "reference");
            let TradeoffPlan { digits, budget, .. } = self.plan;
            let reference = Reference::find(&self.motion, self.plan.given.as_ref(), *digits, *budget);
            // An interrupted search gives no reference.
            if (self.motion.is_stopped)() {
                result.left_out = Some("all: the measurement was interrupted".to_string());
                return Ok(());
            }
            let (reference, runs) = reference?;
            result.reference = Some(reference);
            self.keep(result, runs);
        }
        result.price();
        let paused = self.climb(result)?;
        let left_out = self.leave_out(result, paused.as_ref());
        result.seconds = before + self.budget.spent().as_secs_f64();
        let rank = |cell: &Cell| self.plan.triples.iter().position(|triple| triple.is_of(&cell.method));
        result.cells.sort_by_key(|cell| (rank(cell), cell.decades));
        result.left_out = paused.map(|pause| match pause {
            Pause::Budget => format!(
                "{left_out} runs that did not fit into the budget of {} s; --resume goes on",
                self.plan.budget.as_secs_f64()
            ),
            Pause::Asked => format!("{left_out} runs: the measurement was interrupted"),
        });
        Ok(())
    }

    /// Announces the next run; returns a reason to stop, if any.
    pub(super) fn pauses(&mut self, result: &WorkPrecision, next: &str) -> Option<Pause> {
        (self.watch)(result, next);
        if (self.motion.is_stopped)() {
            return Some(Pause::Asked);
        }
        (self.budget.spent() > self.plan.budget.mul_f64(GRID)).then_some(Pause::Budget)
    }

    /// Makes a run, several times if it is short.
    pub(super) fn sample(&self, method: &Method, cpu: Duration) -> Result<(RunSample, Vec<f64>)> {
        let limit = Limit { wall: self.budget.left(), cpu };
        let first = self.motion.run(method, limit)?;
        let mut seconds = vec![first.seconds];
        let quick = 5e-4 * self.plan.budget.as_secs_f64();
        while first.failure.is_none() && seconds.len() < self.plan.repeats && first.seconds < quick {
            seconds.push(self.motion.run(method, limit)?.seconds);
        }
        Ok((first, seconds))
    }
}
