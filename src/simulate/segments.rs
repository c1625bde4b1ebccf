//! A simulation in segments that end at given times, between which the state may be changed.

use super::{RunParts, Sink, Span, TimeLoop};
use crate::error::Failure;
use crate::integrator::Tolerance;

/// A run of the time loop, one segment at a time, without output rows.
pub(crate) struct Segments<'a> {
    run: TimeLoop<'a>,
    is_begun: bool,
}

impl<'a> Segments<'a> {
    /// Starts from the flat state `y` at `start`; `end` is the last time.
    pub fn new(parts: RunParts<'a>, tolerance: Tolerance, start: f64, end: f64, y: Vec<f64>) -> Self {
        let span = Span { start, end, output_step: f64::INFINITY };
        Segments { run: TimeLoop::of(parts, tolerance, None, span, y), is_begun: false }
    }

    /// Continues to `end`.
    pub fn advance(&mut self, end: f64, sink: &mut dyn Sink) -> Result<(), Failure> {
        self.run.span.end = end;
        self.run.until = end;
        if !self.is_begun {
            self.is_begun = true;
            self.run.begin(sink)?;
            // The only row of the span, its end, counts as written.
            self.run.rows.next = 2;
        }
        self.run.meet_change()?;
        self.run.advance(sink)?;
        self.run.complete(sink)
    }

    /// The flat state.
    pub fn state(&self) -> &[f64] {
        &self.run.y
    }

    /// Changes the state from which the next segment starts.
    pub fn change(&mut self, change: impl FnOnce(&mut [f64])) -> Result<(), Failure> {
        let run = &mut self.run;
        change(&mut run.y);
        run.problem.derivative(run.t, &run.y, &mut run.slope).map_err(|halt| run.halted(&halt))
    }
}
