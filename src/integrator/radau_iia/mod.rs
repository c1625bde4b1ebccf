//! Radau IIA collocation of orders 5, 9 and 13.

mod collocation;
mod convergence;
mod newton;
mod order;
mod stages;
mod velocity;

use super::explicit::widest_gap;
use super::{Control, Entry, From, Integrator, Problem, Setup, Steps, Tightening, Tolerance, With, collapsed};
use crate::choice::OptionDoc;
use crate::error::{Error, Result};
use crate::formulation::{self, Halt, Rows};
use crate::math::largest;
use crate::system::MechanicalSystem;
use collocation::Collocation;
use convergence::{Convergence, Verdict};
use newton::Newton;
use order::{Order, Seen, internal};
use stages::{Stages, Unknowns, combine};

/// ```text
/// V_i = v + h sum a_ij V'_j,   Q_i = q + h sum a_ij N V_j,   M V'_i + G^T L_i = f,   with at every stage
/// index3: phi = 0;   index2: G V + phi_t = 0;   index1: G V' = gamma
/// ggl: phi = 0, G V + phi_t = 0 and Q_i = q + h sum a_ij N (V_j + U_j),   M U_i + G^T mu_i = 0
/// ```
///
/// with lambda as an unknown in all of them; s = 3, 5 or 7 stages. Source: Hairer, Wanner, Solving Ordinary Differential
/// Equations II, IV.5, IV.8, VII.6 and the codes RADAU5 and RADAU; constants are computed from their definition. L-stable.
/// Order 2 s - 1 in q, v and lambda. With index3 the v of the last stage, and so lambda, would have order s: Hairer,
/// Lubich, Roche, Lecture Notes in Mathematics 1409 (1989). So a step of index3, and a row, ends with v moved to
/// G v + phi_t = 0, by the matrix that the new state's v' and lambda need in any case.
///
/// One matrix of n_v + n_c unknowns for the real eigenvalue of A and (s - 1)/2 complex ones a step, dense or sparse, from
/// exact K, C, G and L: q and v are eliminated. s evaluations and (s + 1)/2 back-substitutions an iteration; ggl has s more,
/// of the saddle-point matrix. Constantly redundant constraints are left out of the matrices. Error: the difference to a
/// formula of order s, damped along stiff directions; velocities that phi = 0 determines, of index 2, are weighted by h,
/// lambda is left out. Steps and stages follow from it, from the decay of the Legendre coefficients over the step and from
/// the contraction of Newton's method, which large rotations in a step slow down. An output row inside a step is a step
/// of its own, since the collocation polynomial has order s only: rows cost work that is not counted.
///
/// Limits: with index3 round-off of phi over h is an error of v, and with index3 and ggl round-off along nearly dependent
/// rows is that over their sine (1e-4 between masses 1 : 1e8 in line), so that steps of less than 1e-7 s there may end a
/// run: index2 goes on.
pub const ENTRY: Entry = Entry {
    name: "radau_iia",
    about: "implicit collocation of variable order 5, 9, 13, L-stable: stiff motions, and high accuracy",
    order: 5,
    orders: &[],
    steps: Steps::Either,
    // Errors over a motion were 0.1 rtol^0.8, with what `internal` makes of rtol: index 3 and fast modes lose order.
    tightening: Tightening { factor: 10.0, power: 1.25 },
    accepts: &["ggl", "index3", "index2", "index1"],
    refuses: &[With { formulation: "index3", projections: &["full"] }],
    options: &[OptionDoc { name: "order", about: "5, 9 or 13 (default: chosen as it goes; 5 with a fixed step)" }],
    make,
};

fn make(setup: &Setup) -> Result<Box<dyn Integrator>> {
    let n = setup.system.dimensions();
    let order = Order::new(setup.integrator, setup.is_fixed)?;
    let rows = formulation::rows(setup.formulation)
        .ok_or_else(|| Error::input(format!("radau_iia cannot integrate {}", setup.formulation.name)))?;
    let most = order.most_stages();
    Ok(Box::new(RadauIIA {
        newton: Newton::new(rows, most / 2, setup)?,
        stages: Stages::new(most, n),
        row: Stages::new(most, n),
        tolerance: Tolerance::new(1.0, 1.0, setup.system),
        convergence: Convergence::new(),
        before: Unknowns::new(most, n),
        tried: None,
        accepted: None,
        lambda: vec![0.0; n.lambda],
        factored: None,
        dropped: Vec::new(),
        error_x: vec![0.0; n.v],
        error_v: vec![0.0; n.v],
        error: vec![0.0; setup.len()],
        slope: vec![0.0; setup.len()],
        seen: Seen { error: 1.0, decay: 1.0, theta: 1.0 },
        order,
        is_fixed: setup.is_fixed,
    }))
}

