//! Radau IIA collocation of orders 5, 9 and 13.

mod collocation;
mod matrices;
mod order;
mod rotations;
mod stages;
mod system;
mod velocity;

use super::memory::{fill, read, written};
use super::newton_matrix::{self, Factors, NewtonMatrix, SavedMatrix, Size};
use super::sums::accumulate;
use super::{
    Accepted, Control, Dense, Integrator, IntegratorEntry, Problem, Setup, Step, StepStart, Steps, Tightening,
    Tolerance, refuses,
};
use crate::error::Result;
use crate::formulation::{Dae, StepError};
use crate::math::newton::Monitor;
use crate::method_spec::OptionDoc;
use crate::system::OperatingPoint;
use crate::tolerances;
use collocation::Collocation;
use matrices::Matrices;
use order::{Choice, Order, StepMeasures, internal};
use serde::{Deserialize, Serialize};
use serde_json::Value;
use stages::{Stages, Unknowns};
use system::{System, most};

/// ```text
/// V_i = v + h sum a_ij (A_j + W_j),   Q_i = q + h sum a_ij N (V_j + U_j),   M A_i + G^T lambda_i = f
/// ```
///
/// with the rows of the formulation's [`Dae`] at every stage, and its shifts U and W; unit quaternions by their
/// rotation vectors from q, which are exact where the axis is fixed; s = 3, 5 or 7 stages. Source: Hairer, Wanner,
/// Solving Ordinary Differential Equations II, IV.5, IV.8, VII.6 and the codes RADAU5 and RADAU; constants are computed
/// from their definition. L-stable. Order 2 s - 1 in q, v and lambda. Where phi = 0 alone is solved the v of the last
/// stage, and so lambda, would have order s: Hairer, Lubich, Roche, Lecture Notes in Mathematics 1409 (1989). So such a
/// step, and a row, ends with v moved to G v + phi_t = 0, by the matrix that the new state's v' and lambda need in any
/// case.
///
/// One matrix of n_v + n_c unknowns for the real eigenvalue of A and (s - 1)/2 complex ones, dense or sparse, from
/// exact K, C, G and L: q and v are eliminated. The matrices are kept for the next step as long as Newton's method
/// contracts by thirty thousand with them. s evaluations and (s + 1)/2 back-substitutions per iteration, s more of the
/// saddle-point matrix for each shift. Constantly redundant constraints are dropped from the matrices. Error: the
/// difference to a formula of order s, damped along stiff directions; velocities that phi = 0 determines, of index 2,
/// are weighted by h, lambda is not tested. Steps and stages are chosen by it, by what it would be with two stages
/// less and by the contraction of Newton's method, which is slower for large rotations in a step.
/// An output row inside a step is a step of its own, since the collocation polynomial has order s only.
///
/// Limits: with index3 round-off of phi over h is an error of v, and with index3 and ggl round-off along nearly
/// dependent rows is divided by their rank indicator (1e-4 between masses 1 : 1e8 in line), so that steps below 1e-7 s
/// may end a run there; index2 continues.
pub const ENTRY: IntegratorEntry = IntegratorEntry {
    steps: Steps::Either,
    // Errors over a motion were 0.1 rtol^0.8, with the rtol of `internal`: index 3 and fast modes lose order.
    tightening: Tightening::new(10.0, 1.25),
    solves: |formulation| formulation.dae.is_some(),
    refuses: refuses::shared_error,
    options: &[OptionDoc { name: "order", about: "5, 9 or 13 (default: chosen as it goes; 5 with a fixed step)" }],
    ..IntegratorEntry::new(
        "radau_iia",
        "implicit collocation of variable order 5, 9, 13, L-stable: stiff motions, and high accuracy",
        5,
        make,
    )
};

fn make(setup: &Setup) -> Result<Box<dyn Integrator>> {
    let n = setup.system.dimensions();
    let order = Order::new(setup.integrator, setup.is_fixed)?;
    let dae = setup.dae()?;
    let most = order.methods.iter().map(Collocation::stages).max().unwrap_or(0);
    let matrices = || Matrices::new(dae, &order.methods, setup);
    Ok(Box::new(RadauIIA {
        dae,
        matrix: NewtonMatrix::new(dae, setup.system, matrices()?),
        row_matrices: matrices()?,
        stages: Stages::new(most, setup.system, setup.len(), &dae),
        row: Stages::new(most, setup.system, setup.len(), &dae),
        tolerance: Tolerance::new(1.0, 1.0, setup.system),
        before: Unknowns::new(most, n, &dae),
        tried: None,
        accepted: None,
        lambda: vec![0.0; n.lambda],
        is_begun: false,
        error_x: vec![0.0; n.v],
        error_v: vec![0.0; n.v],
        error: vec![0.0; setup.len()],
        slope: vec![0.0; setup.len()],
        seen: StepMeasures { error: 1.0, lower: 1.0, theta: 1.0 },
        order,
        is_fixed: setup.is_fixed,
    }))
}

