//! The implicit equations of a step.

use crate::error;
use crate::formulation::{self, Change, Dae, Dynamics, Iteration, Linearized, Residual, Slopes, StepError};
use crate::integrator::newton_matrix::{Factors, NewtonMatrix, Size};
use crate::integrator::sums::add;
use crate::integrator::{Problem, Setup, StepStart, no_memory, round_off};
use crate::math::kkt::Singular;
use crate::math::newton::Limits;
use crate::system::{Dimensions, OperatingPoint};
use crate::tolerances;

/// ```text
/// v = v* + g (a + w),   q = q* + g N (v + u),   M a + G^T lambda = f
/// ```
///
/// with the rows of the formulation's [`Dae`], its shifts u and w, and g = h/alpha. q and v are eliminated: Newton's
/// method has one matrix of n_v + n_c unknowns, dense or sparse, from exact K, C, G and L. It is kept while it
/// converges. One evaluation and a back-substitution an iteration, with shifts one more each.
pub struct Stage {
    dae: Dae,
    n: Dimensions,
    /// y*, the part of (q, v, work) that is known.
    pub known: Vec<f64>,
    /// y and y' as far as they are found.
    pub y: Vec<f64>,
    pub rate: Vec<f64>,
    /// The unknowns; on entry of a solution their first guess.
    pub unknowns: Change<f64>,
    residual: Residual,
    pub matrix: NewtonMatrix<StageMatrix>,
    /// Round-off of y in the last solution, over the tolerated errors.
    pub round_off: f64,
    change: Vec<f64>,
    /// v + u
    velocity: Vec<f64>,
}

/// The matrix for v = v* + g (a + w), q = q* + g N (v + u).
pub struct StageMatrix(Iteration<f64>);

impl Factors for StageMatrix {
    const BAND: f64 = 1.1;

    fn metric(&self, Size { h: g, .. }: Size) -> f64 {
        g * g
    }

    fn factor(&mut self, Size { h: g, .. }: Size, at: &Linearized, dynamics: &mut Dynamics) -> Result<(), Singular> {
        self.0.factor(Slopes::implicit(g), at, dynamics)
    }

    fn rescale(&mut self, Size { h: g, .. }: Size) {
        self.0.rescale(Slopes::implicit(g));
    }
}

impl Stage {
    /// Memory for a system.
    pub fn new(setup: &Setup) -> error::Result<Self> {
        let n = setup.system.dimensions();
        let dae = setup.dae()?;
        let matrix = Iteration::new(dae, setup.system).ok_or_else(no_memory)?;
        let zeros = |n: usize| vec![0.0; n];
        Ok(Stage {
            dae,
            n,
            known: zeros(setup.len()),
            y: zeros(setup.len()),
            rate: zeros(setup.len()),
            unknowns: Change {
                a: zeros(n.v),
                lambda: zeros(n.lambda),
                w: zeros(n.v),
                u: zeros(n.v),
                eta: zeros(n.lambda),
                mu: zeros(n.lambda),
            },
            residual: Residual::new(n),
            matrix: NewtonMatrix::new(dae, setup.system, StageMatrix(matrix)),
            round_off: 0.0,
            change: zeros(setup.len()),
            velocity: zeros(n.v),
        })
    }

    /// Solves a step by `solve`, with the matrix of a step before, if there is one, and again with a new one where that
    /// fails.
    pub fn attempt(
        &mut self,
        problem: &mut Problem,
        from: StepStart,
        mut solve: impl FnMut(&mut Self, &mut Problem) -> Result<(), StepError>,
    ) -> Result<(), StepError> {
        self.matrix.renew(problem, from)?;
        let is_old = self.matrix.serves(&problem.dynamics) && !self.matrix.is_fresh;
        let mut solved = solve(self, problem);
        if is_old && solved.as_ref().is_err_and(|halt| !halt.is_fatal()) {
            self.matrix.forget();
            self.matrix.monitor.reset();
            solved = solve(self, problem);
        }
        if solved.is_err() {
            self.matrix.forget();
        }
        solved
    }

    /// Sets all unknowns to zero, and returns v' and lambda for a first guess.
    pub fn guess(&mut self) -> [&mut [f64]; 2] {
        let Change { a, lambda, w, u, eta, mu } = &mut self.unknowns;
        [&mut *a, &mut *lambda, w, u, eta, mu].into_iter().for_each(|unknowns| unknowns.fill(0.0));
        [a, lambda]
    }

    /// Factors the matrix for `g`, from the present M, G, L, K and C or, if there are none, those of a state with the
    /// first guess of v' and lambda.
    pub fn factor(
        &mut self,
        problem: &mut Problem,
        t: f64,
        y: &[f64],
        from: StepStart,
        g: f64,
    ) -> Result<(), StepError> {
        if !self.matrix.serves(&problem.dynamics) {
            let (q, v) = problem.split(y);
            let Change { a, lambda, .. } = &self.unknowns;
            self.matrix.linearize(OperatingPoint { t, q, v, vdot: a, lambda }, &mut problem.dynamics)?;
        }
        self.matrix.factor(problem, from, Size { h: g, method: 0 })
    }