struct RadauIIA {
    order: Order,
    is_fixed: bool,
    newton: Newton,
    stages: Stages,
    /// The stages of a step to an output row, and the internal tolerance.
    row: Stages,
    tolerance: Tolerance,
    convergence: Convergence,
    /// The last attempt.
    tried: Option<Step>,
    /// The last accepted step and its stages, whose polynomials predict those of the next.
    accepted: Option<Step>,
    before: Unknowns,
    /// lambda at the start of the step.
    lambda: Vec<f64>,
    /// Step, method and dropped rows that the matrices are factored for.
    factored: Option<(f64, usize)>,
    dropped: Vec<usize>,
    error_x: Vec<f64>,
    error_v: Vec<f64>,
    error: Vec<f64>,
    /// y' at the end of the last attempt, with index3.
    slope: Vec<f64>,
    /// Of the last attempt.
    seen: Seen,
}

#[derive(Clone, Copy)]
struct Step {
    start: f64,
    h: f64,
    /// Index of its method.
    method: usize,
}

impl RadauIIA {
    /// A new start means that the last attempt was accepted: its stages predict the next, and M, G, K and C are renewed.
    fn begin(&mut self, problem: &mut Problem, tolerance: &Tolerance, from: From) -> Result<(), Halt> {
        if self.tried.is_some_and(|step| step.start == from.t) {
            return Ok(());
        }
        if let Some(step) = self.tried.take() {
            std::mem::swap(&mut self.before, &mut self.stages.unknowns);
            self.accepted = Some(step);
            self.order.accepted(tolerance, &self.seen);
        }
        self.lambda.copy_from_slice(&problem.dynamics.lambda);
        self.factored = None;
        self.newton.linearize(problem, from, &self.lambda)
    }

    /// The matrices for a step `h`, unless they are there.
    fn factor(&mut self, problem: &mut Problem, from: From, h: f64) -> Result<(), Halt> {
        let wanted = Some((h, self.order.current()));
        if self.factored == wanted && self.dropped == problem.dynamics.held {
            return Ok(());
        }
        self.factored = None;
        if let Err(singular) = self.newton.factor(self.order.method(), h, &mut problem.dynamics) {
            return Err(collapsed(singular, problem, from, h));
        }
        self.factored = wanted;
        self.dropped.clone_from(&problem.dynamics.held);
        Ok(())
    }

    /// A first guess of V' and lambda: constant at the very start, else by the step before.
    fn predict(&mut self, problem: &Problem, from: From, h: f64) {
        let unknowns = &mut self.stages.unknowns;
        match self.accepted {
            Some(step) => {
                let ahead = self.order.method().nodes.iter().map(|node| 1.0 + node * h / step.h);
                unknowns.predict(&self.before, self.order.get(step.method), ahead);
            }
            None => unknowns.hold(problem.split(from.slope).1, &self.lambda),
        }
        self.newton.leave_out(unknowns);
    }

    /// The difference to a formula of order s, damped along the stiff directions, over the tolerated errors.
    fn estimate(
        &mut self,
        problem: &Problem,
        tolerance: &Tolerance,
        from: From,
        h: f64,
        to: &[f64],
    ) -> Result<f64, Halt> {
        let method = self.order.method();
        let (x, v) = (&mut self.error_x, &mut self.error_v);
        let ((q0, v0), (_, vdot0)) = (problem.split(from.y), problem.split(from.slope));
        let (nq, gamma) = (q0.len(), method.real.value);
        for k in 0..v0.len() {
            let stages = self.stages.y.iter().zip(&method.error);
            x[k] = h * (gamma * v0[k] + stages.map(|(y, d)| d * y[nq + k]).sum::<f64>());
        }
        v.iter_mut().zip(vdot0).for_each(|(v, vdot)| *v = h * gamma * vdot);
        combine(v, h, &method.error, &self.stages.unknowns.vdot);
        self.newton.filter((h * gamma, h), x, v, &problem.dynamics)?;
        let (dq, dv) = self.error.split_at_mut(nq);
        problem.dynamics.system.rate(q0, x, dq);
        dv[..v.len()].copy_from_slice(v);
        Ok(tolerance.norm_between(from.y, to, &self.error))
    }
}

/// Of the equations of a fixed step: their solution to round-off, beside 1 m or rad or a smaller largest q, which is none
/// below the second.
const EXACT: f64 = 1e-14;
const SMALLEST: f64 = 1e-10;

fn exact(q: &[f64], system: &dyn MechanicalSystem) -> Tolerance {
    let size = Some(largest(system.own(q))).filter(|size| *size > 0.0).map_or(1.0, |size| size.clamp(SMALLEST, 1.0));
    Tolerance::new(EXACT, EXACT * size, system)
}

