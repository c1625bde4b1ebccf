//! Newton's method for the state at the end of a step.

use super::super::newton_matrix::{Factors, NewtonMatrix, Size};
use super::super::{Problem, StepStart};
use super::motion::{Scheme, StepMotion};
use crate::formulation::{Dae, Dynamics, Iteration, Linearized, Residual, Slopes, StepError};
use crate::math::kkt::Singular;
use crate::math::largest;
use crate::math::newton::Limits;
use crate::system::{MechanicalSystem, OperatingPoint};
use crate::tolerances;

/// The matrix for v'_1.
pub(super) struct AccelerationMatrix {
    scheme: Scheme,
    iteration: Iteration<f64>,
}

impl Factors for AccelerationMatrix {
    const BAND: f64 = 1.3;

    /// Shifts have the metric of M alone, since sums of corrections in the metrics of several states would depend on
    /// the iteration.
    fn metric(&self, _: Size) -> f64 {
        0.0
    }

    fn factor(&mut self, Size { h, .. }: Size, at: &Linearized, dynamics: &mut Dynamics) -> Result<(), Singular> {
        self.iteration.factor(self.scheme.slopes(h), at, dynamics)
    }

    fn rescale(&mut self, Size { h, .. }: Size) {
        self.iteration.rescale(self.scheme.slopes(h));
    }
}

/// Limits on changes over their stagnation tolerance.
fn limits(is_fixed: bool) -> Limits {
    Limits {
        // As many as far predictions and kinks of forces want.
        most: 25,
        // phi is round-off then, and no more is asked of v'.
        tolerance: if is_fixed { tolerances::ROUND_OFF_OF_STAGNATION } else { 1e-6 },
        round_off: tolerances::ROUND_OFF_OF_STAGNATION,
        stagnation: 1.0,
        // An iteration more costs far less than K and C.
        kept_rate: 1e-2,
        ..Limits::NONE
    }
}

/// Solves the equations at the end of a step for v'_1, lambda_1 and the shifts.
pub(super) struct Newton {
    dae: Dae,
    limits: Limits,
    pub matrix: NewtonMatrix<AccelerationMatrix>,
    residual: Residual,
    /// True if the last iteration began with the matrix of one before.
    pub is_stale: bool,
    /// True if the start of the step is near a singular state.
    is_nearly_singular: bool,
}

impl Newton {
    /// Memory for `dae` on a system; `None` if there is not enough.
    pub fn new(dae: Dae, scheme: Scheme, is_fixed: bool, system: &dyn MechanicalSystem) -> Option<Self> {
        let matrix = AccelerationMatrix { scheme, iteration: Iteration::new(dae, system)? };
        Some(Newton {
            dae,
            limits: limits(is_fixed),
            matrix: NewtonMatrix::new(dae, system, matrix),
            residual: Residual::new(system.dimensions()),
            is_stale: false,
            is_nearly_singular: false,
        })
    }

    /// Keeps the matrix for the next step if the iteration contracted well, and one of a step before if it was short,
    /// too. Near singular states round-off is divided by the rank indicator of the matrix, and one of a step before is
    /// kept.
    pub fn accepted(&mut self) {
        let monitor = &self.matrix.monitor;
        // Rates of round-off are means of two ratios, and one may be small by chance.
        let of_round_off = if monitor.has_stagnated { 3 } else { 0 };
        // A matrix costs about four corrections, and a new one converges in three or two.
        let is_short = monitor.iterations <= 4 + of_round_off;
        let is_economical = is_short || self.matrix.is_fresh || self.is_nearly_singular;
        self.matrix.pass_on(self.matrix.monitor.keeps_matrix() && is_economical);
    }

    /// Power of the forces without a potential and of moving constraints at the end, W.
    pub fn powers(&self) -> &[f64] {
        &self.residual.powers
    }

