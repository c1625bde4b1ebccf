//! Backward differentiation formulas.

mod history;
mod order;
mod stage;

use super::memory::{read, written};
use super::newton_matrix;
use super::{
    Accepted, Control, Dense, Integrator, IntegratorEntry, Problem, Setup, Step, StepStart, Steps, Tightening, refuses,
    takes,
};
use crate::error;
use crate::formulation::StepError;
use history::History;
use order::Order;
use serde::{Deserialize, Serialize};
use serde_json::Value;
use stage::Stage;

/// Error of a step of bdf that is round-off, over that of one state. Unit: `[1]`. Why: weights of extrapolation over
/// six states of unequal distances come to some hundred, and a sixth of that, sixteen ulps each, is in the error. Test:
/// `the_tightest_tolerance`.
const BDF_ROUND_OFF: f64 = 30.0;

/// ```text
/// x'_1 = x'_P + (alpha/h) (x_1 - x_P),   alpha = 1 + 1/2 + ... + 1/k,   x'_1 = F(t_1, x_1)
/// ```
///
/// with the polynomial x_P through the last k + 1 states, at t_1: the backward differentiation formula of order k = 1
/// to 5 with a fixed leading coefficient, k and h chosen by the error. Source: Brenan, Campbell, Petzold, Numerical
/// Solution of Initial-Value Problems in Differential-Algebraic Equations (1996), chapter 5, as in DASSL and IDA. Order
/// in q, v and lambda: 5 where tolerances are tight. With `ggl` phi and G v + phi_t vanish to the tolerance of Newton's
/// iteration, a hundredth of the error tolerance, and the motion is one or two digits better than with `index1`.
///
/// For smooth stiff motions: two or three evaluations a step, and a matrix (n_v + n_c unknowns, dense or sparse, from
/// exact K, C, G and L) that is kept while Newton's method converges. Orders 3 to 5 are not stable for fast undamped
/// oscillations, which are then followed in tiny steps: use `esdirk34` or `generalized_alpha` there. Projections are
/// refused: after a projection the past states do not fit, and the order would fall to 1 at every step. Interpolation
/// by the polynomial of the step.
pub const ENTRY: IntegratorEntry = IntegratorEntry {
    steps: Steps::Own,
    // At order 5, which tight tolerances select; errors over a motion were 9 rtol^(5/6) on long ones.
    tightening: Tightening::new(0.07, 1.2),
    solves: takes::accelerations_or_positions,
    refuses: refuses::all,
    begins_anew: true,
    ..IntegratorEntry::new(
        "bdf",
        "implicit, order 1 to 5 by itself, for stiff motions that are smooth; chooses its steps",
        5,
        make,
    )
};

fn make<'s>(setup: &Setup<'_, 's>) -> error::Result<Box<dyn Integrator + 's>> {
    let zeros = || vec![0.0; setup.len()];
    Ok(Box::new(Bdf {
        stage: Stage::new(setup)?,
        history: History::new(setup.len(), setup.system.dimensions().lambda),
        order: Order::new(),
        is_begun: false,
        predicted: zeros(),
        rate: zeros(),
        change: zeros(),
        step: (0.0, 1),
        end: zeros(),
    }))
}

struct Bdf {
    stage: Stage,
    history: History,
    order: Order,
    /// True if a step was tried from the present start.
    is_begun: bool,
    /// x_P and x'_P
    predicted: Vec<f64>,
    rate: Vec<f64>,
    change: Vec<f64>,
    /// Time at the end of the last attempt, its order, and the state there.
    step: (f64, usize),
    end: Vec<f64>,
}

/// What steps pass on, as it is saved.
#[derive(Serialize, Deserialize)]
struct BdfMemory {
    is_begun: bool,
    order: Order,
    history: history::HistoryMemory,
    stage: newton_matrix::Memory,
}

/// Error of a step over the distance to the prediction: of the formula or, if it is larger, of the interpolation.
/// Source: Brenan, Campbell, Petzold, (5.2.13).
fn error_constant(history: &History, k: usize, t: f64, h: f64) -> f64 {
    let ratio = |i: usize| h / history.age(i, t);
    let leading: f64 = (1..=k).map(|j| 1.0 / j as f64).sum();
    let variable: f64 = (0..k).map(ratio).sum();
    (ratio(k) + variable - leading).abs().max(ratio(k))
}