struct RadauIIA {
    dae: Dae,
    order: Order,
    is_fixed: bool,
    matrix: NewtonMatrix<Matrices>,
    stages: Stages,
    /// Matrices and stages of a step to an output row, and the internal tolerance.
    row_matrices: Matrices,
    row: Stages,
    tolerance: Tolerance,
    /// The last attempt.
    tried: Option<Tried>,
    /// The last accepted step and its stages, whose polynomials predict those of the next.
    accepted: Option<Size>,
    before: Unknowns,
    /// lambda at the start of the step, and whether a step was tried from there.
    lambda: Vec<f64>,
    is_begun: bool,
    error_x: Vec<f64>,
    error_v: Vec<f64>,
    error: Vec<f64>,
    /// y' at the end of the last attempt, if v was projected there.
    slope: Vec<f64>,
    /// Measures of the last attempt.
    seen: StepMeasures,
}

/// What steps pass on, as it is saved.
#[derive(Serialize, Deserialize)]
struct RadauMemory {
    choice: Choice,
    /// The last accepted step, with a, lambda, w and u of its stages.
    accepted: Option<Size>,
    stages: [Vec<Vec<f64>>; 4],
    matrix: newton_matrix::Memory,
}

#[derive(Clone, Copy)]
struct Tried {
    size: Size,
    /// Memory of Newton's method before it: a step that a saved run takes again begins with that.
    monitor: [f64; 2],
}

impl RadauIIA {
    /// M, G, K and C at the middle stage as it is predicted: stiff directions that turn with the motion, as those of
    /// beams do, are off by half as much at the other stages as they would be from the start. At the start where there
    /// is no prediction, or where a cut step before makes it a far one.
    fn linearize(&mut self, problem: &mut Problem, from: StepStart) -> Result<(), StepError> {
        let h = from.h;
        let is_near = |step: Size| h <= tolerances::RADAU_GROWTH * step.h;
        if self.accepted.is_some_and(is_near) {
            self.predict(problem, from);
            let RadauIIA { order, stages, matrix, .. } = self;
            let method = order.method();
            let middle = order.method().stages() / 2;
            stages.reset(from);
            stages.advance(problem, method, from);
            let (q, v) = problem.split(&stages.y[middle]);
            let (vdot, lambda) = (&stages.unknowns.a[middle][..], &stages.unknowns.lambda[middle][..]);
            let t = from.t + method.nodes[middle] * h;
            matrix.linearize(OperatingPoint { t, q, v, vdot, lambda }, &mut problem.dynamics)
        } else {
            let ((q, v), (_, vdot)) = (problem.split(from.y), problem.split(from.slope));
            let at = OperatingPoint { t: from.t, q, v, vdot, lambda: &self.lambda };
            self.matrix.linearize(at, &mut problem.dynamics)
        }
    }

    /// The step `h` with the present method.
    fn size(&self, h: f64) -> Size {
        Size { h, method: self.order.current() }
    }

    /// First guess of the accelerations and lambda: constant at the first step, else extrapolated from the step before.
    fn predict(&mut self, problem: &Problem, from: StepStart) {
        let unknowns = &mut self.stages.unknowns;
        match self.accepted {
            Some(step) => {
                let ahead = self.order.method().nodes.iter().map(|node| 1.0 + node * from.h / step.h);
                unknowns.predict(&self.before, &self.order.methods[step.method], ahead);
            }
            None => unknowns.reset(problem.split(from.slope).1, &self.lambda),
        }
        self.matrix.factors.leave_out(unknowns);
    }

    /// The middle of a refused step is far from that of a shorter one, unless the matrices hardly change.
    fn keeps_matrix(&self) -> bool {
        !self.matrix.is_fresh || self.matrix.monitor.keeps_matrix()
    }

