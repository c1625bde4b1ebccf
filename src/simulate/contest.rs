//! Comparison of methods on the same part of a motion.
//!
//! A spectrum does not predict the cost of a method: a mesh has modes of all speeds, some not excited, and rotating
//! directions can limit implicit steps as much as stability limits explicit ones. A trial decides: the method that
//! simulates more time for the same work. The spectrum only decides when to try: where the fastest mode of the state is
//! related to the size of the steps.

use super::spectrum::fastest;
use super::{Method, Sink, Span, Stop, TimeLoop};
use crate::error::{Failure, Result};
use crate::formulation::{Dynamics, Statistics};
use crate::modes::SpectralMode;
use crate::system::{MechanicalSystem, OperatingPoint};
use crate::tolerances;

/// Work of an evaluation in implicit methods, with its share of factorizations and back-substitutions. Unit:
/// `[evaluations by explicit ones]`. Why: 2 to 4 on the shipped scenes, whatever their size.
const IMPLICIT_WORK: f64 = 3.0;

/// Steps of an explicit method that are longer may be limited by stability. Unit: `[1]` of the longest stable step.
/// Why: with the steps that it refuses again and again they are a quarter of it on average.
const STABILITY_HOLDS: f64 = 0.1;

/// Least work of a trial. Unit: `[evaluations]`. Why: the first steps of radau_iia, each up to five times the one
/// before.
const TRIAL_WORK: f64 = 300.0;

/// Work of a trial, and what it is worth of what is left. Unit: `[1]` of the work it is compared with.
const TRIAL_SHARE: f64 = 0.25;

/// Time reached by a run, s, the work of its steps in evaluations, and their number. Output rows do not count, so that
/// the choice of a method does not depend on them.
#[derive(Clone, Copy, Debug)]
pub struct Mark {
    t: f64,
    pub work: f64,
    steps: u64,
}

impl Mark {
    /// Time simulated since another mark per unit of work.
    fn pace(&self, since: Mark) -> f64 {
        (self.t - since.t) / (self.work - since.work).max(1.0)
    }
}

/// Result of a trial.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Contest {
    /// Its start, s.
    pub t: f64,
    /// The fastest mode there, 1/s.
    pub mode: SpectralMode,
    /// Mean step of the present method, s.
    pub step: f64,
    /// Time simulated by the other method over that of the present one, for the same work.
    pub gain: f64,
}

/// The span without output rows.
pub fn unseen(span: Span) -> Span {
    Span { output_step: f64::INFINITY, ..span }
}

/// Ignores all states; stops where a sink does that is given.
pub struct Quiet<'s>(pub Option<&'s dyn Sink>);

impl Sink for Quiet<'_> {
    fn stops(&self) -> Option<Stop> {
        self.0.and_then(Sink::stops)
    }

    fn is_done(&self) -> bool {
        self.0.is_some_and(Sink::is_done)
    }
}

