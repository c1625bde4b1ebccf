//! Comparison of methods on the same part of a motion.
//!
//! A spectrum does not predict the cost of a method: a mesh has modes of all speeds, some not excited, and rotating
//! directions can limit implicit steps as much as stability limits explicit ones. A trial decides: the method that
//! simulates more time for the same work. The spectrum only decides when to try: where the fastest mode of the state is
//! related to the size of the steps.

use super::spectrum::{SpectralMode, fastest};
use super::{Method, Run, Sink, Span, Stop};
use crate::error::{Failure, Result};
use crate::formulation::{Dynamics, Statistics};
use crate::system::{MechanicalSystem, OperatingPoint};
use crate::tolerances::simulate as tolerances;

/// Time reached by a run, s, its work in evaluations, the part of it for output rows, and the number of steps.
#[derive(Clone, Copy, Debug)]
pub struct Mark {
    pub t: f64,
    pub work: f64,
    pub rows: f64,
    pub steps: u64,
}

impl Mark {
    /// Time simulated since another mark per unit of work.
    fn pace(&self, since: Mark) -> f64 {
        (self.t - since.t) / (self.work - since.work).max(1.0)
    }
}

/// What decides whether others try.
#[derive(Clone, Copy, Debug)]
pub struct View {
    /// The fastest mode of the state, 1/s.
    pub mode: SpectralMode,
    /// Mean step, s.
    pub step: f64,
    /// True if steps are of a length at which both kinds of methods may be the better one: those of an explicit method
    /// so long that stability may limit them, those of an implicit one no longer than many stable ones.
    pub is_between: bool,
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
}

