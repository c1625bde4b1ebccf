//! The accelerations carried from step to step, and q and v that follow from them.

use super::super::sums::add;
use super::super::{Problem, StepStart};
use super::prediction::{Prediction, StepState};
use crate::formulation::{Change, Dae, ExponentialMap, Slopes, StepError, Unknowns};
use crate::math::largest;
use crate::system::MechanicalSystem;
use serde::{Deserialize, Serialize};

/// Coefficients of the method.
#[derive(Clone, Copy)]
pub(super) struct Scheme {
    alpha_m: f64,
    alpha_f: f64,
    gamma: f64,
    beta: f64,
}

impl Scheme {
    /// Coefficients for rho_inf = r.
    pub fn new(r: f64) -> Self {
        let alpha_m = (2.0 * r - 1.0) / (r + 1.0);
        let alpha_f = r / (r + 1.0);
        let gamma = 0.5 + alpha_f - alpha_m;
        Scheme { alpha_m, alpha_f, gamma, beta: 0.25 * (gamma + 0.5) * (gamma + 0.5) }
    }

    /// Derivatives of q_1 and v_1 with respect to v'_1 and the shifts.
    pub fn slopes(&self, h: f64) -> Slopes<f64> {
        let Scheme { alpha_m, alpha_f, gamma, beta } = self;
        // da_1/dv'_1
        let slope = (1.0 - alpha_f) / (1.0 - alpha_m);
        Slopes { v: h * gamma * slope, q: h * h * beta * slope, w: 1.0, w_q: 0.0, u: 1.0 }
    }

    /// Part of a step from the time of the state to that of a: a = v'(t + lead h).
    fn lead(&self) -> f64 {
        self.alpha_m - self.alpha_f
    }

    /// Coefficient of h^3 v'' in the local error of q.
    fn error(&self) -> f64 {
        1.0 / 6.0 - self.beta - 0.5 * self.lead()
    }

    /// Coefficient of h^3 v''' in the local error of v: a = v'(t + lead h) + kappa h^2 v''', kappa from the recurrence
    /// of a.
    fn error_of_rate(&self) -> f64 {
        let kappa = 0.5 * (1.0 - self.alpha_f) - (1.0 - self.alpha_m) * (0.5 + self.lead());
        1.0 / 6.0 - kappa - self.gamma * (0.5 + self.lead())
    }
}

/// What steps pass on, for [`StepMotion::recall`].
#[derive(Serialize, Deserialize)]
pub(super) struct MotionMemory {
    is_started: bool,
    start: StepState,
    prediction: Prediction,
}

pub(super) struct StepMotion {
    pub scheme: Scheme,
    /// True if `start` is known.
    is_started: bool,
    start: StepState,
    pub end: StepState,
    prediction: Prediction,
    /// a at the start, adapted to the present step size.
    a: Vec<f64>,
    /// The shifts of v and q. Each correction satisfies the equation of the shift, and so does their sum.
    w: Vec<f64>,
    u: Vec<f64>,
    /// Change of q along the directions of v: with the predicted a_1, and the remaining one.
    predicted: Vec<f64>,
    change: Vec<f64>,
    a_predicted: Vec<f64>,
    /// q after the first change, if the two changes are applied in succession.
    between: Option<Vec<f64>>,
    retraction: ExponentialMap,
}

impl StepMotion {
    pub fn new(scheme: Scheme, system: &dyn MechanicalSystem, dae: &Dae) -> Self {
        let n = system.dimensions();
        let zeros = |n: usize| vec![0.0; n];
        StepMotion {
            scheme,
            is_started: false,
            start: StepState::new(n),
            end: StepState::new(n),
            prediction: Prediction::new(n),
            a: zeros(n.v),
            w: zeros(n.v),
            u: zeros(n.v),
            predicted: zeros(n.v),
            change: zeros(n.v),
            a_predicted: zeros(n.v),
            between: dae.mu.map(|_| zeros(n.q)),
            retraction: ExponentialMap::new(system),
        }
    }

