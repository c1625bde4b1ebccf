//! Order of the runs of the grid, and the runs that are skipped.

use super::cell::{Cell, Outcome};
use super::grid::Triple;
use super::runner::{Pause, Runner};
use super::{WorkPrecision, advice};
use crate::error::{Error, Failure, Result, rounded, two_digits};
use crate::integrator::{self, Steps};
use crate::simulate::{Method, atol_of, explicit};
use crate::study::run::{RunSample, extrapolated};
use std::time::Duration;

/// rtol = 10^-decades: first these, of all methods.
const COARSE: [u32; 4] = [3, 6, 9, 12];
/// Then these, of methods that are near the best at some accuracy; first the digits most often requested.
const FINE: [u32; 6] = [7, 5, 8, 4, 10, 11];
/// Parts of the budget that one run may take: short runs of all methods come before long ones of any.
const RUN: [f64; 4] = [0.001, 0.005, 0.02, LONGEST];
const LONGEST: f64 = 0.1;
/// A run is skipped if its forecast is longer than this many times its limit.
const SURE: f64 = 1.2;
/// Part of the budget for the comparison of explicit and implicit methods.
const SETTLED: f64 = 0.15;
/// Cost relative to the best with as many digits below which a method is tried at tighter tolerances.
const WORTH_TRYING: f64 = 5.0;
/// Cost relative to the best below which a method is run at all tolerances.
const NEAR: f64 = 3.0;
/// Fixed steps are this part of pace 10^-(decades/p), which gives an error of about 10^-decades.
const FIXED: f64 = 0.3;

fn sequence() -> impl Iterator<Item = u32> {
    COARSE.into_iter().chain(FINE)
}

impl<'a> Runner<'a> {
    /// Runs the grid: short runs of all methods, then longer ones.
    pub(super) fn climb(&mut self, result: &mut WorkPrecision) -> Result<Option<Pause>> {
        for part in RUN {
            if part == LONGEST {
                self.settle(result)?;
            }
            for decades in sequence() {
                if let Some(paused) = self.rung(result, decades, part)? {
                    return Ok(Some(paused));
                }
            }
        }
        Ok(None)
    }

    /// Makes the runs of all methods at one accuracy that are worth it and not done.
    fn rung(&mut self, result: &mut WorkPrecision, decades: u32, part: f64) -> Result<Option<Pause>> {
        let allowed = self.plan.budget.mul_f64(part);
        for triple in self.pending(result, decades, part) {
            let method = self.method(result, triple, decades);
            if let Some(pause) = self.pauses(result, &method.triple()) {
                return Ok(Some(pause));
            }
            let outcome = match self.skips(result, triple, decades, allowed) {
                Some(reason) => skipped(result, triple, decades, reason),
                None => self.first(result, &method, self.limit(result, decades, allowed))?,
            };
            // An interrupted run gives no result.
            if !(self.motion.is_stopped)() {
                self.put(result, triple, decades, outcome);
            }
        }
        Ok(None)
    }

    /// Returns the time limit of a run: its own, and a multiple of that of the cheapest with as many digits.
    fn limit(&self, result: &WorkPrecision, decades: u32, allowed: Duration) -> Duration {
        let best = advice::cheapest(&result.cells, 0.1f64.powf(f64::from(decades))).and_then(|best| best.cost);
        let allowed = allowed.min(self.budget.left());
        match best {
            Some(best) if !self.plan.is_exhaustive => allowed.min(Duration::from_secs_f64(WORTH_TRYING * best)),
            _ => allowed,
        }
    }

