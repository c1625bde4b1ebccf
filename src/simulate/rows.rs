//! Output rows, and the observation of a state.

use super::{Observation, Sink, TimeLoop};
use crate::formulation::{Statistics, StepError};
use crate::integrator::Problem;
use crate::math::all_finite;
use crate::projection::Projection;

/// Output rows with a problem of their own: their work is counted separately from that of the steps.
pub struct OutputRows<'a> {
    pub problem: Problem<'a>,
    pub projection: Option<Box<dyn Projection + 'a>>,
    /// Index of the next row.
    pub next: u64,
    pub y: Vec<f64>,
    /// y' at `y`.
    pub slope: Vec<f64>,
    /// v' of the dense output there.
    pub vdot: Vec<f64>,
    pub ahead: Vec<f64>,
    phi_ddot: Vec<f64>,
    /// Time of the last row shown, s.
    pub shown: f64,
}

impl<'a> OutputRows<'a> {
    pub fn new(problem: Problem<'a>, projection: Option<Box<dyn Projection + 'a>>) -> Self {
        let zeros = || vec![0.0; problem.len()];
        let y = zeros();
        let slope = zeros();
        let ahead = zeros();
        let vdot = vec![0.0; problem.dynamics.vdot.len()];
        let phi_ddot = vec![0.0; problem.dynamics.lambda.len()];
        OutputRows { problem, projection, next: 0, y, slope, vdot, ahead, phi_ddot, shown: f64::NEG_INFINITY }
    }

    /// Evaluates the state in `y` and passes it to the sink.
    pub fn emit(&mut self, t: f64, sink: &mut dyn Sink) -> Result<(), StepError> {
        self.evaluate(t)?;
        self.show(t, sink);
        Ok(())
    }

    pub fn evaluate(&mut self, t: f64) -> Result<(), StepError> {
        self.problem.derivative(t, &self.y, &mut self.slope)
    }

    /// Sets `vdot` to the difference quotient of `y` and the state `ahead`, which is `dt` later.
    pub fn differentiate(&mut self, dt: f64) {
        let before = self.problem.split(&self.y).1;
        let after = self.problem.split(&self.ahead).1;
        let rates = before.iter().zip(after).map(|(before, after)| (after - before) / dt);
        self.vdot.iter_mut().zip(rates).for_each(|(vdot, rate)| *vdot = rate);
    }

    /// Shows one side of a change of form at the state in `y`.
    pub fn show_event(&mut self, t: f64, is_after: bool, sink: &mut dyn Sink) -> Result<(), StepError> {
        self.evaluate(t)?;
        let state = observation(t, &self.y, &self.problem, None, &mut self.phi_ddot);
        if is_after {
            sink.after_event(&state)
        } else {
            sink.before_event(&state)
        }
        Ok(())
    }

    /// The function of the sink at the state in `y`.
    pub fn root(&mut self, t: f64, sink: &mut dyn Sink) -> Result<f64, StepError> {
        self.evaluate(t)?;
        Ok(sink.root(&observation(t, &self.y, &self.problem, None, &mut self.phi_ddot)))
    }

    /// Calls `see` with the state in `y`.
    pub fn see(&mut self, t: f64, see: &mut dyn FnMut(&Observation)) -> Result<(), StepError> {
        self.evaluate(t)?;
        see(&observation(t, &self.y, &self.problem, None, &mut self.phi_ddot));
        Ok(())
    }

    pub fn show(&mut self, t: f64, sink: &mut dyn Sink) {
        self.shown = t;
        sink.row(&observation(t, &self.y, &self.problem, None, &mut self.phi_ddot));
    }
}

/// Ends a step or makes an output row of it, and projects the state in `sweeps` sweeps.
pub fn project(
    t: f64,
    y: &mut [f64],
    problem: &mut Problem,
    projection: &mut Option<Box<dyn Projection + '_>>,
    sweeps: usize,
) -> Result<(), StepError> {
    for _ in 0..sweeps {
        if !all_finite(y) {
            return Err(StepError::NotFinite);
        }
        problem.dynamics.system.normalize(problem.split_mut(y).0);
        problem.end_step(t, y)?;
        let (q, v) = problem.split_mut(y);
        if let Some(projection) = projection {
            projection.project(t, q, v, &mut problem.dynamics)?;
        }
    }
    Ok(())
}

impl TimeLoop<'_> {
    /// Work of steps, and separately that of output rows.
    pub fn statistics(&self) -> Statistics {
        let rows = self.rows.problem.dynamics.statistics.of_steps();
        Statistics { rows, ..self.problem.dynamics.statistics }
    }

    /// Updates the reference values of the rank at an accepted state, and shows the state with the size of its step.
    pub fn observe(&mut self, size: Option<f64>, sink: &mut dyn Sink) {
        let deficient = self.problem.dynamics.is_rank_deficient;
        self.problem.dynamics.statistics.rank_deficient += u64::from(deficient);
        let dynamics = &self.problem.dynamics;
        // Without a new factorization, as in `penalty`, the rank indicator belongs to another state.
        let is_factored = dynamics.statistics.factorizations > self.factored;
        self.factored = dynamics.statistics.factorizations;
        let own = || (is_factored && dynamics.kkt.is_factored()).then(|| dynamics.kkt.rank_indicator());
        let rank_indicator = dynamics.rank_indicator.or_else(own);
        if let Some(rank_indicator) = rank_indicator {
            self.approach.add(self.t, rank_indicator);
        }
        let dense = dynamics.dense_reference.max(dynamics.dense_indicator);
        self.refer_to(dense);
        self.show(rank_indicator, size, sink);
    }

    /// Sets the reference values of the rank indicators, that of a dense solver to `dense`.
    pub fn refer_to(&mut self, dense: f64) {
        let TimeLoop { problem, rows, approach, .. } = self;
        [problem, &mut rows.problem].into_iter().for_each(|p| p.dynamics.refer_to(approach.largest, dense));
    }

    pub fn show(&mut self, rank_indicator: Option<f64>, size: Option<f64>, sink: &mut dyn Sink) {
        if !sink.watches() {
            return;
        }
        let tolerated = self.fixed.is_none().then(|| self.tolerated_energy());
        let effort = Some(self.effort());
        let state = observation(self.t, &self.y, &self.problem, rank_indicator, &mut self.phi_ddot);
        let apart = size.map(|size| size * self.integrator.control().spacing);
        sink.accepted(&Observation { tolerated, apart, effort, ..state });
    }
}

pub fn observation<'o>(
    t: f64,
    y: &'o [f64],
    problem: &'o Problem,
    rank_indicator: Option<f64>,
    phi_ddot: &'o mut [f64],
) -> Observation<'o> {
    let dynamics = &problem.dynamics;
    let (q, v) = problem.split(y);
    dynamics.acceleration_residual(phi_ddot);
    Observation {
        t,
        q,
        v,
        vdot: &dynamics.vdot,
        lambda: &dynamics.lambda,
        phi: &dynamics.terms.phi,
        phi_dot: &dynamics.terms.phi_dot,
        phi_ddot,
        work: y[q.len() + v.len()],
        works: &y[q.len() + v.len() + 1..],
        pieces: &dynamics.scratch.pieces,
        inputs: &dynamics.scratch.inputs,
        tolerated: None,
        apart: None,
        effort: None,
        rank_indicator,
        dropped: &dynamics.dropped,
    }
}