impl Run<'_> {
    /// A run by another method at the present state, which is to [go on](Run::go_on) from there.
    pub fn rival<'a>(&self, method: &'a Method, system: &'a dyn MechanicalSystem, span: Span) -> Result<Run<'a>> {
        let mut rival = Run::new(system, method, span, self.y.clone())?;
        (rival.t, rival.rows.next) = (self.t, self.rows.next);
        Ok(rival)
    }

    /// Comes from its start to the time of another run, whose rows it does not repeat; false if it does not, or not for
    /// the same work.
    pub fn comes_to(&mut self, other: &Run, sink: &mut dyn Sink) -> bool {
        let end = std::mem::replace(&mut self.span.end, other.t);
        (self.rows.next, self.allowance) = (u64::MAX, self.mark().work + other.mark().work);
        let came = self.advance(sink).is_ok() && self.t >= other.t;
        (self.span.end, self.rows.next) = (end, other.rows.next);
        came && self.meet_change().is_ok()
    }

    /// Work of an evaluation.
    fn price(&self) -> f64 {
        if self.is_explicit { 1.0 } else { tolerances::IMPLICIT_WORK }
    }

    pub fn mark(&self) -> Mark {
        let Statistics { steps, rhs_evaluations, rows, .. } = self.statistics();
        let own = self.price() * rhs_evaluations as f64;
        let rows = self.price() * rows.rhs_evaluations as f64;
        Mark { t: self.t, work: own + rows, rows, steps }
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
        for _ in 0..=tolerances::WATCHED_AGAIN {
            let start = self.mark();
            for part in [0.5, 1.0] {
                self.allowance = start.work + part * work;
                if let Err(failure) = self.advance(sink) {
                    return (mark, Some(failure));
                }
                if part < 1.0 && self.t < self.span.end {
                    mark = self.mark();
                }
            }
            let growth = self.h / self.step_since(mark);
            let has_grown = growth < tolerances::STEPS_GROW;
            if self.t >= self.span.end || has_grown || self.mark().work + work > most || is_enough(self, mark, growth) {
                break;
            }
        }
        (mark, None)
    }

    /// True if the work so far is a good part of the estimated total at the pace since `mark`.
    pub fn has_shown_itself(&self, mark: Mark) -> bool {
        self.mark().work > tolerances::TRIAL_SHOWS * self.left(mark)
    }

    /// Work of the steps to the end at the pace since `mark`, without that of output rows, which any method has.
    fn left(&self, mark: Mark) -> f64 {
        let now = self.mark();
        (self.span.end - now.t) * (now.work - now.rows - mark.work + mark.rows) / (now.t - mark.t)
    }

    /// Mean step since `mark`, s.
    fn step_since(&self, mark: Mark) -> f64 {
        (self.t - mark.t) / (self.mark().steps - mark.steps).max(1) as f64
    }

    /// True if enough work remains for the trials of so many methods.
    pub fn leaves_trials(&self, mark: Mark, rivals: usize) -> bool {
        tolerances::TRIAL_SHARE * self.left(mark) >= rivals as f64 * tolerances::TRIAL_WORK
    }

    /// The fastest mode of the state and the mean step since `mark`.
    pub fn view(&self, mark: Mark) -> Option<View> {
        let step = self.step_since(mark);
        let (system, (q, v)) = (self.problem.dynamics.system, self.problem.split(&self.y));
        let mut dynamics = Dynamics::new(system);
        dynamics.solve(self.t, q, v, |_, _| 0.0).ok()?;
        let mode = fastest(system, OperatingPoint { t: self.t, q, v, vdot: &dynamics.vdot, lambda: &dynamics.lambda })?;
        let stability = self.entry.stability.map(|stability| stability());
        let limit =
            stability.as_ref().map_or(tolerances::STABLE_STEP, |stability| stability.limit(mode.decay, mode.swing));
        let part = step * mode.rate() / limit;
        let is_between =
            if self.is_explicit { part > tolerances::STABILITY_HOLDS } else { part < tolerances::EXPLICIT_AGAIN };
        Some(View { mode, step, is_between })
    }

    /// True if output rows alone would cost the method of `rival` more than it could save.
    fn rows_decide(&self, mark: Mark, rival: &Run) -> bool {
        let row = if rival.entry.rows_are_steps { tolerances::IMPLICIT_ROW } else { 1.0 };
        self.is_explicit && self.span.output_step < tolerances::WORTH * row * rival.price() * self.mark().pace(mark)
    }

    /// Time simulated since `mark` per unit of work, with steps that are `growth` times as long and with the work of
    /// output rows that were not made: about an evaluation each where they are no steps of their own.
    fn pace_with_rows(&self, mark: Mark, growth: f64, output_step: f64) -> f64 {
        let now = self.mark();
        let time = growth * (now.t - mark.t);
        let work = now.work - mark.work;
        let row = if self.entry.rows_are_steps { work / (now.steps - mark.steps).max(1) as f64 } else { self.price() };
        time / (work + time / output_step * row).max(1.0)
    }

    /// Lets `other` try from the state of this run, whose pace since `mark` is known. Its output rows are not made, but
    /// estimated. While its steps grow it goes on, up to all work so far, unless it is hopelessly behind the pace of
    /// this run times `least`. `rivals` share the work of trials. Returns the result and the work of the trial; `None`
    /// where its output rows leave nothing to try.
    pub fn contest(
        &self,
        mark: Mark,
        View { mode, step, .. }: View,
        (rivals, least): (usize, f64),
        other: &Method,
        system: &dyn MechanicalSystem,
    ) -> Result<Option<(Contest, Statistics)>> {
        let own = self.mark();
        let share = |work: f64| tolerances::TRIAL_SHARE * work;
        let budget = tolerances::TRIAL_WORK.max(share(own.work - mark.work) / rivals as f64);
        let most = share(self.left(mark)).min(own.work);
        let mut rival = self.rival(other, system, unseen(self.span))?;
        if self.rows_decide(mark, &rival) {
            return Ok(None);
        }
        let failure = rival.go_on(&self.problem.dynamics.dropped, self.h).err();
        let pace = |rival: &Run, since, growth| rival.pace_with_rows(since, growth, self.span.output_step);
        let is_hopeless = |rival: &Run, since: Mark, growth: f64| {
            pace(rival, since, growth) < tolerances::NO_ALTERNATIVE * least * own.pace(mark)
        };
        let (since, stopped) = match failure {
            None => rival.window(budget, most, &mut Quiet(None), is_hopeless),
            failure => (rival.mark(), failure),
        };
        // Steps of a multistep method, which begins with short ones, go on growing.
        let growing =
            |run: &Run, mark| if run.entry.begins_anew { (run.h / run.step_since(mark)).max(1.0) } else { 1.0 };
        let theirs = if stopped.is_some() { 0.0 } else { pace(&rival, since, growing(&rival, since)) };
        let ours = growing(self, mark) * own.pace(mark);
        let contest = Contest { t: self.t, mode, step, gain: theirs / ours };
        Ok(Some((contest, rival.statistics())))
    }
}