    /// Gives every run of the grid that was not made its reason; returns the number of runs not made because of
    /// `paused`.
    pub(super) fn leave_out(&self, result: &mut WorkPrecision, paused: Option<&Pause>) -> usize {
        let behind = advice::behind(&result.cells);
        let mut left_out = 0;
        for (triple, decades) in self.plan.triples.iter().flat_map(|t| sequence().map(move |d| (t, d))) {
            if cells_of(result, triple).any(|cell| cell.decades == decades) {
                continue;
            }
            let own = result.cells.iter().zip(&behind).filter(|(cell, _)| triple.is_of(&cell.method));
            let own = own.filter_map(|(_, behind)| *behind);
            let reason = match own.reduce(f64::min) {
                Some(times) if times > NEAR && FINE.contains(&decades) => {
                    format!("takes {} times as long as the best for its digits, where it is nearest", two_digits(times))
                }
                None if FINE.contains(&decades) => "no run of this method came through".to_string(),
                _ if paused.is_some() => {
                    left_out += 1;
                    let forecast = self.forecast(result, triple, decades);
                    let time = forecast.map_or(String::new(), |forecast| {
                        format!(": would take about {} s", two_digits(forecast.seconds))
                    });
                    format!("did not fit into the budget of {} s{time}", self.plan.budget.as_secs_f64())
                }
                _ => "would take longer than a run may".to_string(),
            };
            self.put(result, triple, decades, Outcome::Skipped { reason });
        }
        left_out
    }

    /// Adds the runs that the reference was found by, where they belong to the grid.
    pub(super) fn keep(&self, result: &mut WorkPrecision, runs: Vec<RunSample>) {
        for run in runs {
            let own = self.plan.triples.iter().find(|triple| triple.is_of(&run.method));
            let decades = sequence().find(|decades| rtol(*decades) == run.method.rtol);
            if let Some((triple, decades)) = own.zip(decades) {
                let seconds = vec![run.seconds];
                self.put(result, triple, decades, self.outcome(result, run, seconds));
            }
        }
    }

    /// Replaces the cell of this run.
    fn put(&self, result: &mut WorkPrecision, triple: &Triple, decades: u32, outcome: Outcome) {
        let method = self.method(result, triple, decades);
        result.cells.retain(|cell| !(cell.decades == decades && cell.is_of(&method)));
        let is_explicit = self.is_explicit(triple);
        result.cells.push(Cell { method, decades, is_explicit, cost: None, outcome });
        result.price();
    }

