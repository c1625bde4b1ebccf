//! The index-3 augmented Lagrangian method with projections.

mod matrix;

use super::memory::{fill, read, written};
use super::sums::{add, trapezoid};
use super::{Accepted, Control, Integrator, IntegratorEntry, Problem, Setup, StepStart, no_memory, takes};
use crate::error::Result;
use crate::formulation::{ExponentialMap, StepError};
use crate::math::largest;
use crate::math::newton::{Limits, Monitor, relative};
use crate::method_spec::OptionDoc;
use crate::system::{Need, OperatingPoint};
use crate::tolerances;
use matrix::Penalized;
use serde::{Deserialize, Serialize};
use serde_json::Value;

/// ```text
/// q_1 = q + h/2 (v + v_1),  v_1 = v + h/2 (a + a_1),  M a_1 + G^T lambda = f,  phi(q_1) = 0           trapezoidal rule
/// W da = f - M a_1 - G^T (lambda* + alpha phi),  lambda* += alpha phi,  W = M + h/2 C + h^2/4 (K + G^T alpha G)
/// W dv = -h^2/4 G^T alpha (G v_1 + phi_t),  W da = -h^2/4 G^T alpha (G a_1 - gamma)                then projections
/// ```
///
/// Each line is iterated to round-off by the factors of one W, which has the size of M: phi, G v + phi_t and G a -
/// gamma vanish at every step, whatever the penalty. lambda* is changed by the phi that the iteration predicts, and W
/// and alpha phi share their G: so iterations converge as Newton's do, however large alpha is. Source: Bayo, Ledesma,
/// Nonlinear Dyn. 9 (1996) 113-130; Cuadrado, Cardenal, Morer, Bayo, Multibody Syst. Dyn. 4 (2000) 55-73. The rule by
/// itself would give lambda order 1, undamped; the next step starts with a after its projection (least change in the
/// metric of M + h/2 C + h^2/4 K), and lambda is that of the equations of motion at (q, v).
///
/// alpha_j = (4/h^2) penalty / (G diag(M)^-1 G^T)_jj for row j: an iteration reduces the residual of phi to about
/// 1/penalty of it, in any units. (The usual alpha of 1e7 to 1e9 is a penalty of 250 to 25,000 at unit masses and
/// h = 0.01 s.) W is regular where rows of G depend on others, always or at one position: redundant constraints are
/// satisfied, singular positions passed. Rotations advance along the group, first by the predicted change, then by the
/// remaining one.
///
/// Order 2 in q, v and lambda. Cost of a step: W from exact K and C, two or three iterations with an evaluation each, a
/// few more back-substitutions, and the evaluation of lambda. W is symmetric only where K and C are: an LU, dense or
/// sparse by its pattern, in which bodies that share an element are coupled. The work is integrated by the trapezoidal
/// rule. Fixed steps; cubic Hermite interpolation.
pub const ENTRY: IntegratorEntry = IntegratorEntry {
    solves: takes::position_rows,
    options: &[OptionDoc {
        name: "penalty",
        about: "h^2/4 alpha over the mass on a constraint, of which an iteration leaves 1/penalty (default 1e7)",
    }],
    ..IntegratorEntry::new(
        "ali3p",
        "index-3 augmented Lagrangian, projected: holds phi, phi'; redundant and singular G allowed; fixed steps",
        2,
        make,
    )
};

fn make(setup: &Setup) -> Result<Box<dyn Integrator>> {
    let n = setup.system.dimensions();
    let matrix = Penalized::new(setup.integrator.positive("penalty", 1e7)?, setup.system).ok_or_else(no_memory)?;
    let zeros = |n: usize| vec![0.0; n];
    Ok(Box::new(Ali3p {
        matrix,
        is_started: false,
        a: zeros(n.v),
        a_new: zeros(n.v),
        predicted: zeros(n.q),
        lambda: zeros(n.lambda),
        lambda_start: zeros(n.lambda),
        step: zeros(n.v),
        rows: zeros(n.lambda),
        scales: setup.system.facts().scales.clone(),
        retraction: ExponentialMap::new(setup.system),
        slope: zeros(setup.len()),
        control: Control::new(2.0, 0.2, 5.0),
    }))
}

/// What steps pass on, as it is saved: a and lambda* of the last one, if there was one.
#[derive(Serialize, Deserialize)]
struct Ali3pMemory {
    is_started: bool,
    a: Vec<f64>,
    lambda: Vec<f64>,
}

