//! Newton's method for the state at the end of a step.

use super::super::memory::Reader;
use super::super::{From, Problem, collapsed};
use super::motion::Motion;
use crate::formulation::{Dae, Iteration, Linearized, Residual, Slopes, StepError};
use crate::math::largest;
use crate::math::newton::{Limits, Monitor};
use crate::system::{MechanicalSystem, OperatingPoint};
use crate::tolerances::integrator as tolerances;

/// Stiffness added to the metric of shifts: none, since sums of corrections in the metrics of several states would
/// depend on the iteration.
const MASS: f64 = 0.0;

/// Limits on changes over their stagnation tolerance.
fn limits(is_fixed: bool) -> Limits {
    Limits {
        most: tolerances::GENERALIZED_ALPHA_ITERATIONS,
        tolerance: if is_fixed { tolerances::ROUND_OFF_OF_STAGNATION } else { tolerances::CONTROLLED_ERROR },
        round_off: tolerances::ROUND_OFF_OF_STAGNATION,
        stagnation: 1.0,
        kept_rate: tolerances::GENERALIZED_ALPHA_MATRIX_KEPT,
        ..Limits::NONE
    }
}

/// Solves the equations at the end of a step for v'_1, lambda_1 and the shifts.
pub(super) struct Newton {
    dae: Dae,
    limits: Limits,
    at: Linearized,
    iteration: Iteration<f64>,
    residual: Residual,
    monitor: Monitor,
    is_linearized: bool,
    /// True if the last iteration began with the matrix of a step before.
    pub is_stale: bool,
    /// True if the matrix was renewed in the last iteration.
    is_renewed: bool,
    /// True if the start of the step is near a singular state.
    is_nearly_singular: bool,
    /// The step size and the dropped rows for which the matrix is factored.
    factored: Option<f64>,
    dropped: Vec<usize>,
    /// Step size and state of the matrix of a saved run.
    recalled: Option<(f64, Vec<f64>)>,
}

impl Newton {
    /// Memory for `dae` on a system; `None` if there is not enough.
    pub fn new(dae: Dae, is_fixed: bool, system: &dyn MechanicalSystem) -> Option<Self> {
        Some(Newton {
            dae,
            limits: limits(is_fixed),
            at: Linearized::new(dae, system),
            iteration: Iteration::new(dae, system)?,
            residual: Residual::new(system.dimensions()),
            monitor: Monitor::default(),
            is_linearized: false,
            is_stale: false,
            is_renewed: false,
            is_nearly_singular: false,
            factored: None,
            dropped: Vec::new(),
            recalled: None,
        })
    }

    /// Keeps the matrix for the next step if the iteration contracted well, and one of a step before if it was short,
    /// too. Near singular states round-off is divided by the rank indicator of the matrix, and one of a step before is
    /// kept.
    pub fn accepted(&mut self) {
        let of_round_off = if self.monitor.has_stagnated { tolerances::CORRECTIONS_OF_ROUND_OFF } else { 0 };
        let is_short = self.monitor.iterations <= tolerances::CORRECTIONS_WITH_OLD_MATRIX + of_round_off;
        self.is_linearized &= self.monitor.keeps_matrix() && (is_short || self.is_renewed || self.is_nearly_singular);
    }

    /// Discards the matrix where the equations change their form.
    pub fn restart(&mut self) {
        self.is_linearized = false;
    }

    /// Contraction of the iteration, and step size and state of the matrix if it is kept, for [`Self::recall`].
    pub fn memory(&self) -> Vec<f64> {
        let h = self.factored.filter(|_| self.is_linearized).unwrap_or(0.0);
        let point = if self.is_linearized { self.at.point() } else { &[] };
        [&self.monitor.memory()[..], &[h], point].concat()
    }

    /// Restores a [`memory`](Self::memory) at the next step.
    pub fn recall(&mut self, mut memory: Reader) {
        self.monitor.recall([memory.number(), memory.number()]);
        self.recalled = Some((memory.number(), memory.rest().to_vec()));
    }

    /// Computes the matrix of a saved run again.
    fn renew(&mut self, problem: &mut Problem, motion: &Motion) -> Result<(), StepError> {
        let Some((h, point)) = self.recalled.take().filter(|(h, _)| *h > 0.0) else { return Ok(()) };
        let counted = problem.dynamics.statistics;
        self.at.recall(&point, &mut problem.dynamics)?;
        self.at.weigh(MASS, &mut problem.dynamics)?;
        self.iteration.factor(motion.slopes(h), &self.at, &mut problem.dynamics)?;
        self.dropped.clone_from(&problem.dynamics.dropped);
        problem.dynamics.statistics = counted;
        (self.is_linearized, self.factored) = (true, Some(h));
        Ok(())
    }

    /// Power of the forces without a potential and of moving constraints at the end, W.
    pub fn powers(&self) -> &[f64] {
        &self.residual.powers
    }

