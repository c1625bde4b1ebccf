//! The order in which runs are made, and for how long.

use super::cell::{Cell, Outcome};
use super::grid::Triple;
use super::reference::{Given, Reference};
use super::sample::{Sample, sample};
use super::yardstick::Watched;
use super::{WorkPrecision, advice};
use crate::error::{Error, Failure, Result, short};
use crate::integrator::{self, Steps};
use crate::simulate::{Method, Span, explicit};
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

/// rtol = 10^-decades: first these, of all methods,
const COARSE: [u32; 4] = [3, 6, 9, 12];
/// then these, of methods that are near the best somewhere.
const FINE: [u32; 6] = [4, 5, 7, 8, 10, 11];
/// Part of the budget for the reference.
const REFERENCE: f64 = 0.25;
/// Parts of the budget that one run may take: quick runs of all methods come before slow ones of any.
const RUN: [f64; 4] = [0.001, 0.005, 0.02, 0.08];
/// Part of the budget after which no more of the grid is tried, so that repeats find their time.
const GRID: f64 = 0.75;
/// Times as slow as the best for its digits: a method is tried on, and repeated, below these.
const WORTH_TRYING: f64 = 10.0;
const WORTH_REPEATING: f64 = 3.0;
/// A time below is taken over several runs, s.
const SHORTEST: f64 = 1e-3;
/// A fixed step errs by 10^-decades where it is this part of the pace times 10^-(decades/p).
const FIXED: f64 = 0.3;

/// Makes the runs.
pub struct Runner<'a> {
    motion: Motion<'a>,
    plan: &'a Plan,
    watched: Watched,
    clock: Instant,
    /// Called before every run with what it will be.
    watch: Box<dyn FnMut(&WorkPrecision, &str) + 'a>,
}

