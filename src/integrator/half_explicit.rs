//! Half-explicit Runge-Kutta methods: the step of any tableau.

use super::explicit::Tableau as Explicit;
use super::hermite::Hermite;
use super::sums::{add, combine};
use super::{Control, Dense, Integrator, Problem, Setup, Stability, Step, StepStart, no_memory};
use crate::error::Result;
use crate::formulation::{Dynamics, StepError};
use crate::math::kkt::{Pattern, Singular, Unsymmetric};
use crate::math::newton::{Limits, Monitor};
use crate::math::{all_finite, largest};
use crate::system::Need;
use crate::tolerances;
use serde_json::Value;

/// Order of the rows of the cubic, whose error over a step is O(h^4).
const CUBIC: usize = 4;

/// Corrections of a stage, relative to its acceleration. Ten cost as much as a factorization; those that leave more
/// than a tenth would take more.
const CORRECTIONS: Limits = Limits {
    most: 10,
    round_off: f64::EPSILON,
    stagnation: tolerances::ROUND_OFF_OF_SOLUTIONS,
    contraction: 0.1,
    ..Limits::NONE
};

/// The constants of a half-explicit method.
pub struct Tableau {
    pub order: usize,
    /// The explicit tableau of partitioned methods, whose first stage is y' at the start and whose error estimate is
    /// used; without it stage i + 1 is the point at which the constraint of stage i is satisfied.
    pub explicit: Option<&'static Explicit>,
    /// Row i, with i + 1 entries, gives the point at which the constraint of stage i is satisfied; the last row is b.
    pub constraint: &'static [&'static [f64]],
    /// Nodes of those rows.
    pub nodes: &'static [f64],
    pub control: fn() -> Control,
}

impl Tableau {
    /// Stability region: along the free directions the stages are those of an explicit method.
    pub fn stability(&self) -> Stability {
        Stability::of(|i| self.stage(i).0, self.last())
    }

    /// Row and node of the stage itself.
    fn stage(&self, i: usize) -> (&'static [f64], f64) {
        match (self.explicit, i) {
            (Some(explicit), _) => (explicit.a[i], explicit.c[i]),
            (None, 0) => (&[], 0.0),
            (None, _) => (self.constraint[i - 1], self.nodes[i - 1]),
        }
    }

    fn last(&self) -> &'static [f64] {
        self.constraint[self.constraint.len() - 1]
    }
}

/// Stage i, with P_i = q + h sum_{j <= i} abar_ij N(Q_j) V_j:
///
/// ```text
/// Q_i = q + h sum_{j < i} a_ij N(Q_j) V_j,    V_i = v + h sum_{j < i} a_ij V'_j
/// [ M(Q_i)  G(Q_i)^T ] [ V'_i     ]   [ f(Q_i, V_i)                                                        ]
/// [ G(P_i)  0        ] [ lambda_i ] = [ -(G(P_i) (v + h sum_{j < i} abar_ij V'_j) + phi_t(P_i)) / (h abar_ii) ]
/// ```
///
/// The work is a quadrature by the same weights, with the stages' own multipliers.
pub struct HalfExplicit {
    tableau: &'static Tableau,
    /// Slopes of all stages, and y' at the new state.
    k: Vec<Vec<f64>>,
    stage: Vec<f64>,
    lambda: Vec<f64>,
    /// f of the stage
    force: Vec<f64>,
    /// phi_t of the stage, and the rate of the constraint that the acceleration must produce.
    phi_t: Vec<f64>,
    rate: Vec<f64>,
    /// What the acceleration misses of it.
    missed: Vec<f64>,
    /// Error of q, v and w, and its part in v normal to the manifold.
    error: Vec<f64>,
    off: Vec<f64>,
    matrix: Unsymmetric<f64>,
    /// G of the stage.
    g: Vec<f64>,
    control: Control,
    /// The quartic of methods whose order is above that of the cubic.
    polynomial: Hermite,
}