    /// Writes q_1 and v_1 to `to`, v'_1 and lambda_1 to the end of `motion`.
    pub fn converge(
        &mut self,
        problem: &mut Problem,
        motion: &mut Motion,
        from: From,
        h: f64,
        to: &mut [f64],
    ) -> Result<(), StepError> {
        self.renew(problem, motion)?;
        self.is_stale = self.is_linearized;
        self.is_renewed = false;
        let kkt = &problem.dynamics.kkt;
        self.is_nearly_singular =
            kkt.is_factored() && kkt.rank_indicator() < tolerances::NEARLY_SINGULAR * kkt.rank_reference;
        let mut monitor = std::mem::take(&mut self.monitor);
        let converged = monitor.solve(self.limits, |renews| {
            motion.advance(problem, from, h, to);
            self.is_linearized &= !renews;
            self.evaluate(problem, motion, (from, h), to)?;
            self.iteration.load(std::iter::once((1.0, &self.residual)));
            self.iteration.solve(&mut self.at, &problem.dynamics.structure)?;
            problem.dynamics.statistics.newton_iterations += 1;
            let round_off = tolerances::ROUND_OFF * largest(problem.split(to).0);
            let moving = problem.dynamics.system.dimensions().moving();
            let [change, of_states] = motion.correct(&self.iteration.change, moving, h, round_off);
            let change = if change <= self.negligible(problem, motion, h, to) { 0.0 } else { change };
            let [small, small_state] = self.small(problem, motion, h, to);
            Ok::<_, StepError>(change / small + of_states / small_state)
        });
        self.monitor = monitor;
        if !converged? {
            self.is_linearized = false;
            return Err(StepError::NotConverged);
        }
        problem.dynamics.statistics.stagnated += u64::from(self.monitor.has_stagnated);
        motion.advance(problem, from, h, to);
        Ok(())
    }

    /// The residual at q_1, v_1, and the matrix if there is none for this step.
    fn evaluate(
        &mut self,
        problem: &mut Problem,
        motion: &Motion,
        (from, h): (From, f64),
        to: &[f64],
    ) -> Result<(), StepError> {
        let ((q, v), t) = (problem.split(to), from.t + h);
        let vdot = &motion.end.vdot;
        let lambda = &motion.end.lambda;
        let dynamics = &mut problem.dynamics;
        if self.is_linearized && self.dropped == dynamics.dropped {
            self.residual.evaluate(&self.dae, (t, q, v), motion.unknowns(), dynamics)?;
        } else {
            if to.iter().any(|x| !x.is_finite()) {
                return Err(StepError::NotFinite);
            }
            self.at.update(OperatingPoint { t, q, v, vdot, lambda }, dynamics)?;
            self.at.weigh(MASS, dynamics)?;
            dynamics.statistics.rhs_evaluations += 1;
            self.residual.of_terms(&self.dae, motion.unknowns(), dynamics);
            (self.is_linearized, self.is_renewed, self.factored) = (true, true, None);
        }
        if self.factored.is_some_and(|own| own / h <= tolerances::MATRIX_BAND && h / own <= tolerances::MATRIX_BAND) {
            self.iteration.rescale(motion.slopes(h));
            return Ok(());
        }
        self.factored = None;
        let factored = self.iteration.factor(motion.slopes(h), &self.at, dynamics);
        factored.map_err(|singular| collapsed(singular, problem, from, h))?;
        self.factored = Some(h);
        self.dropped.clone_from(&problem.dynamics.dropped);
        Ok(())
    }

    /// Size up to which changes of v'_1 count as zero where phi = 0 alone is solved: they move q by less than the
    /// rounding of the largest coordinate, and v by less than its error of a step.
    fn negligible(&self, problem: &Problem, motion: &Motion, h: f64, to: &[f64]) -> f64 {
        if self.dae.velocity_index() < 2 {
            return 0.0;
        }
        let rounding = f64::EPSILON * largest(problem.split(to).0) / motion.slopes(h).q;
        rounding.min(tolerances::PART_OF_CHANGE * motion.largest_change())
    }

    /// Stagnation tolerances of the changes of v'_1 and of xi'_1, from the largest a_1 and v_1/h of each.
    fn small(&self, problem: &Problem, motion: &Motion, h: f64, to: &[f64]) -> [f64; 2] {
        let (q, v) = problem.split(to);
        let moving = problem.dynamics.system.dimensions().moving();
        let size = largest(&motion.end.a[..moving]).max(largest(&v[..moving]) / h);
        let of_states = largest(&motion.end.a[moving..v.len()]).max(largest(&v[moving..v.len()]) / h);
        let Slopes { q: by_q, v: by_v, .. } = motion.slopes(h);
        let reach =
            Some(largest(q)).filter(|reach| *reach > 0.0).map_or(1.0, |reach| reach.max(tolerances::LEAST_LARGEST_Q));
        [
            (tolerances::NEWTON_STAGNATION * size).max(tolerances::ROUND_OFF_OF_SUMS * reach / by_q),
            (tolerances::NEWTON_STAGNATION * of_states).max(tolerances::ROUND_OFF_OF_SUMS / by_v),
        ]
    }
}