struct Ali3p {
    matrix: Penalized,
    /// True if `a` and lambda* come from the step before.
    is_started: bool,
    a: Vec<f64>,
    a_new: Vec<f64>,
    predicted: Vec<f64>,
    /// lambda*, and its value at the start of the step.
    lambda: Vec<f64>,
    lambda_start: Vec<f64>,
    /// A change of q, v or a.
    step: Vec<f64>,
    rows: Vec<f64>,
    /// Reference values of phi.
    scales: Vec<f64>,
    retraction: ExponentialMap,
    /// y' at the new state.
    slope: Vec<f64>,
    control: Control,
}

/// Limits on changes over their stagnation tolerance.
const LIMITS: Limits = Limits {
    most: tolerances::FIXED_STEP_ITERATIONS,
    tolerance: tolerances::ROUND_OFF_OF_STAGNATION,
    round_off: tolerances::ROUND_OFF_OF_STAGNATION,
    stagnation: 1.0,
    ..Limits::NONE
};
/// Limits on changes relative to the projected quantity: each solution reduces them by the factor 1/penalty.
const PROJECTED: Limits =
    Limits { tolerance: 0.0, round_off: tolerances::ROUNDED_ZERO, stagnation: f64::INFINITY, ..LIMITS };

impl Ali3p {
    /// Starts from a and lambda* of the step before, or else from those of the state.
    fn begin(&mut self, problem: &Problem, from: StepStart) {
        if self.is_started {
            self.a_new.copy_from_slice(&self.a);
            self.lambda.copy_from_slice(&self.lambda_start);
            return;
        }
        self.a.copy_from_slice(problem.split(from.slope).1);
        self.a_new.copy_from_slice(&self.a);
        self.lambda.copy_from_slice(&problem.dynamics.lambda);
    }

    /// q_1 for constant a.
    fn predict(&mut self, problem: &Problem, from: StepStart) {
        let h = from.h;
        let (q0, v0) = problem.split(from.y);
        for (i, v0) in v0.iter().enumerate() {
            self.step[i] = h * v0 + 0.5 * h * h * self.a[i];
        }
        self.retraction.apply(problem.dynamics.system, q0, &self.step, &mut self.predicted);
    }

    /// v_1 and q_1 for the present a_1.
    fn advance(&mut self, problem: &Problem, from: StepStart, to: &mut [f64]) {
        let h = from.h;
        let (_, v0) = problem.split(from.y);
        let (q, v) = problem.split_mut(to);
        for i in 0..v.len() {
            v[i] = v0[i] + 0.5 * h * (self.a[i] + self.a_new[i]);
            self.step[i] = 0.25 * h * h * (self.a_new[i] - self.a[i]);
        }
        self.retraction.apply(problem.dynamics.system, &self.predicted, &self.step, q);
    }

    fn converge(&mut self, problem: &mut Problem, from: StepStart, to: &mut [f64]) -> Result<(), StepError> {
        let h = from.h;
        let t = from.t + h;
        self.predict(problem, from);
        let mut is_factored = false;
        let mut newton = Monitor::default();
        let converged = newton.solve(LIMITS, |renews| {
            self.advance(problem, from, to);
            let (q, v) = problem.split(to);
            problem.dynamics.evaluate(t, q, v, Need::DYNAMICS);
            if renews || !is_factored {
                let at = OperatingPoint { t, q, v, vdot: &self.a_new, lambda: &self.lambda };
                self.matrix.factor(problem, at, h)?;
                is_factored = true;
            }
            let change = self.iterate(problem, h)?;
            let still = 4.0
                * tolerances::ROUND_OFF_OF_SUMS
                * largest(problem.dynamics.system.dimensions().without_turns(q)).max(1.0)
                / (h * h);
            Ok::<_, StepError>(
                change / (tolerances::ROOT_OF_ROUND_OFF * largest(&self.a_new).max(largest(v) / h)).max(still),
            )
        })?;
        problem.dynamics.statistics.stagnated += u64::from(converged && newton.has_stagnated);
        self.advance(problem, from, to);
        if converged { Ok(()) } else { Err(StepError::NotConverged) }
    }

