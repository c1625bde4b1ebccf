//! Runs that come to the end of a driver's travel, after which there is no motion.

use super::{Sink, TimeLoop};
use crate::error::Failure;
use crate::initial::{Travel, TravelEnd};
use crate::math::largest_in;
use crate::tolerances;

/// Steps after which the travel of drivers is looked at where no rank indicator is known. Unit: `[steps]`. Why: a look
/// takes as long as a few steps. Test: `a_driver_beyond_its_travel_is_named`.
const TRAVEL_STEPS: usize = 20;

/// Steps tried that come no farther than UNSEEN: they may crawl towards the end of a travel. Unit: `[steps]`.
/// Why: a look takes as long as a few steps. Test: `a_driver_beyond_its_travel_is_named`.
const TRAVEL_TRIES: usize = 500;

/// The time ahead in which a run that crawls, or fails near a singular state, may come to the end of a travel. Unit:
/// `[1]` of the span. Why: index3 by generalized_alpha fails 0.0035 of it before. Test:
/// `a_driver_beyond_its_travel_is_named`.
const TRAVEL_AHEAD_OF_CRAWL: f64 = 1e-2;

const HINT: &str =
    "let the driver turn back before the end of its travel, or change lengths; `kinematics` shows the travel";

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

impl TimeLoop<'_> {
    /// Ends the run if a driver came to the end of its travel in the step to `t`, where the state is `next`. A look
    /// takes some factorizations: only where the constraints are open or nearly lose rank, or now and then where their
    /// rank is not known.
    pub fn check_travel(&mut self, t: f64) -> Result<(), Failure> {
        let Some(travelled) = &mut self.travelled else { return Ok(()) };
        let open = largest_in(&self.scales, &self.problem.dynamics.terms.phi);
        let is_doubtful = open > tolerances::SIX_DIGITS || self.approach.may_be_singular();
        travelled.steps += 1;
        let is_unknown = self.approach.is_unknown() && travelled.steps >= TRAVEL_STEPS;
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
        if travelled.crawl.1 < TRAVEL_TRIES {
            return Ok(());
        }
        let (since, _) = std::mem::replace(&mut travelled.crawl, (self.t, 0));
        if self.t - since > tolerances::UNSEEN * duration {
            return Ok(());
        }
        let (q, _) = self.problem.split(&self.y);
        let ahead = TRAVEL_AHEAD_OF_CRAWL * duration;
        travelled.travel.end_within(self.t, q, ahead, self.span.end).map_or(Ok(()), |end| Err(ended(end)))
    }

    /// The failure of a run, whose reason may be the end of a travel near the last state.
    pub fn explained(&mut self, failure: Failure, sink: &dyn Sink) -> Failure {
        let part = if self.approach.is_near() { TRAVEL_AHEAD_OF_CRAWL } else { tolerances::UNSEEN };
        let Some(travelled) = self.travelled.as_mut().filter(|_| sink.stops().is_none()) else { return failure };
        let (q, _) = self.problem.split(&self.y);
        let ahead = part * (self.span.end - self.span.start);
        travelled.travel.end_within(self.t, q, ahead, self.span.end).map_or(failure, ended)
    }
}

fn ended(end: TravelEnd) -> Failure {
    Failure { t: end.t, reason: end.reason, hint: HINT.to_string() }
}