/// One step as an implicit system: its stages, matrices and the judgement of their convergence.
struct Solver<'a> {
    stages: &'a mut Stages,
    newton: &'a mut Newton,
    convergence: &'a mut Convergence,
    method: &'a Collocation,
    is_fixed: bool,
}

impl Solver<'_> {
    /// Solves the equations of all stages for a step `h` from their first guess.
    fn solve(&mut self, problem: &mut Problem, tolerance: &Tolerance, from: From, h: f64) -> Result<(), Halt> {
        let (rows, s) = (self.newton.rows, self.method.stages());
        self.stages.rest(from);
        self.stages.advance(problem, self.method, from, h);
        let floor = self.stages.round_off(problem, tolerance, from, h, rows);
        // A fixed step cannot be tried smaller.
        let limits = if self.is_fixed { (50, 10) } else { (7 + 5 * (s - 3) / 2, 0) };
        self.convergence.begin(limits, tolerance.rtol, floor);
        loop {
            for i in 0..s {
                let t = from.t + self.method.nodes[i] * h;
                self.stages.leave(i, t, rows, &mut problem.dynamics)?;
            }
            self.newton.correct(self.method, h, self.stages, &mut problem.dynamics)?;
            self.stages.advance(problem, self.method, from, h);
            let change = self.stages.change(tolerance, from, s);
            match self.convergence.judge(change) {
                Verdict::Converged => break,
                Verdict::GoOn => {}
                Verdict::Failed => return Err(Halt::NotConverged),
            }
        }
        self.stages.work(self.method, from, h);
        Ok(())
    }
}

impl Integrator for RadauIIA {
    fn order(&self) -> usize {
        self.order.method().stages()
    }

    fn control(&mut self) -> &mut Control {
        &mut self.order.control
    }

    fn attempt(
        &mut self,
        problem: &mut Problem,
        tolerance: &Tolerance,
        from: From,
        h: f64,
        to: &mut [f64],
    ) -> Result<Option<f64>, Halt> {
        self.begin(problem, tolerance, from)?;
        let method = self.order.current();
        self.tried = Some(Step { start: from.t, h, method });
        let tolerance = match self.is_fixed {
            true => exact(problem.split(from.y).0, problem.dynamics.system),
            false => internal(tolerance, self.order.method().stages()),
        };
        self.tolerance = tolerance;
        self.factor(problem, from, h)?;
        self.predict(problem, from, h);
        let RadauIIA { order, newton, stages, convergence, is_fixed, .. } = self;
        let mut solver = Solver { stages, newton, convergence, method: order.method(), is_fixed: *is_fixed };
        solver.solve(problem, &tolerance, from, h)?;
        self.order.limit(&self.convergence);
        to.copy_from_slice(&self.stages.y[self.order.method().stages() - 1]);
        let error = self.estimate(problem, &tolerance, from, h, to)?;
        self.seen = Seen {
            error,
            decay: self.stages.decay(self.order.method(), &tolerance, from),
            theta: self.convergence.theta,
        };
        if self.newton.rows == Rows::Position && (self.is_fixed || error <= 1.0) {
            velocity::project(problem, from.t + h, to)?;
            velocity::slope(problem, from.t + h, to, &mut self.slope)?;
        }
        Ok(Some(error))
    }

    fn spacing(&self) -> f64 {
        widest_gap(&self.order.method().nodes).0
    }

    fn restart(&mut self) {
        (self.tried, self.accepted) = (None, None);
    }

    fn last_slope(&self) -> Option<&[f64]> {
        (self.newton.rows == Rows::Position).then_some(&self.slope)
    }

    fn prepare(&mut self, _: &mut Problem, _: From, _: f64, _: &[f64], _: &[f64]) -> Result<(), Halt> {
        Ok(())
    }

    /// By a step of that length, or by the collocation polynomial, which has order s only, where that finds no end.
    fn interpolate(
        &mut self,
        problem: &mut Problem,
        from: From,
        h: f64,
        theta: f64,
        out: &mut [f64],
    ) -> Result<(), Halt> {
        let RadauIIA { order, newton, stages, row, tolerance, .. } = self;
        let (method, h) = (order.method(), theta * h);
        newton.prepare(problem, from)?;
        newton.factor(method, h, &mut problem.dynamics)?;
        row.unknowns.predict(&stages.unknowns, method, method.nodes.iter().map(|node| theta * node));
        newton.leave_out(&mut row.unknowns);
        let mut convergence = Convergence::new();
        let is_fixed = self.is_fixed;
        let mut solver = Solver { stages: row, newton, convergence: &mut convergence, method, is_fixed };
        match solver.solve(problem, tolerance, from, h) {
            Ok(()) => out.copy_from_slice(&row.y[method.stages() - 1]),
            Err(_) => stages.interpolate(method, from, theta, out),
        }
        match newton.rows {
            Rows::Position => velocity::project(problem, from.t + h, out),
            _ => Ok(()),
        }
    }
}
