//! The steps of a run, one after the other: attempt, thresholds and roots, output rows, acceptance.

use super::events::Passage;
use super::output::RowsOfStep;
use super::step::is_too_large;
use super::{LastStep, Sink, Stop, TimeLoop};
use crate::error::Failure;
use crate::integrator::Accepted;

/// What became of a step.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Attempt {
    Accepted,
    /// It is to be tried again, shorter or on other pieces.
    Refused,
    /// The sink has what it wants: the step is not taken.
    Stopped,
}

impl TimeLoop<'_> {
    /// Steps until it [pauses](Self::is_paused), or until the work exceeds the allowance. The last step before a pause is
    /// not completed, so that its dense output may be read.
    pub fn advance(&mut self, sink: &mut dyn Sink) -> Result<(), Failure> {
        while !self.is_paused(sink) {
            if self.mark().work >= self.allowance {
                return self.complete(sink).map_err(|failure| self.explained(failure, sink));
            }
            self.advance_once(sink)?;
        }
        Ok(())
    }

    /// Tries one step.
    pub fn advance_once(&mut self, sink: &mut dyn Sink) -> Result<Attempt, Failure> {
        self.take_step(sink).map_err(|failure| self.explained(failure, sink))
    }

    fn take_step(&mut self, sink: &mut dyn Sink) -> Result<Attempt, Failure> {
        self.complete(sink)?;
        if self.ask(sink)? {
            return Ok(Attempt::Stopped);
        }
        self.check_progress()?;
        self.check_crawl()?;
        let stop = self.next_stop();
        if self.entry.leads {
            self.lead(stop)?;
        }
        let (mut size, mut end) = self.fit(stop);
        let tried = size;
        let Some(error) = self.try_step(size, end)? else { return Ok(Attempt::Refused) };
        if !self.is_of_one_form(&mut size, &mut end, sink)? {
            return Ok(Attempt::Refused);
        }
        self.check_travel(self.end_of(size, end))?;
        match self.output(size, end, sink)? {
            RowsOfStep::Written => {}
            RowsOfStep::Stopped => return Ok(Attempt::Stopped),
            RowsOfStep::Contradicted(theta) => {
                self.problem.dynamics.statistics.rejected += 1;
                self.cut = Some(theta * size);
                return Ok(Attempt::Refused);
            }
        }
        let start = self.t;
        self.accept(size, end, sink);
        self.check_joints()?;
        let is_cut = end.is_some() || self.cut.is_some() || size < tried;
        let changes_form = self.end_gaps() || self.events.is_at_threshold() || stop.changes_form && self.t >= stop.t;
        self.last = Some(LastStep { start, size, error, is_cut, changes_form });
        Ok(Attempt::Accepted)
    }

    /// Completes the last step: the method proposes the size of the next one, and the equations take their new form
    /// where it ended at a threshold.
    pub fn complete(&mut self, sink: &mut dyn Sink) -> Result<(), Failure> {
        let Some(LastStep { size, error, is_cut, changes_form, .. }) = self.last.take() else { return Ok(()) };
        self.propose(size, error, is_cut)?;
        (self.growing, self.cut) = (true, None);
        if changes_form && self.t < self.span.end {
            return self.change_form_seen(None, sink);
        }
        self.events.go_on();
        Ok(())
    }

    /// Tries a step. Returns its error in units of the tolerance, if there is an estimate; `None` if the step was
    /// refused.
    fn try_step(&mut self, size: f64, end: Option<f64>) -> Result<Option<Option<f64>>, Failure> {
        let tried = self.step(size, end);
        if tried.is_ok() && self.holds_line() {
            self.problem.dynamics.statistics.rejected += 1;
            return Ok(None);
        }
        self.h = match tried {
            Ok(error) if !error.is_some_and(is_too_large) => return Ok(Some(error)),
            Ok(error) => self.retry(size, error, self.refusal, None)?,
            Err(halt) if halt.is_fatal() => return Err(self.halted(&halt)),
            Err(halt) => self.retry(size, None, &halt.to_string(), halt.hint())?,
        };
        (self.growing, self.cut) = (false, None);
        Ok(None)
    }

    /// True if the step just tried passed no threshold; else it prepares the next attempt.
    fn is_of_one_form(&mut self, size: &mut f64, end: &mut Option<f64>, sink: &mut dyn Sink) -> Result<bool, Failure> {
        if let Some(theta) = self.gap_closes(*size, self.end_of(*size, *end)).map_err(|halt| self.halted(&halt))? {
            self.problem.dynamics.statistics.rejected += 1;
            self.cut = Some(theta * *size);
            return Ok(false);
        }
        let passage = self.end_at_passage(size, end, sink).map_err(|halt| self.halted(&halt))?;
        match passage {
            None => return Ok(true),
            Some(Passage::AtStart(number)) => {
                self.change_form_seen(Some(number), sink)?;
                // A step after which the function is on neither side is longer than the time to the threshold.
                if self.fixed.is_none() && 0.1 * self.h > 2.0 * self.smallest() && self.events.is_undecided(number) {
                    self.h *= 0.1;
                }
            }
            Some(Passage::OfRoot) => self.roots.passed = Some(self.t),
            Some(Passage::Within(theta)) => {
                self.problem.dynamics.statistics.rejected += 1;
                self.cut = Some(theta * *size);
            }
        }
        Ok(false)
    }

    /// Tells the method that its step is accepted, and takes the size of the next one. A step that was cut to end at a
    /// given time does not reduce the size before it.
    fn propose(&mut self, size: f64, error: Option<f64>, is_cut: bool) -> Result<(), Failure> {
        let TimeLoop { growing, is_moved, .. } = *self;
        let step = Accepted { h: size, error, growing, is_moved, tolerance: &self.tolerance };
        let proposed = self.integrator.accepted(&step);
        if error.is_none() {
            return Ok(());
        }
        self.h = if is_cut { self.h.max(proposed) } else { proposed };
        if self.t < self.span.end && self.h < self.smallest() {
            Err(self.too_small(format!("steps have fallen to {:.1e} s", self.h), None))
        } else {
            Ok(())
        }
    }

    /// True if the sink has what it wants; a failure where it gives the run up.
    pub fn ask(&self, sink: &dyn Sink) -> Result<bool, Failure> {
        match sink.stops() {
            None => Ok(sink.is_done()),
            Some(Stop { reason, hint }) => Err(Failure { t: self.t, reason, hint }),
        }
    }

    /// True if nothing is left to do in this call.
    pub fn is_paused(&self, sink: &dyn Sink) -> bool {
        // No step is as short as the rounding of a time.
        let left = self.until - self.t;
        left <= 4.0 * f64::EPSILON * self.until.abs() || self.roots.passed.is_some() || sink.is_done()
    }

    fn accept(&mut self, h: f64, end: Option<f64>, sink: &mut dyn Sink) {
        self.t = self.end_of(h, end);
        std::mem::swap(&mut self.y, &mut self.next);
        std::mem::swap(&mut self.slope, &mut self.next_slope);
        self.problem.dynamics.statistics.steps += 1;
        if let Some(lost) = self.lost.take() {
            self.approach.add_loss(lost);
        }
        self.roots.accept(self.t);
        self.observe(self.fixed.or(Some(h)), sink);
    }
}
