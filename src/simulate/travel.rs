//! Runs that come to the end of a driver's travel, after which there is no motion.

use super::{Run, Sink};
use crate::error::Failure;
use crate::initial::{Travel, TravelEnd};
use crate::math::largest_in;
use crate::tolerances::simulate as tolerances;

const HINT: &str = "let the driver turn back before the end of its travel, or change lengths; `sweep` shows the travel";

/// The travel of a run's drivers.
pub struct Travelled<'a> {
    travel: Travel<'a>,
    /// Number of steps since the last look.
    steps: usize,
    /// Time since which steps tried are counted, and their number.
    crawl: (f64, usize),
}

impl<'a> Travelled<'a> {
    pub fn new(travel: Travel<'a>) -> Self {
        Travelled { travel, steps: 0, crawl: (f64::NEG_INFINITY, 0) }
    }
}

impl Run<'_> {
    /// Ends the run if a driver came to the end of its travel in the step to `t`, where the state is `next`. A look
    /// takes some factorizations: only where the constraints are open or nearly lose rank, or now and then where their
    /// rank is not known.
    pub fn check_travel(&mut self, t: f64) -> Result<(), Failure> {
        let open = largest_in(&self.scales, &self.problem.dynamics.terms.phi);
        let is_doubtful = open > tolerances::TRAVEL_OPEN || self.approach.may_be_singular();
        let Some(travelled) = &mut self.travelled else { return Ok(()) };
        travelled.steps += 1;
        let is_unknown = self.approach.is_unknown() && travelled.steps >= tolerances::TRAVEL_STEPS;
        if !(is_doubtful || is_unknown) {
            return Ok(());
        }
        travelled.steps = 0;
        let (q, _) = self.problem.split(&self.next);
        match travelled.travel.end_before(t, q, self.span.end) {
            Some(end) => Err(ended(end)),
            None => Ok(()),
        }
    }

    /// Ends a run whose steps crawl towards the end of a travel, where the drivers leave no freedom.
    pub fn check_crawl(&mut self) -> Result<(), Failure> {
        let duration = self.span.end - self.span.start;
        let Some(travelled) = self.travelled.as_mut().filter(|travelled| travelled.travel.is_determined()) else {
            return Ok(());
        };
        travelled.crawl.1 += 1;
        if travelled.crawl.1 < tolerances::TRAVEL_TRIES {
            return Ok(());
        }
        let (since, _) = std::mem::replace(&mut travelled.crawl, (self.t, 0));
        if self.t - since > tolerances::TRAVEL_AHEAD * duration {
            return Ok(());
        }
        let (q, _) = self.problem.split(&self.y);
        let ahead = tolerances::TRAVEL_AHEAD_OF_CRAWL * duration;
        travelled.travel.end_within((self.t, q), ahead, self.span.end).map_or(Ok(()), |end| Err(ended(end)))
    }

    /// The failure of a run, whose reason may be the end of a travel near the last state.
    pub fn explained(&mut self, failure: Failure, sink: &dyn Sink) -> Failure {
        let part = if self.approach.is_near() { tolerances::TRAVEL_AHEAD_OF_CRAWL } else { tolerances::TRAVEL_AHEAD };
        let Some(travelled) = self.travelled.as_mut().filter(|_| sink.stops().is_none()) else { return failure };
        let (q, _) = self.problem.split(&self.y);
        let ahead = part * (self.span.end - self.span.start);
        travelled.travel.end_within((self.t, q), ahead, self.span.end).map_or(failure, ended)
    }
}

fn ended(TravelEnd { t, reason }: TravelEnd) -> Failure {
    Failure { t, reason, hint: HINT.to_string() }
}
