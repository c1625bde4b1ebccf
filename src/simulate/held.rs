//! What a run that pauses shows and takes: its states, a later end, inputs.

use super::{Observation, Sink, TimeLoop};
use crate::error::Failure;
use crate::formulation::{Law, StepError};
use std::sync::Arc;

impl TimeLoop<'_> {
    /// Takes one accepted step, unless the run pauses before.
    pub fn step_once(&mut self, sink: &mut dyn Sink) -> Result<(), Failure> {
        let steps = self.problem.dynamics.statistics.steps;
        while !self.is_paused(sink) && self.problem.dynamics.statistics.steps == steps {
            self.advance_once(sink)?;
        }
        Ok(())
    }

    /// Moves the end of the span to a later time.
    pub fn extend(&mut self, end: f64) {
        let old = std::mem::replace(&mut self.span.end, end);
        self.events.timetable.extend(self.t, old, end, &self.events.pieces);
        self.rows.next = self.next_row();
    }

    /// Shows the present state as a row, unless that was shown.
    pub fn show_row(&mut self, sink: &mut dyn Sink) {
        self.last_good_row(sink);
    }

    /// Calls `see` with the present state; terms that cannot be evaluated are an error.
    pub fn see_state(&mut self, see: &mut dyn FnMut(&Observation)) -> Result<(), StepError> {
        self.rows.y.copy_from_slice(&self.y);
        self.rows.see(self.t, see)
    }

    /// Calls `see` with the state at a time within the last step, by the dense output; false where that is not known.
    pub fn see_within(&mut self, t: f64, see: &mut dyn FnMut(&Observation)) -> Result<bool, StepError> {
        let Some(last) = self.last.filter(|last| (last.start..=self.t).contains(&t)) else { return Ok(false) };
        self.interpolate(t, last)?;
        self.rows.see(t, see)?;
        Ok(true)
    }

    /// Forgets on which side of a root the run is.
    pub fn forget_root(&mut self) {
        self.roots = Default::default();
    }

    /// Values of the inputs; empty where they are zero.
    pub fn inputs(&self) -> &[f64] {
        &self.problem.dynamics.scratch.inputs
    }

    /// Gives the inputs these values in all evaluations.
    pub fn set_inputs(&mut self, u: &[f64], law: Option<&Arc<Law>>) {
        self.events.set_inputs(u);
        for dynamics in [&mut self.problem.dynamics, &mut self.rows.problem.dynamics] {
            dynamics.scratch.inputs = u.to_vec();
            dynamics.law = law.cloned();
        }
    }

    /// Gives the inputs other values from the present state on: y' jumps there.
    pub fn hold(&mut self, u: &[f64], sink: &mut dyn Sink) -> Result<(), Failure> {
        self.complete(sink)?;
        if self.problem.dynamics.scratch.inputs == u {
            return Ok(());
        }
        let before = self.slope.clone();
        let law = self.problem.dynamics.law.clone();
        self.set_inputs(u, law.as_ref());
        self.evaluate_start()?;
        self.meet_jump(&before)
    }
}