    /// Solves the equations of all stages, with the present matrices or new ones.
    fn solve(&mut self, problem: &mut Problem, from: StepStart) -> Result<bool, StepError> {
        self.matrix.factor(problem, from, self.size(from.h))?;
        self.predict(problem, from);
        let RadauIIA { dae, order, matrix, stages, is_fixed, .. } = self;
        let NewtonMatrix { at, factors: matrices, monitor, .. } = matrix;
        let mut collocation = System { dae, method: order.method(), at, matrices, stages, is_fixed: *is_fixed };
        collocation.solve(monitor, problem, from)
    }

    /// An error estimate h (gamma y'_0 + sum d_i Y'_i), damped along the stiff directions, over the tolerated errors.
    fn estimate(
        &mut self,
        problem: &Problem,
        from: StepStart,
        to: &[f64],
        weights: impl Fn(&Collocation) -> &[f64],
    ) -> Result<f64, StepError> {
        let h = from.h;
        let method = self.order.method();
        let d = weights(method);
        let (x, v) = (&mut self.error_x, &mut self.error_v);
        let ((q0, v0), (_, vdot0)) = (problem.split(from.y), problem.split(from.slope));
        let (nq, gamma) = (q0.len(), method.real.value);
        for k in 0..v0.len() {
            let stages = self.stages.y.iter().zip(d);
            x[k] = h * (gamma * v0[k] + stages.map(|(y, d)| d * y[nq + k]).sum::<f64>());
        }
        self.stages.rotations.combine(h, d, |place| gamma * v0[place], x);
        v.iter_mut().zip(vdot0).for_each(|(v, vdot)| *v = h * gamma * vdot);
        accumulate(v, h, d, &self.stages.unknowns.a);
        accumulate(v, h, d, &self.stages.unknowns.w);
        self.matrix.factors.real.damp(&self.matrix.at, h, x, v, &problem.dynamics)?;
        let (dq, dv) = self.error.split_at_mut(nq);
        problem.dynamics.system.rate(q0, x, dq);
        dv[..v.len()].copy_from_slice(v);
        Ok(from.tolerance.norm_between(from.y, to, &self.error))
    }
}

impl Integrator for RadauIIA {
    fn control(&mut self) -> &mut Control {
        &mut self.order.choice.control
    }

    fn attempt(&mut self, problem: &mut Problem, from: StepStart, to: &mut [f64]) -> Result<Option<f64>, StepError> {
        self.tried = Some(Tried { size: self.size(from.h), monitor: self.matrix.monitor.memory() });
        self.tolerance = if self.is_fixed {
            Tolerance::exact(problem.split(from.y).0, problem.dynamics.system)
        } else {
            internal(from.tolerance, self.order.method().stages())
        };
        let tolerance = self.tolerance;
        let from = StepStart { tolerance: &tolerance, ..from };
        if !std::mem::replace(&mut self.is_begun, true) {
            self.lambda.copy_from_slice(&problem.dynamics.lambda);
        }
        self.matrix.renew(problem, from)?;
        self.matrix.pass_on(self.keeps_matrix());
        if !self.matrix.serves(&problem.dynamics) {
            self.linearize(problem, from)?;
        }
        let mut solved = self.solve(problem, from);
        let is_solved = |solved: &std::result::Result<bool, StepError>| {
            solved.as_ref().map_or_else(StepError::is_fatal, |converged| *converged)
        };
        if !self.matrix.is_fresh && !is_solved(&solved) {
            self.matrix.monitor.reset();
            self.linearize(problem, from)?;
            solved = self.solve(problem, from);
        }
        if !is_solved(&solved) {
            self.order.retry(&self.matrix.monitor, solved.is_ok(), self.stages.turned());
        }
        if !solved? {
            return Err(StepError::NotConverged);
        }
        let s = self.order.method().stages();
        self.order.limit(&self.matrix.monitor, most(s, self.is_fixed), self.stages.turned());
        to.copy_from_slice(&self.stages.y[s - 1]);
        let allowed = self.stages.allowed(&self.dae, problem, from);
        let error = self.estimate(problem, from, to, |method| &method.error)? / allowed;
        let lower = match self.order.methods.len() {
            1 => 0.0,
            _ => self.estimate(problem, from, to, |method| &method.lower_error)? / allowed,
        };
        let is_round_off = error <= 1.0 && error * allowed > 1.0 && !self.matrix.monitor.has_stagnated;
        problem.dynamics.statistics.stagnated += u64::from(is_round_off);
        self.seen = StepMeasures { error, lower, theta: self.matrix.monitor.rate };
        if self.dae.velocity_index() == 2 && (self.is_fixed || error <= 1.0) {
            velocity::project(problem, from.t + from.h, to)?;
            problem.derivative_at_velocity(from.t + from.h, to, &mut self.slope)?;
        }
        Ok(Some(error))
    }

