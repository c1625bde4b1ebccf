//! Choice of the step to try: the proposed one, adjusted near singular states, and cut where it must end or would miss
//! a function of time.

use super::TimeLoop;
use super::events::Events;
use crate::error::Failure;
use crate::formulation::StepError;
use crate::integrator::{Control, StepStart, first_step};
use crate::tolerances;

/// The parts of a fixed step that misses what acts by the clock. Unit: `[1]` of steps on which that is almost cubic.
/// Why: a pulse of a tenth of the step is met to 1e-7 by rk4.
const FINER_PARTS: f64 = 0.125;

/// The part of what is resolved that one cubic shows. Unit: `[1]`. Why: the quarters between which a function is looked
/// at.
const SHOWN_BY_CUBIC: f64 = 0.25;

/// A time at which a step must end.
#[derive(Clone, Copy)]
pub struct NextStop {
    pub t: f64,
    /// True if a function of time changes its form there.
    pub changes_form: bool,
}

impl TimeLoop<'_> {
    pub fn first_step(&mut self) -> Result<f64, StepError> {
        match self.fixed {
            Some(step) => Ok(step),
            // The control increases it, or reports why it cannot.
            None => Ok(self.estimated_step()?.max(2.0 * self.smallest())),
        }
    }

    /// The step from the present state whose error is estimated to be a hundredth of the tolerance.
    pub fn estimated_step(&mut self) -> Result<f64, StepError> {
        let span = self.span.end - self.t;
        let order = self.integrator.control().order;
        let lambda = self.problem.dynamics.lambda.clone();
        let step = first_step(&mut self.problem, &self.tolerance, self.t, span, &self.y, &self.slope, order);
        // `first_step` evaluates ahead; lambda is that of the start.
        self.problem.dynamics.lambda = lambda;
        step
    }

    /// The step of size `h`, unless a singular state suggests another.
    fn place(&mut self, h: f64) -> f64 {
        let Control { gap, order, .. } = *self.integrator.control();
        match (self.fixed, gap) {
            (None, gap) => self.approach.place(h, gap.unwrap_or(0.5)),
            (Some(_), None) => self.to_grid(h),
            (Some(_), Some(gap)) => {
                let left = self.to_grid(h);
                self.approach.place_fixed(h, left, self.span.end - self.t, gap, order)
            }
        }
    }

    /// The next time at which a step must end: a change of form, or where the run pauses or ends.
    pub fn next_stop(&self) -> NextStop {
        match self.events.timetable.next_change() {
            Some(t) if t < self.span.end && t <= self.until => NextStop { t, changes_form: true },
            _ => NextStop { t: self.until, changes_form: false },
        }
    }

    /// Takes the next step from a method that chooses it itself, unless a smaller one is to be tried.
    pub fn lead(&mut self, stop: NextStop) -> Result<(), Failure> {
        let limit = self.events.resolved(self.t, self.h.min(stop.t - self.t), stop.t);
        let TimeLoop { h, tolerance, .. } = self;
        let from = StepStart { t: self.t, y: &self.y, slope: &self.slope, h: *h, end: self.t + limit, tolerance };
        let size = match self.integrator.lead(&mut self.problem, from) {
            Ok(size) => size,
            Err(halt) if halt.is_fatal() => return Err(self.halted(&halt)),
            Err(halt) => return Err(self.too_small(format!("{halt}, however small the step"), halt.hint())),
        };
        self.h = if self.growing { size } else { size.min(self.h) };
        Ok(())
    }

    /// The step to try, adjusted and stretched or cut so that it meets the stop, or a point of the grid of fixed steps,
    /// and resolves all functions of time; and the time at which it ends, if that is given.
    pub fn fit(&mut self, stop: NextStop) -> (f64, Option<f64>) {
        if let Some(size) = self.cut {
            return (size, None);
        }
        let left = stop.t - self.t;
        if self.entry.leads {
            return if self.h >= left { (left, Some(stop.t)) } else { (self.h, None) };
        }
        let placed = self.place(self.h);
        // A fixed step meets the grid up to the rounding of the step and of the time.
        let stretched = match self.fixed {
            Some(_) => placed * (1.0 + 1e-9) + 4.0 * f64::EPSILON * stop.t.abs(),
            None => 1.01 * placed,
        };
        let (size, end) = match self.fixed {
            _ if stretched >= left => (left, Some(stop.t)),
            Some(step) => {
                let next = self.next_of_grid(step);
                (placed, (placed == self.step_to(next, step)).then_some(next))
            }
            None => (placed, None),
        };
        let resolved = self.resolved(size, stop.t);
        let adapts = self.fixed.is_none() && !self.entry.begins_anew;
        if let Some(step) = self.events.ends_at_point(self.t, resolved).filter(|_| adapts) {
            self.cut = Some(step);
            return (step, None);
        }
        (resolved, end.filter(|_| resolved == size))
    }

    /// The step, at most `size`, that resolves all functions of time. A fixed step, whose error is not estimated, is
    /// divided into parts so small that the rest is negligible.
    fn resolved(&mut self, size: f64, stop: f64) -> f64 {
        let t = self.t;
        let Some(step) = self.fixed else { return self.events.resolved(t, size, stop) };
        let Events { timetable, pieces, .. } = &mut self.events;
        if t >= self.divided && timetable.resolved(t, size / SHOWN_BY_CUBIC, stop, pieces) >= size / SHOWN_BY_CUBIC {
            return size;
        }
        let parts = FINER_PARTS * timetable.finely_resolved(t, size / FINER_PARTS, pieces);
        self.divided = self.next_of_grid(step);
        parts.min(size)
    }

    /// End of a step of size `h`, unless it is the time `end`.
    pub fn end_of(&self, h: f64, end: Option<f64>) -> f64 {
        end.unwrap_or(self.t + h)
    }

    /// The next time start + k h. Times are counted, not added up, so that round-off does not accumulate.
    fn next_of_grid(&self, h: f64) -> f64 {
        let passed = ((self.t - self.span.start) / h + tolerances::UNSEEN).floor();
        self.span.start + (passed + 1.0) * h
    }

    /// Time to the next point of the grid of steps `h`: `h` itself from a point of the grid.
    fn to_grid(&self, h: f64) -> f64 {
        self.step_to(self.next_of_grid(h), h)
    }

    fn step_to(&self, next: f64, h: f64) -> f64 {
        let left = next - self.t;
        if (left - h).abs() < tolerances::SAME * h + 4.0 * f64::EPSILON * self.t.abs() { h } else { left }
    }
}