impl HalfExplicit {
    pub fn new(tableau: &'static Tableau, setup: &Setup) -> Result<Self> {
        let n = setup.system.dimensions();
        let len = setup.len();
        let structure = setup.system.structure();
        let zeros = |n: usize| vec![0.0; n];
        let none = Pattern { rows: n.v, cols: n.v, entries: Vec::new() };
        let matrix = Unsymmetric::new(&structure.mass, &none, &structure.g);
        Ok(HalfExplicit {
            tableau,
            control: (tableau.control)(),
            k: vec![zeros(len); tableau.constraint.len() + 1],
            stage: zeros(len),
            lambda: zeros(n.lambda),
            force: zeros(n.v),
            phi_t: zeros(n.lambda),
            rate: zeros(n.lambda),
            missed: zeros(n.lambda),
            error: zeros(len),
            off: zeros(n.v),
            matrix: matrix.ok_or_else(no_memory)?,
            g: zeros(structure.g.entries.len()),
            polynomial: Hermite::new(len, 1),
        })
    }

    /// k_i = (N V, V', power) of stage `i`.
    fn evaluate(&mut self, problem: &mut Problem, i: usize, from: StepStart) -> Result<(), StepError> {
        let h = from.h;
        let (row, node) = self.tableau.stage(i);
        combine(&mut self.stage, from.y, h, row, &self.k);
        is_finite(&self.stage)?;
        let (q, v) = problem.split(&self.stage);
        let n = problem.dynamics.system.dimensions();
        let dynamics = &mut problem.dynamics;
        dynamics.statistics.rhs_evaluations += 1;
        dynamics.evaluate(from.t + node * h, q, v, Need::DYNAMICS);
        dynamics.factor()?;
        self.phi_t.copy_from_slice(&dynamics.terms.phi_t);
        self.lambda.copy_from_slice(&dynamics.terms.gamma);
        self.g.copy_from_slice(&dynamics.terms.g);
        let (qdot, rest) = self.k[i].split_at_mut(n.q);
        dynamics.system.rate(q, v, qdot);
        // The row of the constraint sums the accelerations before V'_i.
        rest.fill(0.0);
        rest[n.v..].iter_mut().zip(dynamics.powers(&[])).for_each(|(rate, power)| *rate = power);
        self.force.copy_from_slice(&dynamics.terms.f);
        self.solve(problem, i, from)?;
        let moving: f64 = self.lambda.iter().zip(&self.phi_t).map(|(lambda, phi_t)| lambda * phi_t).sum();
        self.k[i][n.q + n.v] += moving;
        Ok(())
    }

    /// Solves for V'_i and lambda_i; on entry k_i is N V and zeros, `force` f, `lambda` the guess gamma, and M and
    /// G(Q_i) are factored.
    fn solve(&mut self, problem: &mut Problem, i: usize, from: StepStart) -> Result<(), StepError> {
        let h = from.h;
        let row = self.tableau.constraint[i];
        let n = problem.dynamics.system.dimensions();
        combine(&mut self.stage, from.y, h, row, &self.k);
        let dynamics = &mut problem.dynamics;
        let (q, v) = self.stage.split_at_mut(n.q);
        dynamics.system.normalize(q);
        dynamics.evaluate(from.t + self.tableau.nodes[i] * h, q, &v[..n.v], Need::CONSTRAINTS | Need::G);
        let factor = -1.0 / (h * row[i]);
        self.rate.iter_mut().zip(&dynamics.terms.phi_dot).for_each(|(rate, phi_dot)| *rate = factor * phi_dot);
        if !self.correct(dynamics, i)? {
            self.factor(dynamics, i).map_err(apart)?;
        }
        is_finite(&self.k[i][n.q..n.q + n.v])
    }

    /// Solves with the factors of M and G(Q_i), and again for what G(P_i) V'_i misses: G(P_i) - G(Q_i) = O(h) of it is
    /// left each time. False where that does not reach round-off, as in long steps.
    fn correct(&mut self, dynamics: &mut Dynamics, i: usize) -> Result<bool, Singular> {
        let n = dynamics.system.dimensions();
        let vdot = &mut self.k[i][n.q..n.q + n.v];
        vdot.copy_from_slice(&self.force);
        dynamics.kkt.solve(vdot, &mut self.lambda)?;
        Monitor::default().solve(CORRECTIONS, |_| {
            self.missed.fill(0.0);
            dynamics.structure.g.multiply(&dynamics.terms.g, vdot, &mut self.missed);
            self.missed.iter_mut().zip(&self.rate).for_each(|(missed, rate)| *missed = rate - *missed);
            self.off.fill(0.0);
            dynamics.kkt.solve(&mut self.off, &mut self.missed)?;
            add(vdot, &self.off);
            add(&mut self.lambda, &self.missed);
            Ok(largest(&self.off) / largest(vdot).max(f64::MIN_POSITIVE))
        })
    }