    /// Keeps the stages for the prediction of the next, and M, G, K and C as long as Newton's method contracts well.
    fn accepted(&mut self, step: &Accepted) -> f64 {
        let next = self.order.choice.control.after(step);
        let Some(tried) = self.tried.take() else { return next };
        std::mem::swap(&mut self.before, &mut self.stages.unknowns);
        self.accepted = Some(tried.size);
        self.is_begun = false;
        self.matrix.pass_on(self.matrix.monitor.keeps_matrix());
        self.order.accepted(step.tolerance, &self.seen);
        next
    }

    fn restart(&mut self) {
        (self.tried, self.accepted, self.is_begun) = (None, None, false);
        self.matrix.forget();
    }

    fn last_slope(&self) -> Option<&[f64]> {
        (self.dae.velocity_index() == 2).then_some(&self.slope)
    }

    fn memory(&self) -> Option<Value> {
        let stages = self.order.methods[self.accepted.map_or(0, |step| step.method)].stages();
        let Unknowns { a, lambda, w, u, .. } = &self.before;
        let newton_matrix::Memory { monitor, matrix } = self.matrix.memory();
        let monitor = self.tried.map_or(monitor, |tried| tried.monitor);
        // Matrices of a refused attempt serve on where they hardly change.
        let matrix = matrix.filter(|_| self.keeps_matrix()).map(|saved| SavedMatrix { is_fresh: false, ..saved });
        let used = |rows: &[Vec<f64>]| rows[..stages].to_vec();
        written(RadauMemory {
            choice: self.order.choice,
            accepted: self.accepted,
            stages: [used(a), used(lambda), used(w), used(u)],
            matrix: newton_matrix::Memory { monitor, matrix },
        })
    }

    fn recall(&mut self, memory: &Value) {
        let Some(RadauMemory { choice, accepted, stages, matrix }) = read(memory) else { return };
        let newton_matrix::Memory { monitor, matrix } = matrix;
        let exists = |step: &Size| step.method < self.order.methods.len();
        self.accepted = accepted.filter(exists);
        let matrix = matrix.filter(|saved| exists(&saved.size));
        self.matrix.recall(newton_matrix::Memory { monitor, matrix });
        self.order.recall(choice);
        let Unknowns { a, lambda, w, u, .. } = &mut self.before;
        for (rows, saved) in [a, lambda, w, u].into_iter().zip(&stages) {
            rows.iter_mut().zip(saved).for_each(|(row, saved)| fill(row, saved));
        }
    }

    fn dense(&mut self) -> Option<&mut dyn Dense> {
        Some(self)
    }
}

impl Dense for RadauIIA {
    /// Solves a step of that length; where it does not converge, uses the collocation polynomial, which has order s
    /// only.
    fn interpolate(
        &mut self,
        problem: &mut Problem,
        Step { from, .. }: Step,
        theta: f64,
        out: &mut [f64],
    ) -> Result<(), StepError> {
        let size = self.size(theta * from.h);
        let RadauIIA { dae, order, matrix, row_matrices, stages, row, tolerance, is_fixed, .. } = self;
        let at = &mut matrix.at;
        let method = order.method();
        let from = StepStart { h: size.h, tolerance, ..from };
        row_matrices.factor(size, at, &mut problem.dynamics)?;
        row.unknowns.predict(&stages.unknowns, method, method.nodes.iter().map(|node| theta * node));
        row_matrices.leave_out(&mut row.unknowns);
        let mut system = System { dae, method, at, matrices: row_matrices, stages: row, is_fixed: *is_fixed };
        match system.solve(&mut Monitor::default(), problem, from) {
            Ok(true) => out.copy_from_slice(&row.y[method.stages() - 1]),
            _ => stages.interpolate(method, from, theta, out),
        }
        match dae.velocity_index() {
            2 => velocity::project(problem, from.t + from.h, out),
            _ => Ok(()),
        }
    }
}
