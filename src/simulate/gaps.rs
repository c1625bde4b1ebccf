//! Forces along a line between two markers that jump where the markers meet, as that of a spring with a free length.
//!
//! A step in which the gap r between them reverses on one line is tried again with that line held: the gap counts as a
//! length with a sign, so that the force is smooth through zero. It ends where r = 0, and the next one begins with the
//! line of the other side. A gap that turns without closing is never held, since r before and after is not on one line.

use super::TimeLoop;
use crate::formulation::StepError;
use crate::integrator::{Step, StepStart};
use crate::math::{Piece, Side};
use crate::system::MechanicalSystem;
use crate::tolerances;

/// The gaps of a system at both ends of a step.
pub struct Gaps {
    /// Numbers of their pieces.
    numbers: Vec<usize>,
    start: Vec<[f64; 3]>,
    end: Vec<[f64; 3]>,
    within: Vec<[f64; 3]>,
    /// Number of cuts of the present step.
    cuts: usize,
    /// Index of the gap that is closed at the end of the step.
    closed: Option<usize>,
}

impl Gaps {
    pub fn new(system: &dyn MechanicalSystem) -> Self {
        let numbers = system.facts().gaps.clone();
        let zeros = vec![[0.0; 3]; numbers.len()];
        Gaps { start: zeros.clone(), end: zeros.clone(), within: zeros, numbers, cuts: 0, closed: None }
    }

    /// True if the gap reverses in the step, on one line.
    fn reverses(&self, i: usize) -> bool {
        let a = &self.start[i];
        let b = &self.end[i];
        let along = dot(a, b);
        let across = dot(a, a) * dot(b, b) - along * along;
        along < 0.0 && across <= (tolerances::HALF_OF_THE_DIGITS * along).powi(2)
    }
}

fn dot(a: &[f64; 3], b: &[f64; 3]) -> f64 {
    a.iter().zip(b).map(|(a, b)| a * b).sum()
}

impl TimeLoop<'_> {
    /// Reads the gaps at the present state.
    pub fn start_gaps(&mut self) {
        if !self.gaps.numbers.is_empty() {
            let system = self.problem.dynamics.system;
            system.write_gaps(self.problem.split(&self.y).0, &mut self.gaps.start);
        }
    }

    /// True if the step just tried closes a gap whose line is not held: it is held from now on.
    pub fn holds_line(&mut self) -> bool {
        let TimeLoop { gaps, problem, events, next, .. } = self;
        if gaps.numbers.is_empty() {
            return false;
        }
        problem.dynamics.system.write_gaps(problem.split(next).0, &mut gaps.end);
        let mut is_new = false;
        for i in 0..gaps.numbers.len() {
            let number = gaps.numbers[i];
            if events.pieces[number] == 0 && gaps.reverses(i) {
                events.pieces[number] = Side::of(&gaps.start[i]).piece();
                is_new = true;
            }
        }
        if is_new {
            self.take_pieces();
        }
        is_new
    }

    /// The pieces of the events for all evaluations from now on.
    fn take_pieces(&mut self) {
        self.share_pieces();
        if self.entry.leads {
            self.integrator.restart();
        }
    }

    /// The fraction of the step just tried at which a held gap closes; none where that is its end, or where none does.
    pub fn gap_closes(&mut self, h: f64, end: f64) -> Result<Option<f64>, StepError> {
        self.gaps.closed = None;
        for i in 0..self.gaps.numbers.len() {
            let number = self.gaps.numbers[i];
            let Some(side) = Side::of_piece(self.events.pieces[number]) else { continue };
            let start = side.component(&self.gaps.start[i]);
            let at_end = side.component(&self.gaps.end[i]);
            // The force that acts so much too long moves nothing beyond round-off.
            let reach = tolerances::ROUND_OFF_OF_PHI * self.problem.dynamics.system.facts().length;
            let is_closed_before = start <= reach;
            if at_end > reach || is_closed_before && at_end >= -reach {
                continue;
            }
            if at_end >= -reach || self.gaps.cuts >= tolerances::CUTS {
                self.gaps.closed = Some(i);
                return Ok(None);
            }
            self.gaps.cuts += 1;
            if is_closed_before {
                // It was closed before the other side was taken: the whole step is tried again on that.
                self.events.pieces[number] = side.opposite().piece();
                self.take_pieces();
                return Ok(Some(1.0));
            }
            return self.closing_time(i, side, h, end, [start, at_end]).map(Some);
        }
        Ok(None)
    }

    /// The fraction of the step at which gap `i`, of these values at both ends, is zero, by the regula falsi with halved weights (Illinois).
    fn closing_time(&mut self, i: usize, side: Side, h: f64, end: f64, values: [f64; 2]) -> Result<f64, StepError> {
        let [mut low_value, mut high_value] = values;
        let TimeLoop { gaps, rows, integrator, problem, .. } = self;
        let from = StepStart { t: self.t, y: &self.y, slope: &self.slope, h, end, tolerance: &self.tolerance };
        rows.problem.begin_step(from.t, from.y)?;
        let step = Step { from, to: &self.next, slope: &self.next_slope };
        integrator.prepare(&mut rows.problem, step)?;
        let mut low = 0.0;
        let mut high = 1.0;
        // It converges in ten.
        for _ in 0..40 {
            let theta = low + (high - low) * low_value / (low_value - high_value);
            integrator.interpolate(&mut rows.problem, step, theta, &mut rows.y)?;
            problem.dynamics.system.write_gaps(problem.split(&rows.y).0, &mut gaps.within);
            let value = side.component(&gaps.within[i]);
            if value > 0.0 {
                (low, low_value) = (theta, value);
                high_value *= 0.5;
            } else {
                (high, high_value) = (theta, value);
                low_value *= 0.5;
            }
            if value == 0.0 || high - low <= f64::EPSILON {
                break;
            }
        }
        Ok(high)
    }

    /// Takes over the gaps at the end of an accepted step. Returns true if one is closed there, whose line is held with
    /// the other sign from now on. A line is released where its gap is open.
    pub fn end_gaps(&mut self) -> bool {
        if self.gaps.numbers.is_empty() {
            return false;
        }
        let far = tolerances::UNSEEN * self.problem.dynamics.system.facts().length;
        let closed = self.gaps.closed.take();
        let mut is_released = false;
        for (i, &number) in self.gaps.numbers.iter().enumerate() {
            let Some(side) = Side::of_piece(self.events.pieces[number]) else { continue };
            let start = side.component(&self.gaps.start[i]);
            let end = side.component(&self.gaps.end[i]);
            let piece: Piece = match closed {
                Some(index) if index == i => side.opposite().piece(),
                _ if end > far && end > start => 0,
                _ => continue,
            };
            is_released |= piece == 0;
            self.events.pieces[number] = piece;
        }
        if is_released {
            self.take_pieces();
        }
        std::mem::swap(&mut self.gaps.start, &mut self.gaps.end);
        self.gaps.cuts = 0;
        closed.is_some()
    }
}
