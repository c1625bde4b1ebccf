//! The stages of a step and the residuals of their equations.

use super::collocation::Collocation;
use super::rotations::Rotations;
use crate::formulation::{self, Dae, Dynamics, Residual, StepError};
use crate::integrator::sums::accumulate;
use crate::integrator::{Problem, StepStart, round_off};
use crate::system::{Dimensions, MechanicalSystem};
use crate::tolerances;

/// Error of a step of radau_iia that is the rounding of phi, over that of one state. Unit: `[1]`. Why: some operations
/// a stage. Test: `gains_of_any_size_are_stepped_over`.
const RADAU_ROUND_OFF: f64 = 10.0;

/// V_i = v + h sum a_ij (A_j + W_j),  Q_i = q + h sum a_ij N(Q_j) (V_j + U_j), with the accelerations A, lambda and,
/// where positions or velocities have multipliers of their own, the shifts U and W as unknowns.
pub struct Stages {
    pub unknowns: Unknowns,
    /// Q_i, V_i and the work at each stage, flat.
    pub y: Vec<Vec<f64>>,
    pub residuals: Vec<Residual>,
    n: Dimensions,
    next: Vec<Vec<f64>>,
    qdot: Vec<Vec<f64>>,
    velocity: Vec<f64>,
    pub rotations: Rotations,
}

/// The unknowns, stage by stage, those of shifts that the equations do not have empty: see [`formulation::Unknowns`].
pub struct Unknowns {
    pub a: Vec<Vec<f64>>,
    pub lambda: Vec<Vec<f64>>,
    pub w: Vec<Vec<f64>>,
    pub eta: Vec<Vec<f64>>,
    pub u: Vec<Vec<f64>>,
    pub mu: Vec<Vec<f64>>,
}

impl Unknowns {
    pub fn new(most: usize, n: Dimensions, dae: &Dae) -> Self {
        let rows = |is_there: bool, width: usize| vec![vec![0.0; if is_there { width } else { 0 }]; most];
        let [of_w, of_u] = [dae.eta.is_some(), dae.mu.is_some()];
        Unknowns {
            a: rows(true, n.v),
            lambda: rows(true, n.lambda),
            w: rows(of_w, n.v),
            eta: rows(of_w, n.lambda),
            u: rows(of_u, n.v),
            mu: rows(of_u, n.lambda),
        }
    }

    /// Sets all stages to the same a and lambda, without shifts.
    pub fn reset(&mut self, a: &[f64], lambda: &[f64]) {
        self.a.iter_mut().for_each(|stage| stage.copy_from_slice(a));
        self.lambda.iter_mut().for_each(|stage| stage.copy_from_slice(lambda));
        [&mut self.w, &mut self.eta, &mut self.u, &mut self.mu].into_iter().flatten().for_each(|stage| stage.fill(0.0));
    }

    /// Extrapolates all but eta and mu from the polynomials over the stages of another step by `method`, to the places
    /// `at` of that step, none of them its start.
    pub fn predict(&mut self, before: &Unknowns, method: &Collocation, at: impl Iterator<Item = f64>) {
        let Unknowns { a, lambda, w, eta, u, mu } = self;
        for (i, x) in at.enumerate() {
            [&mut a[i], &mut lambda[i], &mut w[i], &mut u[i]].into_iter().for_each(|stage| stage.fill(0.0));
            for j in 0..method.stages() {
                let weight = method.stage_lagrange(j, x);
                let add = |stages: &mut [Vec<f64>], before: &[Vec<f64>]| {
                    stages[i].iter_mut().zip(&before[j]).for_each(|(stage, before)| *stage += weight * before);
                };
                add(a, &before.a);
                add(lambda, &before.lambda);
                add(w, &before.w);
                add(u, &before.u);
            }
        }
        // Their equations are linear, and components along dependent rows would grow by extrapolation.
        eta.iter_mut().chain(mu).for_each(|stage| stage.fill(0.0));
    }

    /// Sets the multipliers of rows that are dropped from the matrices to zero, since no correction reaches them.
    pub fn leave_out(&mut self, rows: &[bool]) {
        for lambda in &mut self.lambda {
            lambda.iter_mut().zip(rows).filter(|(_, out)| **out).for_each(|(lambda, _)| *lambda = 0.0);
        }
    }
}

impl Stages {
    /// Memory for states of length `len`.
    pub fn new(most: usize, system: &dyn MechanicalSystem, len: usize, dae: &Dae) -> Self {
        let n = system.dimensions();
        let rows = |width: usize| vec![vec![0.0; width]; most];
        Stages {
            unknowns: Unknowns::new(most, n, dae),
            y: rows(len),
            residuals: vec![Residual::new(n); most],
            n,
            next: rows(len),
            qdot: rows(n.q),
            velocity: vec![0.0; n.v],
            rotations: Rotations::new(most, system),
        }
    }

    /// Sets all stages to the start, from which Q_i is iterated.
    pub fn reset(&mut self, from: StepStart) {
        self.y.iter_mut().for_each(|y| y.copy_from_slice(from.y));
        self.rotations.reset();
    }