impl Integrator for Bdf {
    fn control(&mut self) -> &mut Control {
        &mut self.order.control
    }

    fn attempt(&mut self, problem: &mut Problem, from: StepStart, to: &mut [f64]) -> Result<Option<f64>, StepError> {
        let StepStart { h, tolerance, .. } = from;
        let Bdf { stage, history, order, predicted, rate, change, .. } = self;
        if std::mem::replace(&mut self.is_begun, true) {
            // The time loop may have moved the start.
            history.replace(from);
        } else {
            history.add(from, &problem.dynamics.lambda);
        }
        let k = order.k;
        let t = from.t + h;
        let g = h / (1..=k).map(|j| 1.0 / j as f64).sum::<f64>();
        history.predict(k, t, predicted, rate);
        stage.attempt(problem, from, |stage, problem| {
            stage
                .known
                .iter_mut()
                .zip(predicted.iter().zip(&*rate))
                .for_each(|(known, (x, rate))| *known = x - g * rate);
            let [a, lambda] = stage.guess();
            a.copy_from_slice(problem.split(rate).1);
            history.predict_lambda(k, t, lambda);
            stage.factor(problem, t, predicted, from, g)?;
            stage.solve(problem, from, t, g)
        })?;
        to.copy_from_slice(&stage.y);
        change.iter_mut().zip(to.iter().zip(&*predicted)).for_each(|(change, (to, x))| *change = to - x);
        // Extrapolation magnifies the rounding of the past states, which no shorter step reduces.
        let allowed = 1.0 + BDF_ROUND_OFF * stage.round_off;
        let estimate = error_constant(history, k, t, h) * tolerance.norm_between(from.y, to, change);
        let error = estimate / allowed;
        problem.dynamics.statistics.stagnated += u64::from(estimate > 1.0 && error <= 1.0);
        let mut term = |j: usize| match j {
            _ if j == 0 || j > history.known() => f64::INFINITY,
            _ => history.derivative(j - 1, t, h, tolerance, to, change) / allowed,
        };
        order.tried(error, [term(k - 1), term(k), term(k + 1), term(k + 2)]);
        self.step = (t, k);
        Ok(Some(error))
    }

    fn accepted(&mut self, step: &Accepted) -> f64 {
        self.is_begun = false;
        let matrix = &mut self.stage.matrix;
        matrix.pass_on(matrix.monitor.keeps_matrix());
        self.order.propose(step.h, step.growing, self.history.known() + 1)
    }

    fn restart(&mut self) {
        self.is_begun = false;
        self.history.restart();
        self.order.restart();
        self.stage.matrix.forget();
    }

    fn memory(&self) -> Option<Value> {
        let Bdf { is_begun, order, history, stage, .. } = self;
        let order = order.clone();
        written(BdfMemory { is_begun: *is_begun, order, history: history.memory(), stage: stage.matrix.memory() })
    }

    fn recall(&mut self, memory: &Value) {
        if let Some(BdfMemory { is_begun, order, history, stage }) = read(memory) {
            self.is_begun = is_begun;
            self.order = order.bounded();
            self.history.recall(history);
            self.stage.matrix.recall(stage);
        }
    }

    fn dense(&mut self) -> Option<&mut dyn Dense> {
        Some(self)
    }
}

impl Dense for Bdf {
    /// The step may have been cut on its dense output since the attempt.
    fn prepare(&mut self, _: &mut Problem, step: Step) -> Result<(), StepError> {
        self.step.0 = step.from.t + step.from.h;
        self.end.copy_from_slice(step.to);
        Ok(())
    }

    fn interpolate(&mut self, _: &mut Problem, step: Step, theta: f64, out: &mut [f64]) -> Result<(), StepError> {
        let (end, k) = self.step;
        self.history.interpolate(k, end, &self.end, step.from.t + theta * step.from.h, out);
        Ok(())
    }
}