/// Why no more runs are made.
enum Pause {
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
            result.reference = Some(Reference::find(&self.motion, &self.watched, (self.span(result), given), allowed)?);
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
            Pause::Asked => format!("{what} were left out: the measurement was interrupted"),
        });
        Ok(())
    }

    fn span(&self, result: &WorkPrecision) -> Span {
        let (start, end) = self.motion.between;
        Span { start, end, output_step: (end - start) / result.rows as f64 }
    }

    fn left(&self) -> Duration {
        self.plan.budget.saturating_sub(self.clock.elapsed())
    }

    /// Whether to go on, with what comes next.
    fn pauses(&mut self, result: &WorkPrecision, next: &str) -> Option<Pause> {
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

    /// The grid: quick runs of all methods, then longer ones.
    fn climb(&mut self, result: &mut WorkPrecision) -> Result<Option<(Pause, String)>> {
        for part in RUN {
            let allowed = self.plan.budget.mul_f64(part);
            let ladder = COARSE.map(|decades| (decades, false)).into_iter().chain(FINE.map(|decades| (decades, true)));
            for (decades, is_fine) in ladder {
                if let Some(paused) = self.rung(result, decades, is_fine, allowed)? {
                    return Ok(Some(paused));
                }
            }
        }
        Ok(None)
    }

    /// All methods at one accuracy that are worth it and not done.
    fn rung(
        &mut self,
        result: &mut WorkPrecision,
        decades: u32,
        is_fine: bool,
        allowed: Duration,
    ) -> Result<Option<(Pause, String)>> {
        let pending = self.pending(result, decades, is_fine, allowed);
        for (done, triple) in pending.iter().enumerate() {
            let method = self.method(result, triple, decades);
            let pause = match self.clock.elapsed() > self.plan.budget.mul_f64(GRID) {
                true => Some(Pause::Budget),
                false => self.pauses(result, &method.triple()),
            };
            if let Some(pause) = pause {
                let what = format!("{} runs at 1e-{decades} and what comes after them", pending.len() - done);
                return Ok(Some((pause, what)));
            }
            let outcome = match self.skips(result, triple, decades, allowed) {
                Some(reason) => Outcome::Skipped { reason },
                None => self.first(result, &method, allowed.min(self.left()))?,
            };
            // What was cut short is no result.
            if !(self.motion.is_stopped)() {
                self.put(result, triple, decades, outcome);
            }
        }
        Ok(None)
    }

    /// In the place of what was there.
    fn put(&self, result: &mut WorkPrecision, triple: &Triple, decades: u32, outcome: Outcome) {
        let method = self.method(result, triple, decades);
        result.cells.retain(|cell| !(cell.decades == decades && cell.is_of(&method)));
        let is_explicit = self.is_explicit(triple);
        result.cells.push(Cell { method, decades, is_explicit, outcome });
    }

    /// Those that will be quick come first: what they take is what the others are judged by.
    fn pending(&self, result: &WorkPrecision, decades: u32, is_fine: bool, allowed: Duration) -> Vec<&'a Triple> {
        let mut pending: Vec<(f64, &Triple)> = Vec::new();
        let is_last = allowed == self.longest();
        for triple in &self.plan.triples {
            let own = cells_of(result, triple).find(|cell| cell.decades == decades);
            let is_due = own.is_none_or(|cell| matches!(cell.outcome, Outcome::TooSlow { .. }));
            let seconds = self.forecast(result, triple, decades).map_or(0.0, |forecast| forecast.seconds);
            let fits = is_last || seconds <= allowed.as_secs_f64();
            if is_due && fits && (!is_fine || self.plan.is_exhaustive || is_near_best(result, triple)) {
                pending.push((seconds, triple));
            }
        }
        pending.sort_by(|a, b| a.0.total_cmp(&b.0));
        pending.into_iter().map(|(_, triple)| triple).collect()
    }

    /// The most that one run may take.
    fn longest(&self) -> Duration {
        self.plan.budget.mul_f64(RUN[RUN.len() - 1])
    }

    /// Where no explicit method came to the digits asked for, or no implicit one, the run is made that will be the quickest
    /// of its kind, so that it is known by how much the other kind wins.
    fn settle(&mut self, result: &mut WorkPrecision) -> Result<()> {
        for kind in [true, false] {
            let is_kind = |cell: &&Cell| cell.is_explicit == kind && cell.reason().is_some();
            let has = |cell: &Cell| cell.is_explicit == kind && cell.digits() >= Some(f64::from(self.plan.digits));
            let forecast = |cell: &Cell| {
                let triple = self.plan.triples.iter().find(|triple| cell.is_of(&triple.at((1.0, 1.0), None)))?;
                let forecast = self.forecast(result, triple, cell.decades)?;
                // What is slow for its stability is no slower for more digits.
                Some((forecast.seconds, triple, cell.decades.max(self.plan.digits)))
            };
            if result.cells.iter().any(has) {
                continue;
            }
            let candidates = result.cells.iter().filter(is_kind).filter_map(forecast);
            if let Some((_, triple, decades)) = candidates.min_by(|a, b| a.0.total_cmp(&b.0)) {
                let method = self.method(result, triple, decades);
                let outcome = self.first(result, &method, self.left().mul_f64(0.5))?;
                self.put(result, triple, decades, outcome);
            }
        }
        Ok(())
    }

    fn is_explicit(&self, triple: &Triple) -> bool {
        explicit(self.motion.system, &triple.at((1e-6, 1e-6), None)).is_some()
    }

    fn method(&self, result: &WorkPrecision, triple: &Triple, decades: u32) -> Method {
        let rtol = 0.1f64.powi(decades as i32);
        let rtol = format!("{rtol:.0e}").parse().unwrap_or(rtol);
        let entry = integrator::find(&triple.integrator).ok();
        let step = entry.filter(|entry| entry.steps == Steps::Fixed).map(|entry| {
            let pace = result.reference.as_ref().map_or(1.0, |reference| match self.is_explicit(triple) {
                true => reference.pace.explicit,
                false => reference.pace.implicit,
            });
            let step = FIXED * pace * 10f64.powf(-f64::from(decades) / entry.order as f64);
            let (start, end) = self.motion.between;
            (end - start) / ((end - start) / step).ceil().max(1.0)
        });
        let atol = rtol * self.motion.ratio;
        triple.at((rtol, format!("{atol:.3e}").parse().unwrap_or(atol)), step)
    }

    /// Why a run is not worth making.
    fn skips(&self, result: &WorkPrecision, triple: &Triple, decades: u32, allowed: Duration) -> Option<String> {
        if self.plan.is_exhaustive {
            return None;
        }
        let own = result.reference.as_ref()?.error;
        let last = last(result, triple, decades);
        if last.and_then(Cell::error).is_some_and(|error| error <= own) {
            return Some("as accurate as the reference at a looser tolerance already".to_string());
        }
        let forecast = self.forecast(result, triple, decades)?;
        let seconds = two(forecast.seconds);
        let best = advice::cheapest(&result.cells, forecast.error).and_then(|best| Some((best, best.seconds()?)));
        match best {
            Some((best, cheapest)) if forecast.seconds > WORTH_TRYING * cheapest => {
                Some(format!("would take about {seconds} s, where {} takes {} s", best.method.triple(), two(cheapest)))
            }
            _ if forecast.seconds > 2.0 * allowed.as_secs_f64() => {
                Some(format!("would take about {seconds} s, more than the {} s that a run may", allowed.as_secs_f64()))
            }
            _ => None,
        }
    }

    /// By the run itself where it was stopped, else by the tightest run of the method so far: each decade costs the p-th
    /// root of ten.
    fn forecast(&self, result: &WorkPrecision, triple: &Triple, decades: u32) -> Option<Forecast> {
        let (start, end) = self.motion.between;
        let own = cells_of(result, triple).find(|cell| cell.decades == decades);
        let last = own.or_else(|| last(result, triple, decades))?;
        let more = f64::from(decades - last.decades);
        let order = integrator::find(&triple.integrator).ok()?.order;
        let (seconds, error) = match &last.outcome {
            // One that was stopped at once says nothing.
            Outcome::TooSlow { t, cpu_seconds, .. } if *t > start => {
                (cpu_seconds * (end - start) / (t - start), 0.1f64.powf(f64::from(last.decades)))
            }
            _ => (last.seconds()?, last.error()?),
        };
        Some(Forecast { seconds: seconds * 10f64.powf(more / order as f64), error: error * 0.1f64.powf(more) })
    }

    fn first(&self, result: &WorkPrecision, method: &Method, allowed: Duration) -> Result<Outcome> {
        let run = match self.sample(result, method, allowed) {
            // What a method cannot do for this mechanism is a result, since all were asked for.
            Err(Error::Input(input)) => return Ok(Outcome::Skipped { reason: input.message }),
            run => run?,
        };
        if let Some(Failure { t, .. }) = run.failure.as_ref().filter(|_| run.is_too_slow) {
            let (start, end) = self.motion.between;
            let all = two(run.seconds * (end - start) / (t - start));
            let reason = format!("would take about {all} s: it came to t = {t:.3e} s in {} s", two(run.seconds));
            return Ok(Outcome::TooSlow { t: *t, cpu_seconds: run.seconds, reason });
        }
        if let Some(failure) = run.failure {
            return Ok(Outcome::Failed { failure, cpu_seconds: run.seconds });
        }
        let Some(reference) = &result.reference else { return Ok(Outcome::Skipped { reason: String::new() }) };
        let (error, worst) = reference.values.error(&run.rows);
        if !error.is_finite() {
            let (reason, hint) = ("the result is not finite".to_string(), "try a tighter tolerance".to_string());
            let failure = Failure { t: self.motion.between.1, reason, hint };
            return Ok(Outcome::Failed { failure, cpu_seconds: run.seconds });
        }
        Ok(Outcome::Completed {
            error,
            worst: worst.to_string(),
            drift: (&run.drift).into(),
            cpu_seconds: vec![run.seconds],
            statistics: run.statistics,
        })
    }

    fn sample(&self, result: &WorkPrecision, method: &Method, allowed: Duration) -> Result<Sample> {
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

/// What a run will take and give.
struct Forecast {
    seconds: f64,
    error: f64,
}

fn cells_of<'r>(result: &'r WorkPrecision, triple: &Triple) -> impl Iterator<Item = &'r Cell> {
    let key = triple.at((1.0, 1.0), None);
    result.cells.iter().filter(move |cell| cell.is_of(&key))
}

/// The tightest run below.
fn last<'r>(result: &'r WorkPrecision, triple: &Triple, decades: u32) -> Option<&'r Cell> {
    cells_of(result, triple).filter(|cell| cell.decades < decades).max_by_key(|cell| cell.decades)
}

fn is_near_best(result: &WorkPrecision, triple: &Triple) -> bool {
    let key = triple.at((1.0, 1.0), None);
    advice::near_best(&result.cells, WORTH_REPEATING).iter().any(|index| result.cells[*index].is_of(&key))
}

fn two(value: f64) -> String {
    short(format!("{value:.1e}").parse().unwrap_or(value))
}