    /// Prepares a step of size `h` from the step before (or from the start), predicts its end, and discards one tried
    /// before from here. `ahead` is scratch.
    pub fn begin(&mut self, problem: &mut Problem, from: StepStart, ahead: &mut [f64]) -> Result<(), StepError> {
        let h = from.h;
        if !self.is_started {
            self.start(problem, from, ahead)?;
        }
        self.end.h = h;
        let StepState { a, vdot, h: own, .. } = &self.start;
        for (i, next) in self.a.iter_mut().enumerate() {
            *next = vdot[i] + h / own * (a[i] - vdot[i]);
        }
        self.prediction.predict(&self.start, h, &mut self.end);
        [&mut self.w, &mut self.u].into_iter().for_each(|shift| shift.fill(0.0));
        self.predict(problem, from);
        Ok(())
    }

    /// Sets a = v'(t + (alpha_m - alpha_f) h) + O(h^2), which avoids transients of first order in lambda.
    fn start(&mut self, problem: &mut Problem, from: StepStart, ahead: &mut [f64]) -> Result<(), StepError> {
        let h = from.h;
        let (_, vdot) = problem.split(from.slope);
        self.start.vdot.copy_from_slice(vdot);
        for (i, ahead) in ahead.iter_mut().enumerate() {
            *ahead = from.y[i] + h * from.slope[i];
        }
        let (q, v) = problem.split_mut(ahead);
        let dynamics = &mut problem.dynamics;
        dynamics.system.normalize(q);
        dynamics.solve(from.t + h, q, v, |_, _| 0.0)?;
        for (i, a) in self.start.a.iter_mut().enumerate() {
            *a = vdot[i] + self.scheme.lead() * (dynamics.vdot[i] - vdot[i]);
        }
        self.start.lambda.copy_from_slice(&dynamics.lambda);
        (self.is_started, self.start.h) = (true, h);
        Ok(())
    }

    /// True if the end is predicted by more than the start.
    pub fn is_extrapolated(&self) -> bool {
        self.prediction.degree() > 0
    }

    /// Predicts the end by the start alone from now on.
    pub fn forget_past(&mut self) {
        self.prediction.restart();
    }

    /// Discards the last step.
    pub fn restart(&mut self) {
        self.is_started = false;
        self.prediction.restart();
    }

    /// `start` and what predicts the end.
    pub fn memory(&self) -> MotionMemory {
        MotionMemory { is_started: self.is_started, start: self.start.clone(), prediction: self.prediction.clone() }
    }

    /// Restores a [`memory`](Self::memory).
    pub fn recall(&mut self, MotionMemory { is_started, start, prediction }: &MotionMemory) {
        self.is_started = *is_started;
        self.start.recall(start);
        self.prediction.recall(prediction);
    }

    /// Accepts the step: its end becomes the start.
    pub fn accepted(&mut self) {
        self.prediction.accepted(&self.start, &self.end);
        std::mem::swap(&mut self.start, &mut self.end);
    }

