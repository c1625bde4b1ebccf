//! Diagonally implicit Runge-Kutta methods with an explicit first stage: the step of any tableau.

use super::explicit::widest_gap;
use super::hermite::Hermite;
use super::memory::Reader;
use super::stage::Stage;
use super::sums::combine;
use super::{Control, From, Integrator, Problem, Setup, Tolerance};
use crate::error;
use crate::formulation::StepError;
use crate::math::lagrange;
use crate::tolerances::integrator as tolerances;

/// The constants of a method with the same implicit part gamma = a_ii of all stages but the first, which is explicit,
/// and with the last stage at the end of the step.
pub struct Tableau {
    /// Order p of the solution.
    pub order: usize,
    /// Power of h of the error estimate.
    pub estimate: f64,
    /// Nodes of the stages, from 0 to 1.
    pub c: &'static [f64],
    /// Coefficients a_ij up to the diagonal, one row per stage; the last row is b.
    pub a: &'static [&'static [f64]],
    /// e_i of the error h sum e_i y'_i: b minus the weights of the compared solution.
    pub error: &'static [f64],
}

/// A method of one tableau.
pub struct Esdirk {
    stage: Stage,
    stages: Stages,
    /// Size of the step tried, and whether one was tried from the present start.
    tried: f64,
    is_begun: bool,
    /// Weights of v'_i, by h, in the error of q, along the directions of v.
    of_v: Vec<f64>,
    error_x: Vec<f64>,
    error_v: Vec<f64>,
    error: Vec<f64>,
    control: Control,
    polynomial: Hermite,
}

/// y_i = y + h sum_{j<=i} a_ij y'_j, each with the equations of a [`Stage`].
struct Stages {
    tableau: &'static Tableau,
    /// y'_i of all stages; the first is y' at the start.
    k: Vec<Vec<f64>>,
    /// v' without shifts and lambda of all stages, and those of the step before with its size.
    now: Vec<Guess>,
    before: Vec<Guess>,
    last: Option<f64>,
}

struct Guess {
    a: Vec<f64>,
    lambda: Vec<f64>,
}

/// Number of stages by which the next is predicted.
const POINTS: usize = 3;

impl Stages {
    /// Predicts v' and lambda of stage `i` from the stages before it, and from two of the step before.
    fn predict(&self, stage: &mut Stage, i: usize, h: f64) {
        let c = self.tableau.c;
        let of_now = (0..i).rev().map(|j| (c[j], &self.now[j]));
        let of_before = |last: f64| [c.len() - 2, 0].map(|j| ((c[j] - 1.0) * last / h, &self.before[j]));
        let known = of_now.chain(self.last.into_iter().flat_map(of_before));
        let (mut places, mut guesses) = ([0.0; POINTS], [&self.now[0]; POINTS]);
        let found = known.zip(places.iter_mut().zip(&mut guesses));
        let count = found.map(|(known, (place, guess))| (*place, *guess) = known).count();
        let [a, lambda] = stage.guess();
        for (j, guess) in guesses[..count].iter().enumerate() {
            let weight = lagrange(&places[..count], j, c[i]);
            a.iter_mut().zip(&guess.a).for_each(|(sum, x)| *sum += weight * x);
            lambda.iter_mut().zip(&guess.lambda).for_each(|(sum, x)| *sum += weight * x);
        }
    }

    /// Solves all stages of a step.
    fn solve(
        &mut self,
        stage: &mut Stage,
        problem: &mut Problem,
        tolerance: &Tolerance,
        from: From,
        h: f64,
    ) -> Result<(), StepError> {
        let Tableau { a, c, .. } = self.tableau;
        let g = h * a[1][1];
        let [vdot, lambda] = stage.guess();
        vdot.copy_from_slice(&self.now[0].a);
        lambda.copy_from_slice(&self.now[0].lambda);
        stage.factor(problem, (from.t, from.y), (from, h), g)?;
        for i in 1..c.len() {
            combine(&mut stage.known, from.y, h, &a[i][..i], &self.k);
            self.predict(stage, i, h);
            stage.solve(problem, tolerance, from, from.t + c[i] * h, g)?;
            self.k[i].copy_from_slice(&stage.rate);
            self.now[i].a.copy_from_slice(&stage.unknowns.a);
            self.now[i].lambda.copy_from_slice(&stage.unknowns.lambda);
        }
        Ok(())
    }
}