    /// Returns the methods still to run, those expected to be short first: later ones are judged by their times.
    fn pending(&self, result: &WorkPrecision, decades: u32, part: f64) -> Vec<&'a Triple> {
        let allowed = self.plan.budget.mul_f64(part);
        let behind = advice::behind(&result.cells);
        let is_near = |triple: &Triple| {
            let mut own = result.cells.iter().zip(&behind).filter(|(cell, _)| triple.is_of(&cell.method));
            own.any(|(_, behind)| behind.is_some_and(|times| times <= NEAR))
        };
        let is_tried = |triple: &Triple| COARSE.contains(&decades) || self.plan.is_exhaustive || is_near(triple);
        let mut pending: Vec<(f64, &Triple)> = Vec::new();
        for triple in &self.plan.triples {
            let own = cells_of(result, triple).find(|cell| cell.decades == decades);
            let is_due = own.is_none_or(|cell| matches!(cell.outcome, Outcome::TooSlow { .. }));
            let seconds = self.forecast(result, triple, decades).map_or(0.0, |forecast| forecast.seconds);
            let fits = part == LONGEST || seconds <= allowed.as_secs_f64();
            if is_due && fits && is_tried(triple) {
                pending.push((seconds, triple));
            }
        }
        pending.sort_by(|a, b| a.0.total_cmp(&b.0));
        pending.into_iter().map(|(_, triple)| triple).collect()
    }

    /// If no explicit method, or no implicit one, reached the digits asked for, runs the method of this kind that is
    /// expected to be the quickest, so that both kinds can be compared.
    fn settle(&mut self, result: &mut WorkPrecision) -> Result<()> {
        for kind in [true, false] {
            let has = |cell: &Cell| cell.is_explicit == kind && cell.digits() >= Some(f64::from(self.plan.digits));
            if result.cells.iter().any(has) {
                continue;
            }
            // By the runs so far: where stability limits the steps, more digits cost no more.
            let forecast = |triple: &'a Triple| {
                let tightest = cells_of(result, triple).max_by_key(|cell| cell.decades)?;
                let seconds = self.forecast(result, triple, tightest.decades)?.seconds;
                Some((seconds, triple, self.needed(tightest)))
            };
            let of_kind = self.plan.triples.iter().filter(|triple| self.is_explicit(triple) == kind);
            let quickest = of_kind.filter_map(forecast).min_by(|a, b| a.0.total_cmp(&b.0));
            if let Some((_, triple, decades)) = quickest {
                let method = self.method(result, triple, decades);
                let outcome = self.first(result, &method, self.budget.left().min(self.plan.budget.mul_f64(SETTLED)))?;
                self.put(result, triple, decades, outcome);
            }
        }
        Ok(())
    }

    /// Returns the decades at which the method of a run is expected to have the digits asked for.
    fn needed(&self, run: &Cell) -> u32 {
        let more = run.digits().map_or(0.0, |digits| (f64::from(self.plan.digits) - digits).ceil());
        (run.decades + more.max(0.0) as u32).max(self.plan.digits)
    }

    fn is_explicit(&self, triple: &Triple) -> bool {
        explicit(&triple.at(1e-6, 1e-6, None)).is_some()
    }

    fn method(&self, result: &WorkPrecision, triple: &Triple, decades: u32) -> Method {
        let entry = integrator::find(&triple.integrator).ok();
        let step = entry.filter(|entry| entry.steps == Steps::Fixed).map(|entry| {
            let pace = result.reference.as_ref().map_or(1.0, |reference| {
                if self.is_explicit(triple) { reference.pace.explicit } else { reference.pace.implicit }
            });
            let step = FIXED * pace * 10f64.powf(-f64::from(decades) / entry.order as f64);
            self.motion.duration() / (self.motion.duration() / step).ceil().max(1.0)
        });
        let rtol = rtol(decades);
        triple.at(rtol, atol_of(rtol, self.motion.ratio), step)
    }

    /// Returns the reason why a run is not worth making; none if it is.
    fn skips(&self, result: &WorkPrecision, triple: &Triple, decades: u32, allowed: Duration) -> Option<String> {
        if self.plan.is_exhaustive {
            return None;
        }
        let own = result.reference.as_ref()?.error;
        let last = last(result, triple, decades);
        // An error includes that of the reference.
        if last.and_then(Cell::error).is_some_and(|error| error <= 2.0 * own) {
            return Some("as accurate as the reference at a looser tolerance already".to_string());
        }
        let forecast = self.forecast(result, triple, decades)?;
        let seconds = two_digits(forecast.seconds);
        let best = advice::cheapest(&result.cells, forecast.error).and_then(|best| Some((best, best.cost?)));
        match best {
            Some((best, cheapest)) if forecast.seconds > WORTH_TRYING * cheapest => Some(format!(
                "would take about {seconds} s, where {} takes {} s",
                best.method.triple(),
                two_digits(cheapest)
            )),
            _ if forecast.seconds > SURE * allowed.as_secs_f64() => {
                Some(format!("would take about {seconds} s, more than the {} s that a run may", allowed.as_secs_f64()))
            }
            _ => None,
        }
    }

    /// Forecasts a run from itself where it was stopped, else from the tightest run of the method so far: each decade
    /// costs the p-th root of ten, or the ratio of the tightest two where that is less.
    fn forecast(&self, result: &WorkPrecision, triple: &Triple, decades: u32) -> Option<Forecast> {
        let own = cells_of(result, triple).find(|cell| cell.decades == decades);
        let last = own.or_else(|| last(result, triple, decades))?;
        let more = f64::from(decades - last.decades);
        let decade = 10f64.powf(1.0 / integrator::find(&triple.integrator).ok()?.order as f64);
        let (seconds, error) = match &last.outcome {
            Outcome::TooSlow { t, cpu_seconds, .. } => {
                let seconds = extrapolated(last.cost.unwrap_or(*cpu_seconds), *t, self.motion.span)?;
                (seconds, 0.1f64.powf(f64::from(last.decades)))
            }
            _ => (last.cost?, last.error()?),
        };
        let before = self::last(result, triple, last.decades);
        let before = before.and_then(|cell| Some((cell.error().and(cell.cost)?, cell.decades)));
        let own_decade = before.map(|(before, at)| (seconds / before).powf(1.0 / f64::from(last.decades - at)));
        let decade = own_decade.map_or(decade, |own| decade.min(own.max(1.0)));
        Some(Forecast { seconds: seconds * decade.powf(more), error: error * 0.1f64.powf(more) })
    }

    fn first(&self, result: &WorkPrecision, method: &Method, allowed: Duration) -> Result<Outcome> {
        let (run, cpu_seconds) = match self.sample(method, allowed) {
            // Methods that cannot be applied to this mechanism are a result, since all were asked for.
            Err(Error::Input(input)) => return Ok(Outcome::Skipped { reason: input.message }),
            run => run?,
        };
        Ok(self.outcome(result, run, cpu_seconds))
    }

    fn outcome(&self, result: &WorkPrecision, run: RunSample, cpu_seconds: Vec<f64>) -> Outcome {
        if let Some(Failure { t, .. }) = run.failure.as_ref().filter(|_| run.is_too_slow) {
            let came = format!("it came to t = {t:.3e} s in {} s", two_digits(run.seconds));
            let reason = match extrapolated(run.seconds, *t, self.motion.span) {
                Some(whole) => format!("would take about {} s: {came}", two_digits(whole)),
                None => format!("is too slow: {came}"),
            };
            return Outcome::TooSlow { t: *t, cpu_seconds: run.seconds, statistics: run.statistics, reason };
        }
        if let Some(failure) = run.failure {
            return Outcome::Failed { failure, cpu_seconds: run.seconds };
        }
        let Some(reference) = &result.reference else { return Outcome::Skipped { reason: String::new() } };
        let (error, worst) = reference.values.error(&run.rows);
        if !error.is_finite() {
            let reason = "the result is not finite".to_string();
            let hint = "try a tighter tolerance".to_string();
            let failure = Failure { t: self.motion.span.end, reason, hint };
            return Outcome::Failed { failure, cpu_seconds: run.seconds };
        }
        Outcome::Completed {
            error: error + reference.error,
            worst,
            drift: (&run.drift).into(),
            cpu_seconds,
            statistics: run.statistics,
        }
    }
}

/// Returns a skipped run; the part completed by a run that was stopped is kept.
fn skipped(result: &WorkPrecision, triple: &Triple, decades: u32, reason: String) -> Outcome {
    let own = cells_of(result, triple).find(|cell| cell.decades == decades);
    match own.map(|cell| &cell.outcome) {
        Some(&Outcome::TooSlow { t, cpu_seconds, statistics, .. }) => {
            Outcome::TooSlow { t, cpu_seconds, statistics, reason }
        }
        _ => Outcome::Skipped { reason },
    }
}

/// Expected time, s, and error of a run.
struct Forecast {
    seconds: f64,
    error: f64,
}

fn cells_of<'r>(result: &'r WorkPrecision, triple: &'r Triple) -> impl Iterator<Item = &'r Cell> {
    result.cells.iter().filter(move |cell| triple.is_of(&cell.method))
}

/// Returns the tightest run looser than `decades`.
fn last<'r>(result: &'r WorkPrecision, triple: &'r Triple, decades: u32) -> Option<&'r Cell> {
    cells_of(result, triple).filter(|cell| cell.decades < decades).max_by_key(|cell| cell.decades)
}

fn rtol(decades: u32) -> f64 {
    rounded(0.1f64.powi(decades as i32), 0)
}