    /// One iteration from the terms at q_1, v_1. Returns the largest change of a_1.
    fn iterate(&mut self, problem: &mut Problem, h: f64) -> Result<f64, StepError> {
        let dynamics = &mut problem.dynamics;
        dynamics.statistics.newton_iterations += 1;
        let terms = &dynamics.terms;
        let structure = &dynamics.structure;
        // Residual of the equations of motion, and phi in units of an acceleration.
        self.step.fill(0.0);
        structure.mass.multiply_symmetric(&terms.mass, &self.a_new, &mut self.step);
        structure.g.multiply_transposed(&terms.g, &self.lambda, &mut self.step);
        self.step.iter_mut().zip(&terms.f).for_each(|(step, f)| *step = f - *step);
        self.rows.iter_mut().zip(&terms.phi).for_each(|(row, phi)| *row = 4.0 / (h * h) * phi);
        self.matrix.solve(&structure.g, &mut self.rows, &mut self.step)?;
        add(&mut self.a_new, &self.step);
        add(&mut self.lambda, &self.rows);
        Ok(largest(&self.step))
    }

    /// Projects v_1 and a_1 to satisfy the constraints at q_1.
    fn project(&mut self, problem: &mut Problem, t: f64, to: &mut [f64]) -> Result<(), StepError> {
        let (q, v) = problem.split_mut(to);
        let need = Need::CONSTRAINTS | Need::G;
        problem.dynamics.evaluate(t, q, v, need);
        let off = problem
            .dynamics
            .terms
            .phi
            .iter()
            .zip(&self.scales)
            .any(|(phi, scale)| phi.abs() > tolerances::ROOT_OF_ROUND_OFF * scale);
        if off {
            return Err(StepError::NotConverged);
        }
        self.meet(problem, v, |problem, j| problem.dynamics.terms.phi_t[j])?;
        problem.dynamics.evaluate(t, q, v, need);
        let mut a = std::mem::take(&mut self.a_new);
        let met = self.meet(problem, &mut a, |problem, j| -problem.dynamics.terms.gamma[j]);
        self.a_new = a;
        met
    }

    /// Solves G x + b = 0 by the least change of x.
    fn meet(&mut self, problem: &Problem, x: &mut [f64], b: impl Fn(&Problem, usize) -> f64) -> Result<(), StepError> {
        let g = &problem.dynamics.structure.g;
        let values = &problem.dynamics.terms.g;
        let met = Monitor::default().solve(PROJECTED, |_| {
            self.rows.iter_mut().enumerate().for_each(|(j, row)| *row = b(problem, j));
            g.multiply(values, x, &mut self.rows);
            self.step.fill(0.0);
            self.matrix.solve(g, &mut self.rows, &mut self.step)?;
            add(x, &self.step);
            Ok::<_, StepError>(relative(&self.step, x))
        })?;
        if met { Ok(()) } else { Err(StepError::NotConverged) }
    }
}

impl Integrator for Ali3p {
    fn control(&mut self) -> &mut Control {
        &mut self.control
    }

    fn attempt(&mut self, problem: &mut Problem, from: StepStart, to: &mut [f64]) -> Result<Option<f64>, StepError> {
        let n = problem.dynamics.system.dimensions();
        let t = from.t + from.h;
        let work = n.q + n.v..;
        self.begin(problem, from);
        self.converge(problem, from, to)?;
        self.project(problem, t, to)?;
        to[work.clone()].copy_from_slice(&from.y[work.clone()]);
        problem.derivative(t, to, &mut self.slope)?;
        trapezoid(from, &self.slope[work], to);
        Ok(None)
    }

    fn last_slope(&self) -> Option<&[f64]> {
        Some(&self.slope)
    }

    fn accepted(&mut self, step: &Accepted) -> f64 {
        self.a.copy_from_slice(&self.a_new);
        self.lambda_start.copy_from_slice(&self.lambda);
        self.is_started = true;
        step.h
    }

    fn restart(&mut self) {
        self.is_started = false;
    }

    fn memory(&self) -> Option<Value> {
        let Ali3p { is_started, a, lambda_start, .. } = self;
        written(Ali3pMemory { is_started: *is_started, a: a.clone(), lambda: lambda_start.clone() })
    }

    fn recall(&mut self, memory: &Value) {
        if let Some(Ali3pMemory { is_started, a, lambda }) = read(memory) {
            self.is_started = is_started;
            fill(&mut self.a, &a);
            fill(&mut self.lambda_start, &lambda);
        }
    }
}