    /// The unknowns at the end, without the shifts.
    pub fn unknowns(&self) -> Unknowns<'_> {
        Unknowns { a: &self.end.vdot, lambda: &self.end.lambda, ..Unknowns::default() }
    }

    /// Adds the changes to the unknowns. Returns the largest change of the first `moving` v'_1 or of a shift in their
    /// unit, and that of xi'_1. Shifts of q below `round_off` count as zero, since over h^2 they would exceed all other
    /// changes.
    pub fn correct(&mut self, change: &Change<f64>, moving: usize, h: f64, round_off: f64) -> [f64; 2] {
        add(&mut self.end.vdot, &change.a);
        add(&mut self.end.lambda, &change.lambda);
        add(&mut self.w, &change.w);
        add(&mut self.u, &change.u);
        let slopes = self.scheme.slopes(h);
        let moved = Some(largest(&change.u)).filter(|moved| *moved > round_off).unwrap_or(0.0) / slopes.q;
        let (a, states) = change.a.split_at(moving);
        [largest(a).max(largest(&change.w) / slopes.v).max(moved), largest(states)]
    }

    /// The leading term of the error of q along the directions of v: `Scheme::error` h^3 v'', and h^3/12 \[v, v'\], by
    /// which rotations about a moving axis differ from that by the integral of v. Source: Magnus, Comm. Pure Appl.
    /// Math. 7 (1954) 649-673.
    pub fn local_error(&mut self, problem: &Problem, from: StepStart) -> &[f64] {
        let h = from.h;
        let factor = self.scheme.error() * h * h;
        problem.dynamics.system.bracket(problem.split(from.y).1, &self.start.vdot, &mut self.change);
        for (i, error) in self.change.iter_mut().enumerate() {
            *error = h * h * h / 12.0 * *error + factor * (self.end.a[i] - self.a[i]);
        }
        &self.change
    }

    /// The largest angle of a rotation in the step, as it was predicted, rad.
    pub fn turned(&self) -> f64 {
        self.retraction.largest_angle(&self.predicted)
    }

    /// The leading term of the error of velocity `i`, a state.
    pub fn state_error(&self, i: usize, h: f64) -> f64 {
        let change = self.end.vdot[i] - self.start.vdot[i];
        // h^2 xi''', or, at the first step, h xi'', which is larger.
        let curvature = self
            .prediction
            .last(i)
            .map_or(change, |(age, before)| 2.0 * h * (change - (self.start.vdot[i] - before) * h / age) / (h + age));
        self.scheme.error_of_rate() * h * curvature
    }

    /// The largest change of a in the step.
    pub fn largest_change(&self) -> f64 {
        self.end.a.iter().zip(&self.a).fold(0.0, |largest, (end, start)| largest.max((end - start).abs()))
    }

    /// Sets a_1 for the present v'_1.
    fn set_end(&mut self) {
        let (Scheme { alpha_m, alpha_f, .. }, StepState { a: ends, vdot, .. }) = (&self.scheme, &mut self.end);
        let known = vdot.iter().zip(&self.start.vdot).zip(&self.a);
        for (end, ((vdot, before), a)) in ends.iter_mut().zip(known) {
            *end = ((1.0 - alpha_f) * vdot + alpha_f * before - alpha_m * a) / (1.0 - alpha_m);
        }
    }

    fn predict(&mut self, problem: &Problem, from: StepStart) {
        let h = from.h;
        self.set_end();
        self.a_predicted.copy_from_slice(&self.end.a);
        let ((q0, v0), beta) = (problem.split(from.y), self.scheme.beta);
        let known = v0.iter().zip(self.a.iter().zip(&self.end.a));
        for (predicted, (v, (a, end))) in self.predicted.iter_mut().zip(known) {
            *predicted = h * v + h * h * ((0.5 - beta) * a + beta * end);
        }
        if let Some(between) = &mut self.between {
            self.retraction.apply(problem.dynamics.system, q0, &self.predicted, between);
        }
    }

    /// a_1, v_1 and q_1 for the present v'_1 and shifts.
    pub fn advance(&mut self, problem: &Problem, from: StepStart, to: &mut [f64]) {
        let h = from.h;
        self.set_end();
        let (q0, v0) = problem.split(from.y);
        let (q, v) = problem.split_mut(to);
        let Scheme { gamma, beta, .. } = self.scheme;
        let known = v0.iter().zip(self.a.iter().zip(&self.end.a)).zip(&self.w);
        for (v, ((v0, (a, end)), w)) in v.iter_mut().zip(known) {
            *v = v0 + h * ((1.0 - gamma) * a + gamma * end) + w;
        }
        let known = self.end.a.iter().zip(&self.a_predicted).zip(&self.u);
        for (change, ((end, predicted), u)) in self.change.iter_mut().zip(known) {
            *change = h * h * beta * (end - predicted) + u;
        }
        let start = self.between.as_deref().unwrap_or_else(|| {
            add(&mut self.change, &self.predicted);
            q0
        });
        self.retraction.apply(problem.dynamics.system, start, &self.change, q);
    }
}