    /// Solves with a factorization of its own, ten times the work of a solution above; rows that are dependent in M and
    /// G(Q_i) are dropped.
    fn factor(&mut self, dynamics: &Dynamics, i: usize) -> Result<(), Singular> {
        let n = dynamics.system.dimensions();
        self.matrix.drop_rows(dynamics.kkt.left_out());
        self.matrix.clear();
        self.matrix.see_mass(&dynamics.structure.mass, &dynamics.terms.mass);
        self.matrix.add(&dynamics.structure.mass, &dynamics.terms.mass, 1.0, true);
        self.matrix.couple(&dynamics.terms.g, |_| 1.0);
        self.matrix.couple(&self.g, |_| -1.0);
        self.matrix.factor(&dynamics.structure.g, &self.g)?;
        let vdot = &mut self.k[i][n.q..n.q + n.v];
        vdot.copy_from_slice(&self.force);
        self.lambda.copy_from_slice(&self.rate);
        self.matrix.solve(vdot, &mut self.lambda)
    }

    /// Sets the error to h sum_i e_i k_i, its velocities projected on the tangent space at the new state: the
    /// multipliers of stages are less accurate than their motion. The factors of the new state are in the problem.
    fn estimate(&mut self, problem: &mut Problem, weights: &[f64], h: f64) -> Result<(), StepError> {
        let n = problem.dynamics.system.dimensions();
        self.stage.fill(0.0);
        combine(&mut self.error, &self.stage, h, weights, &self.k);
        let dynamics = &mut problem.dynamics;
        let dv = &mut self.error[n.q..n.q + n.v];
        self.rate.fill(0.0);
        dynamics.structure.g.multiply(&dynamics.terms.g, dv, &mut self.rate);
        dynamics.kkt.solve_projection(&self.rate, &mut self.off)?;
        dv.iter_mut().zip(&self.off).for_each(|(dv, off)| *dv -= off);
        Ok(())
    }
}

/// G(Q_i) alone gives a regular matrix.
fn apart(singular: Singular) -> Singular {
    if singular == Singular::Collapsed { Singular::Apart } else { singular }
}

fn is_finite(y: &[f64]) -> Result<(), StepError> {
    if all_finite(y) { Ok(()) } else { Err(StepError::NotFinite) }
}

impl Integrator for HalfExplicit {
    fn control(&mut self) -> &mut Control {
        &mut self.control
    }

    /// A step knows its start alone.
    fn memory(&self) -> Option<Value> {
        Some(Value::Array(Vec::new()))
    }

    fn attempt(&mut self, problem: &mut Problem, from: StepStart, to: &mut [f64]) -> Result<Option<f64>, StepError> {
        self.k[0].copy_from_slice(from.slope);
        let first = usize::from(self.tableau.explicit.is_some());
        for i in first..self.tableau.constraint.len() {
            self.evaluate(problem, i, from)?;
        }
        combine(to, from.y, from.h, self.tableau.last(), &self.k);
        problem.dynamics.system.normalize(problem.split_mut(to).0);
        let Some(weights) = self.tableau.explicit.and_then(Explicit::embedded) else { return Ok(None) };
        problem.derivative(from.end, to, &mut self.k[self.tableau.constraint.len()])?;
        self.estimate(problem, weights, from.h)?;
        Ok(Some(from.tolerance.norm_between(from.y, to, &self.error)))
    }

    fn last_slope(&self) -> Option<&[f64]> {
        self.tableau.explicit.map(|_| &self.k[self.tableau.constraint.len()][..])
    }

    fn dense(&mut self) -> Option<&mut dyn Dense> {
        if self.tableau.order > CUBIC { Some(self) } else { None }
    }
}

impl Dense for HalfExplicit {
    fn prepare(&mut self, problem: &mut Problem, step: Step) -> Result<(), StepError> {
        self.polynomial.prepare(step);
        self.polynomial.raise(problem, step, &mut self.stage, &mut self.error)
    }

    fn interpolate(&mut self, _: &mut Problem, step: Step, theta: f64, out: &mut [f64]) -> Result<(), StepError> {
        self.polynomial.interpolate(theta, step.from.y, out);
        Ok(())
    }
}