    /// Solves the stage at `t` by Newton's method, whose matrix is factored.
    pub fn solve(&mut self, problem: &mut Problem, from: StepStart, t: f64, g: f64) -> Result<(), StepError> {
        let tolerance = from.tolerance;
        self.leave_out();
        self.y.copy_from_slice(&self.known);
        self.advance(problem, g);
        self.round_off = round_off(problem, tolerance, from.y, None, &mut self.change);
        let limits = Limits {
            // More cost as much as a shorter step.
            most: 7,
            // What is left of the constraints is drift.
            tolerance: 0.01,
            round_off: self.round_off,
            stagnation: tolerances::RADAU_STAGNATION * self.round_off,
            // An iteration more costs an evaluation, a matrix about four.
            kept_rate: 0.1,
            ..Limits::NONE
        };
        let mut monitor = std::mem::take(&mut self.matrix.monitor);
        let converged = monitor.solve(limits, |_| {
            self.correct(problem, t, g)?;
            Ok::<_, StepError>(tolerance.norm(from.y, &self.change))
        });
        let has_stagnated = monitor.has_stagnated;
        self.matrix.monitor = monitor;
        // Slow convergence with a matrix of a step before looks like round-off, too.
        let is_slow = has_stagnated && !self.matrix.is_fresh;
        if !converged? || is_slow {
            return Err(StepError::NotConverged);
        }
        problem.dynamics.statistics.stagnated += u64::from(has_stagnated);
        self.add_work(problem, g);
        Ok(())
    }

    /// One correction; `change` is that of y.
    fn correct(&mut self, problem: &mut Problem, t: f64, g: f64) -> Result<(), StepError> {
        let Stage { dae, residual, matrix, unknowns, .. } = self;
        let Change { a, lambda, w, u, eta, mu } = unknowns;
        let (q, v) = problem.split(&self.y);
        let stiffness = matrix.at.stiffness();
        let guess = formulation::Unknowns { a, lambda, w, eta, u, mu, stiffness };
        residual.evaluate(dae, t, q, v, guess, &mut problem.dynamics)?;
        problem.dynamics.statistics.newton_iterations += 1;
        let StageMatrix(iteration) = &mut matrix.factors;
        iteration.load(std::iter::once((1.0, &*residual)));
        iteration.solve(&mut matrix.at, &problem.dynamics.structure)?;
        let by = &iteration.change;
        let pairs = [(a, &by.a), (lambda, &by.lambda), (w, &by.w), (u, &by.u), (eta, &by.eta), (mu, &by.mu)];
        pairs.into_iter().for_each(|(sum, by)| add(sum, by));
        self.change.copy_from_slice(&self.y);
        self.advance(problem, g);
        self.change.iter_mut().zip(&self.y).for_each(|(change, y)| *change = y - *change);
        Ok(())
    }

    /// q and v for the present unknowns. Where N depends on q, q is found by sweeps from its last value, each of which
    /// reduces its error by g |omega|/2.
    fn advance(&mut self, problem: &Problem, g: f64) {
        let Stage { n, known, y, rate, unknowns: Change { a, w, u, .. }, velocity, .. } = self;
        let motion = n.q + n.v;
        let (q, v) = y[..motion].split_at_mut(n.q);
        let (qdot, vdot) = rate[..motion].split_at_mut(n.q);
        vdot.copy_from_slice(a);
        add(vdot, w);
        v.iter_mut().zip(known[n.q..].iter().zip(&*vdot)).for_each(|(v, (known, rate))| *v = known + g * rate);
        velocity.copy_from_slice(v);
        add(velocity, u);
        let sweeps = if n.q == n.moving() { 1 } else { tolerances::RADAU_SWEEPS };
        for _ in 0..sweeps {
            problem.dynamics.system.rate(q, velocity, qdot);
            q.iter_mut().zip(known.iter().zip(&*qdot)).for_each(|(q, (known, rate))| *q = known + g * rate);
        }
    }

    /// The work, from the terms of the last evaluation and the lambda corrected since: where drivers leave nothing to
    /// the error test, one correction of lambda may be large.
    fn add_work(&mut self, problem: &Problem, g: f64) {
        let first = self.n.q + self.n.v;
        let powers = problem.dynamics.powers(&self.unknowns.lambda);
        self.rate[first..].iter_mut().zip(powers).for_each(|(rate, power)| *rate = power);
        for i in first..self.y.len() {
            self.y[i] = self.known[i] + g * self.rate[i];
        }
    }

    /// Sets the multipliers of rows that are dropped from the matrix to zero, since no correction reaches them.
    fn leave_out(&mut self) {
        let rows = self.matrix.factors.0.matrix.left_out();
        let dropped = self.unknowns.lambda.iter_mut().zip(rows).filter(|(_, is_out)| **is_out);
        dropped.for_each(|(lambda, _)| *lambda = 0.0);
    }
}