impl Esdirk {
    /// Memory for the system and the formulation of `setup`.
    pub fn new(tableau: &'static Tableau, setup: &Setup) -> error::Result<Self> {
        let n = setup.system.dimensions();
        let zeros = |n: usize| vec![0.0; n];
        let guesses = || tableau.c.iter().map(|_| Guess { a: zeros(n.v), lambda: zeros(n.lambda) }).collect();
        let of_v = |j: usize| tableau.a.iter().zip(tableau.error).map(|(row, e)| e * row.get(j).unwrap_or(&0.0)).sum();
        let mut control = Control::holding(tableau.estimate, 0.2, 5.0, tolerances::STAGE_HOLD);
        control.safety = tolerances::STAGE_SAFETY;
        let k = tableau.c.iter().map(|_| zeros(setup.len())).collect();
        let mut stage = Stage::new(setup)?;
        // What an iteration leaves of G v is divided by the step in the accelerations of the next one, by which its
        // error is estimated: where a first change that vanishes at once hid a slow rate, steps shrank without end.
        stage.least_rate = tolerances::RADAU_LEAST_RATE;
        Ok(Esdirk {
            stage,
            stages: Stages { tableau, k, now: guesses(), before: guesses(), last: None },
            tried: 0.0,
            is_begun: false,
            of_v: (0..tableau.c.len()).map(of_v).collect(),
            error_x: zeros(n.v),
            error_v: zeros(n.v),
            error: zeros(setup.len()),
            control,
            polynomial: Hermite::new(setup.len(), 0),
        })
    }

    /// The error of the tableau, damped along the stiff directions, over the tolerated errors; without the shifts,
    /// which the first stage does not have and the others have with an order less.
    fn estimate(
        &mut self,
        problem: &Problem,
        tolerance: &Tolerance,
        from: From,
        h: f64,
        to: &[f64],
    ) -> Result<f64, StepError> {
        let Esdirk { stage, stages, error_x, error_v, error, of_v, .. } = self;
        let (Stages { tableau, now, .. }, n) = (stages, problem.dynamics.system.dimensions());
        for (out, weights, factor) in [(&mut *error_x, &of_v[..], h * h), (&mut *error_v, tableau.error, h)] {
            out.fill(0.0);
            for (weight, Guess { a, .. }) in weights.iter().zip(&*now) {
                out.iter_mut().zip(a).for_each(|(out, a)| *out += factor * weight * a);
            }
        }
        stage.damp(h, error_x, error_v, problem)?;
        let (q0, _) = problem.split(from.y);
        let (dq, dv) = error.split_at_mut(n.q);
        problem.dynamics.system.rate(q0, error_x, dq);
        dv[..n.v].copy_from_slice(error_v);
        Ok(tolerance.norm_between(from.y, to, error))
    }
}

impl Integrator for Esdirk {
    fn order(&self) -> usize {
        self.stages.tableau.order
    }

    fn control(&mut self) -> &mut Control {
        &mut self.control
    }

    fn attempt(
        &mut self,
        problem: &mut Problem,
        tolerance: &Tolerance,
        from: From,
        h: f64,
        to: &mut [f64],
    ) -> Result<Option<f64>, StepError> {
        let Esdirk { stage, stages, .. } = self;
        if !std::mem::replace(&mut self.is_begun, true) {
            stages.k[0].copy_from_slice(from.slope);
            stages.now[0].a.copy_from_slice(problem.split(from.slope).1);
            stages.now[0].lambda.copy_from_slice(&problem.dynamics.lambda);
        }
        self.tried = h;
        stage.attempt(problem, from, |stage, problem| stages.solve(stage, problem, tolerance, from, h))?;
        to.copy_from_slice(&stage.y);
        Ok(Some(self.estimate(problem, tolerance, from, h, to)?))
    }

    fn accepted(&mut self, _: &Tolerance) {
        std::mem::swap(&mut self.stages.now, &mut self.stages.before);
        self.stages.last = Some(self.tried);
        self.is_begun = false;
        self.stage.accepted();
    }

    fn restart(&mut self) {
        self.stages.last = None;
        self.is_begun = false;
        self.stage.restart();
    }

    fn spacing(&self) -> f64 {
        widest_gap(self.stages.tableau.c).0
    }

    fn memory(&self) -> Option<Vec<f64>> {
        let mut memory = vec![self.stages.last.unwrap_or(0.0)];
        self.stages.before.iter().for_each(|Guess { a, lambda }| memory.extend(a.iter().chain(lambda)));
        memory.extend(self.stage.memory());
        Some(memory)
    }

    fn recall(&mut self, memory: &[f64]) {
        let mut memory = Reader(memory);
        self.stages.last = Some(memory.number()).filter(|last| *last > 0.0);
        for Guess { a, lambda } in &mut self.stages.before {
            memory.fill(a);
            memory.fill(lambda);
        }
        self.stage.recall(memory);
    }

    fn polynomial(&mut self) -> Option<&mut Hermite> {
        Some(&mut self.polynomial)
    }
}