    /// Q_i and V_i for the present unknowns. Where N depends on q, Q_i is found by sweeps from its last value, each of
    /// which reduces its error by about h |omega|/8.
    pub fn advance(&mut self, problem: &Problem, method: &Collocation, from: StepStart) {
        let h = from.h;
        let nq = self.n.q;
        let nv = self.n.v;
        let s = method.stages();
        let system = problem.dynamics.system;
        for i in 0..s {
            let (q, v) = self.next[i].split_at_mut(nq);
            q.copy_from_slice(&self.y[i][..nq]);
            v[..nv].copy_from_slice(&from.y[nq..nq + nv]);
            v[nv] = self.y[i][nq + nv];
            accumulate(&mut v[..nv], h, &method.a[i], &self.unknowns.a);
            accumulate(&mut v[..nv], h, &method.a[i], &self.unknowns.w);
        }
        let sweeps = if nq == self.n.moving() { 1 } else { tolerances::RADAU_SWEEPS };
        for sweep in 1..=sweeps {
            for i in 0..s {
                let (q, v) = self.next[i].split_at(nq);
                self.velocity.copy_from_slice(&v[..nv]);
                self.velocity.iter_mut().zip(&self.unknowns.u[i]).for_each(|(place, shift)| *place += shift);
                // N does not depend on the angles that count full turns: they follow in the last sweep.
                let written = if sweep == sweeps { nq } else { self.n.q_without_turns() };
                system.rate(q, &self.velocity, &mut self.qdot[i][..written]);
                self.rotations.set_rates(i, &self.velocity);
            }
            for (i, row) in method.a.iter().enumerate() {
                let q = &mut self.next[i][..nq];
                q.copy_from_slice(&from.y[..nq]);
                accumulate(q, h, row, &self.qdot);
                self.rotations.advance(i, row, h, from.y, q);
            }
        }
        std::mem::swap(&mut self.y, &mut self.next);
    }

    /// The largest component of a rotation vector in the step, rad.
    pub fn turned(&self) -> f64 {
        self.rotations.largest()
    }

    /// Root mean square over the stages of the last change, over the tolerated errors at the start.
    pub fn change(&mut self, from: StepStart, s: usize) -> f64 {
        let mut sum = 0.0;
        for (y, before) in self.y.iter().zip(&mut self.next).take(s) {
            before.iter_mut().zip(y).for_each(|(before, y)| *before = y - *before);
            sum += from.tolerance.norm(from.y, before).powi(2);
        }
        (sum / s as f64).sqrt()
    }

    /// The collocation polynomial at the fraction `theta` of the step.
    pub fn interpolate(&self, method: &Collocation, from: StepStart, theta: f64, out: &mut [f64]) {
        out.fill(0.0);
        let points = std::iter::once(from.y).chain(self.y.iter().map(Vec::as_slice));
        for (i, y) in points.enumerate().take(method.stages() + 1) {
            let weight = method.lagrange(i, theta);
            out.iter_mut().zip(y).for_each(|(out, y)| *out += weight * y);
        }
        self.rotations.interpolate(method, theta, from.y, out);
    }

    /// Round-off of the changes of a stage, over the tolerated errors: see [`round_off`].
    pub fn round_off(&mut self, problem: &Problem, from: StepStart, divisor: Option<f64>) -> f64 {
        round_off(problem, from.tolerance, from.y, divisor, &mut self.next[0])
    }

    /// The error to be accepted in units of the tolerance: where phi returns to zero at a large rate, it returns from
    /// its rounding, and no shorter step has less of that in its velocities.
    pub fn allowed(&mut self, dae: &Dae, problem: &Problem, from: StepStart) -> f64 {
        if dae.gain().is_none() {
            return 1.0;
        }
        1.0 + RADAU_ROUND_OFF * self.round_off(problem, from, dae.rounding_time(from.h))
    }

    /// The residuals of all stages of a step. One evaluation per stage.
    pub fn evaluate(
        &mut self,
        dae: &Dae,
        method: &Collocation,
        from: StepStart,
        stiffness: &[f64],
        dynamics: &mut Dynamics,
    ) -> Result<(), StepError> {
        for (i, residual) in self.residuals.iter_mut().enumerate().take(method.stages()) {
            let (q, v) = self.y[i].split_at(self.n.q);
            let Unknowns { a, lambda, w, eta, u, mu } = &self.unknowns;
            let unknowns = formulation::Unknowns {
                a: &a[i],
                lambda: &lambda[i],
                w: &w[i],
                eta: &eta[i],
                u: &u[i],
                mu: &mu[i],
                stiffness,
            };
            let t = from.t + method.nodes[i] * from.h;
            residual.evaluate(dae, t, q, &v[..self.n.v], unknowns, dynamics)?;
        }
        Ok(())
    }

    /// The work at each stage, from the powers of the last evaluations.
    pub fn work(&mut self, method: &Collocation, from: StepStart) {
        let first = self.n.q + self.n.v;
        for (y, a) in self.y.iter_mut().zip(&method.a) {
            for (i, (y, start)) in y[first..].iter_mut().zip(&from.y[first..]).enumerate() {
                let power = a.iter().zip(&self.residuals).map(|(a, residual)| a * residual.powers[i]);
                *y = start + from.h * power.sum::<f64>();
            }
        }
    }
}
