//! Output rows within a step.

use super::rows::{OutputRows, project};
use super::{LastStep, Sink, TimeLoop};
use crate::error::Failure;
use crate::formulation::StepError;
use crate::integrator::{Step, StepStart};
use crate::tolerances;

/// Sweeps of the projection of a row between steps near a singular state. Unit: `[sweeps]`. Why: a row may lie far
/// nearer to it than the ends of steps, and each sweep squares the error of the positions over the rank indicator; four
/// take 1e-3 to round-off at an indicator of 5e-3. Test: `rows_beside_the_folds_are_as_right_as_others`.
const SINGULAR_ROW_SWEEPS: usize = 4;

/// v' of the dense output is a difference over this. Unit: `[1]` of the step. Test: `rows_do_not_change_the_steps`.
const DIFFERENCE_OF_ROWS: f64 = 1e-3;

/// The v' of a row contradicts the dense output where the difference over the step is more than so many tolerated
/// errors of v, and CONTRADICTED_PART. Unit: `[tolerated errors]`.
const CONTRADICTED_ERRORS: f64 = 100.0;

/// The v' of a row contradicts the dense output where the difference is also more than this part of all accelerations
/// at hand. Unit: `[1]`. Test: `rows_do_not_change_the_steps`.
const CONTRADICTED_PART: f64 = 0.2;

/// The output rows of a step.
pub enum RowsOfStep {
    Written,
    /// The sink has what it wants.
    Stopped,
    /// A row at this fraction of the step contradicts it: something acts there that its stages did not evaluate.
    Contradicted(f64),
}

impl TimeLoop<'_> {
    /// Writes the output rows within the step from `t` to `t + h`. A step may have millions of rows: where the sink
    /// stops the run among them, the step is left, and taken again by a run that goes on from its start.
    pub fn output(&mut self, h: f64, end: Option<f64>, sink: &mut dyn Sink) -> Result<RowsOfStep, Failure> {
        let end = self.end_of(h, end);
        let slack = tolerances::SAME * h;
        let first = self.rows.next;
        let mut prepared = false;
        loop {
            let t = self.span.row(self.rows.next);
            if t > end + slack || self.rows.next > 0 && self.span.row(self.rows.next - 1) >= self.span.end {
                return Ok(RowsOfStep::Written);
            }
            if self.rows.next > first && self.ask(sink)? {
                return Ok(RowsOfStep::Stopped);
            }
            if t > end - slack {
                self.rows.y.copy_from_slice(&self.next);
                self.rows.emit(t, sink).map_err(|halt| self.halted(&halt))?;
            } else {
                if !std::mem::replace(&mut prepared, true) {
                    self.prepare(h, end).map_err(|halt| self.halted(&halt))?;
                }
                if let Some(theta) = self.row_within(t, h, end).map_err(|halt| self.halted(&halt))? {
                    return Ok(RowsOfStep::Contradicted(theta));
                }
                self.rows.show(t, sink);
            }
            self.rows.next += 1;
        }
    }

    fn prepare(&mut self, h: f64, end: f64) -> Result<(), StepError> {
        let from = StepStart { t: self.t, y: &self.y, slope: &self.slope, h, end, tolerance: &self.tolerance };
        let step = Step { from, to: &self.next, slope: &self.next_slope };
        self.rows.problem.begin_step(self.t, &self.y)?;
        self.integrator.prepare(&mut self.rows.problem, step)
    }

    /// Evaluates the row at `t`. Returns its fraction of the step if it contradicts the step, or is too far off the
    /// constraints to be projected.
    fn row_within(&mut self, t: f64, h: f64, end: f64) -> Result<Option<f64>, StepError> {
        let theta = (t - self.t) / h;
        let rows = &mut self.rows;
        let from = StepStart { t: self.t, y: &self.y, slope: &self.slope, h, end, tolerance: &self.tolerance };
        let step = Step { from, to: &self.next, slope: &self.next_slope };
        rows.problem.begin_step(self.t, &self.y)?;
        self.integrator.interpolate(&mut rows.problem, step, theta, &mut rows.y)?;
        let is_checked = self.is_explicit && self.fixed.is_none() && !self.approach.reaches(h);
        if is_checked {
            let apart = if theta + DIFFERENCE_OF_ROWS < 1.0 { DIFFERENCE_OF_ROWS } else { -DIFFERENCE_OF_ROWS };
            self.integrator.interpolate(&mut rows.problem, step, theta + apart, &mut rows.ahead)?;
            rows.differentiate(h * apart);
        }
        match self.project_row(t, h) {
            Err(halt) if self.fixed.is_none() && !halt.is_fatal() => return Ok(Some(theta)),
            projected => projected?,
        }
        self.rows.evaluate(t)?;
        Ok((is_checked && self.row_contradicts(h)).then_some(theta))
    }

    /// Writes the state at a time within the last step to the row, projected.
    pub fn interpolate(&mut self, t: f64, last: LastStep) -> Result<(), StepError> {
        let LastStep { start, size, .. } = last;
        let from = StepStart {
            t: start,
            y: &self.next,
            slope: &self.next_slope,
            h: size,
            end: self.t,
            tolerance: &self.tolerance,
        };
        let step = Step { from, to: &self.y, slope: &self.slope };
        let rows = &mut self.rows;
        rows.problem.begin_step(start, &self.next)?;
        self.integrator.prepare(&mut rows.problem, step)?;
        self.integrator.interpolate(&mut rows.problem, step, (t - start) / size, &mut rows.y)?;
        self.project_row(t, size)
    }

    /// Projects the row, near a singular state with more sweeps than a step that ends there would take.
    fn project_row(&mut self, t: f64, h: f64) -> Result<(), StepError> {
        let (sweeps, OutputRows { y, problem, projection, .. }) = (self.sweeps(h), &mut self.rows);
        project(t, y, problem, projection, sweeps)?;
        let is_near = || {
            projection.is_some()
                && problem.dynamics.kkt.rank_indicator() < tolerances::PLACED_STEPS * self.approach.largest
        };
        if is_near() { project(t, y, problem, projection, SINGULAR_ROW_SWEEPS - sweeps) } else { Ok(()) }
    }

    /// True if v' of the row differs from that of the dense output. This is not tested for implicit methods, in whose
    /// long steps a small error of q is a large one in v' of a stiff mechanism, nor near singular states, where v' is
    /// less exact.
    fn row_contradicts(&self, h: f64) -> bool {
        let v = |y| self.problem.split(y).1.iter();
        let row = v(&self.rows.slope);
        let ends = v(&self.slope).zip(v(&self.next_slope));
        let size = v(&self.y).zip(v(&self.next));
        row.zip(&self.rows.vdot).zip(ends).zip(size).any(|(((row, dense), (a, b)), (v0, v1))| {
            let off = (row - dense).abs();
            let all = row.abs() + dense.abs() + a.abs() + b.abs();
            off > CONTRADICTED_PART * all && h * off > CONTRADICTED_ERRORS * self.tolerance.weight(*v0, *v1)
        })
    }
}