impl TimeLoop<'_> {
    /// A run by another method at the present state, which is to [go on](TimeLoop::go_on) from there.
    pub fn rival<'a>(&self, method: &Method, system: &'a dyn MechanicalSystem, span: Span) -> Result<TimeLoop<'a>> {
        let mut rival = TimeLoop::new(system, method, span, self.y.clone())?;
        (rival.t, rival.rows.next) = (self.t, self.rows.next);
        Ok(rival)
    }

    /// Runs from its start to the time of another run, whose rows it does not repeat; false if it fails, or takes more
    /// work than that.
    pub fn reaches(&mut self, other: &TimeLoop, sink: &mut dyn Sink) -> bool {
        let until = std::mem::replace(&mut self.until, other.t);
        (self.rows.next, self.allowance) = (u64::MAX, self.mark().work + other.mark().work);
        let came = self.advance(sink).is_ok() && self.t >= other.t;
        (self.until, self.rows.next) = (until, other.rows.next);
        came && self.complete(sink).is_ok() && self.meet_change().is_ok()
    }

    pub fn mark(&self) -> Mark {
        let price = if self.is_explicit { 1.0 } else { IMPLICIT_WORK };
        let Statistics { steps, rhs_evaluations, .. } = self.statistics();
        Mark { t: self.t, work: price * rhs_evaluations as f64, steps }
    }

    /// Continues for this `work`, of which the first half is not measured, since the first steps may be small and grow.
    /// While they grow, it continues, up to `most` work, unless `is_enough`, which is called with the mark at which the
    /// measurement begins and the factor by which they grow. Returns that mark, and the failure of the run.
    pub fn window(
        &mut self,
        work: f64,
        most: f64,
        sink: &mut dyn Sink,
        is_enough: impl Fn(&Self, Mark, f64) -> bool,
    ) -> (Mark, Option<Failure>) {
        let mut mark = self.mark();
        let most = mark.work + most;
        // A run whose steps still grow is watched again.
        for _ in 0..=5 {
            let start = self.mark();
            for part in [0.5, 1.0] {
                self.allowance = start.work + part * work;
                if let Err(failure) = self.advance(sink) {
                    return (mark, Some(failure));
                }
                if part < 1.0 && !self.is_paused(sink) {
                    mark = self.mark();
                }
            }
            let growth = self.h / self.step_since(mark);
            let has_grown = growth < 2.0;
            if self.is_paused(sink) || has_grown || self.mark().work + work > most || is_enough(self, mark, growth) {
                break;
            }
        }
        (mark, None)
    }

    /// Work of the steps to the end at the pace since `mark`.
    pub fn left(&self, mark: Mark) -> f64 {
        let now = self.mark();
        (self.span.end - now.t) * (now.work - mark.work) / (now.t - mark.t)
    }

    /// Mean step since `mark`, s.
    fn step_since(&self, mark: Mark) -> f64 {
        (self.t - mark.t) / (self.mark().steps - mark.steps).max(1) as f64
    }

    /// The fastest mode of the state and the mean step since `mark`, if both kinds of methods may be the better one: if
    /// explicit steps are so long that stability may limit them, or implicit ones no longer than many stable ones.
    fn view(&self, mark: Mark) -> Option<(SpectralMode, f64)> {
        let step = self.step_since(mark);
        let (system, (q, v)) = (self.problem.dynamics.system, self.problem.split(&self.y));
        let mut dynamics = Dynamics::new(system);
        dynamics.solve(self.t, q, v, |_, _| 0.0).ok()?;
        let mode = fastest(system, OperatingPoint { t: self.t, q, v, vdot: &dynamics.vdot, lambda: &dynamics.lambda })?;
        let stability = self.entry.stability.map(|stability| stability());
        // That of dop853, for methods without a limit of their own.
        let limit = stability.as_ref().map_or(6.1, |stability| stability.limit(mode.decay, mode.swing));
        let part = step * mode.rate() / limit;
        let is_between = if self.is_explicit { part > STABILITY_HOLDS } else { part < 20.0 };
        is_between.then_some((mode, step))
    }

    /// The factor by which the steps of a multistep method, which begins with short ones, go on growing.
    fn growth(&self, mark: Mark) -> f64 {
        if self.entry.begins_anew { (self.h / self.step_since(mark)).max(1.0) } else { 1.0 }
    }

    /// Lets `other` try from the state of this run, whose pace since `mark` is known. While its steps grow it goes on,
    /// up to all work so far, unless it is hopelessly behind. Returns the result and the work of the trial; `None` where
    /// too little work remains for one, or the steps tell that it is of no use.
    pub fn contest(
        &self,
        mark: Mark,
        other: &Method,
        system: &dyn MechanicalSystem,
    ) -> Result<Option<(Contest, Statistics)>> {
        let left = TRIAL_SHARE * self.left(mark);
        if left.is_nan() || left < TRIAL_WORK {
            return Ok(None);
        }
        let Some((mode, step)) = self.view(mark) else { return Ok(None) };
        let own = self.mark();
        let budget = TRIAL_WORK.max(TRIAL_SHARE * (own.work - mark.work));
        let mut rival = self.rival(other, system, unseen(self.span))?;
        let is_hopeless = |rival: &TimeLoop, since: Mark, growth: f64| {
            growth * rival.mark().pace(since) < tolerances::NO_ALTERNATIVE * own.pace(mark)
        };
        let (since, failure) = match rival.go_on(&self.problem.dynamics.dropped, self.h) {
            Ok(()) => rival.window(budget, left.min(own.work), &mut Quiet(None), is_hopeless),
            Err(failure) => (rival.mark(), Some(failure)),
        };
        let theirs = if failure.is_some() { 0.0 } else { rival.growth(since) * rival.mark().pace(since) };
        let ours = self.growth(mark) * own.pace(mark);
        Ok(Some((Contest { t: self.t, mode, step, gain: theirs / ours }, rival.statistics())))
    }
}