    /// Writes q_1 and v_1 to `to`, v'_1 and lambda_1 to the end of `motion`.
    pub fn converge(
        &mut self,
        problem: &mut Problem,
        motion: &mut StepMotion,
        from: StepStart,
        to: &mut [f64],
    ) -> Result<(), StepError> {
        let h = from.h;
        self.matrix.renew(problem, from)?;
        self.matrix.pass_on(true);
        self.is_stale = self.matrix.serves(&problem.dynamics);
        let kkt = &problem.dynamics.kkt;
        self.is_nearly_singular =
            kkt.is_factored() && kkt.rank_indicator() < tolerances::NEAR_SINGULAR * kkt.rank_reference;
        let mut monitor = std::mem::take(&mut self.matrix.monitor);
        let converged = monitor.solve(self.limits, |renews| {
            motion.advance(problem, from, to);
            if renews {
                self.matrix.forget();
            }
            self.evaluate(problem, motion, from, to)?;
            let NewtonMatrix { at, factors: AccelerationMatrix { iteration, .. }, .. } = &mut self.matrix;
            iteration.load(std::iter::once((1.0, &self.residual)));
            iteration.solve(at, &problem.dynamics.structure)?;
            problem.dynamics.statistics.newton_iterations += 1;
            let round_off = tolerances::ROUND_OFF * largest(problem.split(to).0);
            let moving = problem.dynamics.system.dimensions().moving();
            let [change, of_states] = motion.correct(&iteration.change, moving, h, round_off);
            let change = if change <= self.negligible(problem, motion, h, to) { 0.0 } else { change };
            let [small, small_state] = self.small(problem, motion, h, to);
            Ok::<_, StepError>(change / small + of_states / small_state)
        });
        let has_stagnated = monitor.has_stagnated;
        self.matrix.monitor = monitor;
        if !converged? {
            self.matrix.forget();
            return Err(StepError::NotConverged);
        }
        problem.dynamics.statistics.stagnated += u64::from(has_stagnated);
        motion.advance(problem, from, to);
        Ok(())
    }

    /// The residual at q_1, v_1, and the matrix if there is none for this step.
    fn evaluate(
        &mut self,
        problem: &mut Problem,
        motion: &StepMotion,
        from: StepStart,
        to: &[f64],
    ) -> Result<(), StepError> {
        let h = from.h;
        let ((q, v), t) = (problem.split(to), from.t + h);
        let vdot = &motion.end.vdot;
        let lambda = &motion.end.lambda;
        let dynamics = &mut problem.dynamics;
        if self.matrix.serves(dynamics) {
            self.residual.evaluate(&self.dae, t, q, v, motion.unknowns(), dynamics)?;
        } else {
            if to.iter().any(|x| !x.is_finite()) {
                return Err(StepError::NotFinite);
            }
            self.matrix.linearize(OperatingPoint { t, q, v, vdot, lambda }, dynamics)?;
            dynamics.statistics.rhs_evaluations += 1;
            self.residual.of_terms(&self.dae, motion.unknowns(), dynamics);
        }
        self.matrix.factor(problem, from, Size { h, method: 0 })
    }

    /// Size up to which changes of v'_1 count as zero where phi = 0 alone is solved: they move q by less than the
    /// rounding of the largest coordinate, and v by less than its error of a step.
    fn negligible(&self, problem: &Problem, motion: &StepMotion, h: f64, to: &[f64]) -> f64 {
        if self.dae.velocity_index() < 2 {
            return 0.0;
        }
        let rounding = f64::EPSILON * largest(problem.split(to).0) / motion.scheme.slopes(h).q;
        rounding.min(tolerances::SIX_DIGITS * motion.largest_change())
    }

    /// Stagnation tolerances of the changes of v'_1 and of xi'_1, from the largest a_1 and v_1/h of each.
    fn small(&self, problem: &Problem, motion: &StepMotion, h: f64, to: &[f64]) -> [f64; 2] {
        let (q, v) = problem.split(to);
        let moving = problem.dynamics.system.dimensions().moving();
        let size = largest(&motion.end.a[..moving]).max(largest(&v[..moving]) / h);
        let of_states = largest(&motion.end.a[moving..v.len()]).max(largest(&v[moving..v.len()]) / h);
        let Slopes { q: by_q, v: by_v, .. } = motion.scheme.slopes(h);
        let reach = Some(largest(q)).filter(|reach| *reach > 0.0).map_or(1.0, |reach| reach.max(tolerances::ATOM));
        [
            (tolerances::ROOT_OF_ROUND_OFF * size).max(tolerances::ROUND_OFF_OF_SUMS * reach / by_q),
            (tolerances::ROOT_OF_ROUND_OFF * of_states).max(tolerances::ROUND_OFF_OF_SUMS / by_v),
        ]
    }
}
