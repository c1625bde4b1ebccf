//! The states of a run and their receiver.

use crate::error::{Error, Result, significant};
use crate::math::{Piece, largest};
use crate::system::OperatingPoint;
use serde::{Deserialize, Serialize};
use std::ops::Range;
use std::time::Duration;

/// The interval to simulate and the distance of the output rows.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct Span {
    /// First time, s.
    pub start: f64,
    /// Last time, s.
    pub end: f64,
    /// Distance of the output rows, s.
    pub output_step: f64,
}

/// Number of rows of a trajectory by default.
const ROWS: f64 = 500.0;

/// `0.0..10.0`, with 500 rows.
impl From<Range<f64>> for Span {
    fn from(range: Range<f64>) -> Self {
        let Range { start, end } = range;
        Span { start, end, output_step: (end - start) / ROWS }
    }
}

impl Span {
    /// # Errors
    /// An end before the start, or an output step that is not positive.
    pub(crate) fn check(&self) -> Result<()> {
        if self.end > self.start && self.output_step > 0.0 {
            return Ok(());
        }
        Err(Error::input(format!("nothing to simulate from {} s to {} s", self.start, self.end))
            .hint("the end must come after the start and the output step must be above zero"))
    }

    /// Time of output row `row`: multiples of the output step, and the end.
    pub(crate) fn row(&self, row: u64) -> f64 {
        let t = self.start + row as f64 * self.output_step;
        // The last multiple and the end are one row when they differ only by round-off.
        if t > self.end - 1e-9 * self.output_step { self.end } else { t }
    }
}

/// The known quantities at a state of the motion.
pub struct Observation<'a> {
    /// Time, s.
    pub t: f64,
    /// Coordinates, n_q.
    pub q: &'a [f64],
    /// Velocities, n_v.
    pub v: &'a [f64],
    /// Accelerations, n_v.
    pub vdot: &'a [f64],
    /// Multipliers, n_c.
    pub lambda: &'a [f64],
    /// Constraints, n_c, m or rad.
    pub phi: &'a [f64],
    /// G v + phi_t, n_c.
    pub phi_dot: &'a [f64],
    /// G v' - gamma, n_c.
    pub phi_ddot: &'a [f64],
    /// Work of forces without a potential and of moving constraints since the start, J.
    pub work: f64,
    /// Work of the forces of [`SystemFacts::works`](crate::system::SystemFacts::works) since the start, J.
    pub works: &'a [f64],
    /// The pieces on which the run evaluates functions that change their form.
    pub pieces: &'a [Piece],
    /// Values of the inputs; empty where they are zero.
    pub inputs: &'a [f64],
    /// Change of energy due to the tolerated errors of this step, J; `None` for fixed steps and output rows.
    pub tolerated: Option<f64>,
    /// The longest time between evaluations of the equations in the step, s; `None` at the start and in output rows.
    pub apart: Option<f64>,
    /// Sum of the sizes of all generalized forces and multipliers, N and N m; `None` in output rows.
    pub effort: Option<f64>,
    /// The smallest sine between a row of G and those before it (metric M^-1), zero at a singular state; `None` where
    /// the method does not factor the saddle-point matrix there.
    pub rank_indicator: Option<f64>,
    /// Rows of G that depend on the others everywhere, and are dropped.
    pub dropped: &'a [usize],
}

impl Observation<'_> {
    /// The state with its accelerations and multipliers.
    pub fn loaded(&self) -> OperatingPoint<'_> {
        OperatingPoint { t: self.t, q: self.q, v: self.v, vdot: self.vdot, lambda: self.lambda }
    }
}

/// Receives the motion while it is computed.
pub trait Sink {
    /// Called with every accepted step, the start included, if it [`watches`](Self::watches) them.
    fn accepted(&mut self, _state: &Observation) {}
    /// False if no step needs to be shown, which saves the residuals of an observation.
    fn watches(&self) -> bool {
        true
    }
    /// Called with every output row, in order.
    fn row(&mut self, _state: &Observation) {}
    /// True if it is to be shown both sides of each change of form.
    fn watches_events(&self) -> bool {
        false
    }
    /// Called with the state at which the equations change their form, before they do.
    fn before_event(&mut self, _state: &Observation) {}
    /// Called with the same state after the change: v' and lambda may have jumped, and v with a prescribed rate.
    fn after_event(&mut self, _state: &Observation) {}
    /// Called before every step and after every row: returns the reason if the run is given up here, which is a
    /// failure.
    fn stops(&self) -> Option<Stop> {
        None
    }
    /// Called before every step and after every row: true if the run has shown what was wanted, which is no failure. It
    /// ends with the step it is in, of which one more row may be shown.
    fn is_done(&self) -> bool {
        false
    }
    /// True if the run is to end at a root of [`root`](Self::root).
    fn watches_root(&self) -> bool {
        false
    }
    /// A function of the state, at whose first change of sign the run ends: a step ends there, and it is the last row.
    /// Called at quarters of each step, and where the root is located.
    fn root(&mut self, _state: &Observation) -> f64 {
        1.0
    }
}

/// A closure is called with every accepted step, the start included.
impl<F: FnMut(&Observation)> Sink for F {
    fn accepted(&mut self, state: &Observation) {
        self(state);
    }
}

/// Stores nothing.
impl Sink for () {
    fn watches(&self) -> bool {
        false
    }
}

/// The reason to end a run from outside, and the remedy.
#[derive(Clone, Debug, PartialEq)]
pub struct Stop {
    /// The reason, for the message.
    pub reason: String,
    /// The remedy, for the message.
    pub hint: String,
}

impl Stop {
    /// Stop of a run that exceeds its time.
    pub fn deadline(allowed: Duration) -> Stop {
        let seconds = significant(allowed.as_secs_f64(), 3);
        Stop {
            reason: format!("it takes longer than the {seconds} s that it may"),
            hint: "allow more time, or choose a looser tolerance, a longer step or another method".to_string(),
        }
    }
}

impl super::TimeLoop<'_> {
    /// Sum of the sizes of all generalized forces and multipliers at the present state, N and N m.
    pub fn effort(&self) -> f64 {
        let dynamics = &self.problem.dynamics;
        let forces = &dynamics.terms.f[..dynamics.system.dimensions().moving()];
        forces.iter().chain(&dynamics.lambda).map(|force| force.abs()).sum()
    }

    /// Change of the energy at the state by the tolerated errors of q and v, to first order, J: sum |M v|_i w(v_i) +
    /// |f_i| w(q), with the tolerance w of the largest coordinate.
    pub fn tolerated_energy(&mut self) -> f64 {
        let dynamics = &self.problem.dynamics;
        let (q, v) = self.problem.split(&self.y);
        let moving = dynamics.system.dimensions().moving();
        self.momentum.fill(0.0);
        dynamics.structure.mass.multiply_symmetric(&dynamics.terms.mass, v, &mut self.momentum);
        let of_q = self.tolerance.weight(0.0, largest(dynamics.system.dimensions().without_turns(q)));
        let of_v = self.momentum.iter().zip(v).take(moving).map(|(p, v)| p.abs() * self.tolerance.weight(0.0, *v));
        of_v.sum::<f64>() + of_q * dynamics.terms.f.iter().take(moving).map(|f| f.abs()).sum::<f64>()
    }
}
