//! The Newton matrix, kept from step to step.

use crate::formulation::{Dae, Iteration, Linearized, Slopes, StepError};
use crate::integrator::memory::Reader;
use crate::integrator::{From, Problem, collapsed};
use crate::system::{MechanicalSystem, OperatingPoint};
use crate::tolerances::integrator as tolerances;

/// M, G, L, K and C at one state, with the factors of the matrix for one g in y = y* + g y'.
pub struct Matrix {
    pub at: Linearized,
    pub iteration: Iteration<f64>,
    /// True if `at` is to be used.
    is_linearized: bool,
    /// True if that was evaluated for the present step.
    pub is_fresh: bool,
    /// g for which the matrix is factored, and the rows that are dropped from it.
    factored: Option<f64>,
    dropped: Vec<usize>,
    /// g of the matrix of a saved run, whether it was fresh, and its state.
    recalled: Option<(f64, bool, Vec<f64>)>,
}

/// With v = v* + g (a + w) and q = q* + g N (v + u).
fn slopes(g: f64) -> Slopes<f64> {
    Slopes { v: g, q: g * g, w: g, w_q: g * g, u: g }
}

impl Matrix {
    /// Memory for `dae` on a system; `None` if there is not enough.
    pub fn new(dae: Dae, system: &dyn MechanicalSystem) -> Option<Self> {
        Some(Matrix {
            at: Linearized::new(dae, system),
            iteration: Iteration::new(dae, system)?,
            is_linearized: false,
            is_fresh: false,
            factored: None,
            dropped: Vec::new(),
            recalled: None,
        })
    }

    /// True if there is a matrix for these dropped rows, of this step or one before.
    pub fn serves(&self, problem: &Problem) -> bool {
        self.is_linearized && self.dropped == problem.dynamics.dropped
    }

    /// Evaluates M, G, L, K and C at a state.
    pub fn linearize(&mut self, at: OperatingPoint, problem: &mut Problem) -> Result<(), StepError> {
        (self.is_linearized, self.factored) = (false, None);
        self.at.update(at, &mut problem.dynamics)?;
        self.dropped.clone_from(&problem.dynamics.dropped);
        (self.is_linearized, self.is_fresh) = (true, true);
        Ok(())
    }

    /// Factors the matrix for `g`, unless the factors are those of a value near it.
    pub fn factor(&mut self, problem: &mut Problem, (from, h): (From, f64), g: f64) -> Result<(), StepError> {
        if self.factored.is_some_and(|own| own.max(g) <= tolerances::STAGE_BAND * own.min(g)) {
            self.iteration.rescale(slopes(g));
            return Ok(());
        }
        self.factored = None;
        let weighed = self.at.weigh(slopes(g).q, &mut problem.dynamics);
        let factored = weighed.and_then(|()| self.iteration.factor(slopes(g), &self.at, &mut problem.dynamics));
        factored.map_err(|singular| collapsed(singular, problem, from, h))?;
        self.factored = Some(g);
        Ok(())
    }

    /// Ends a step: a matrix that is not kept is evaluated anew in the next.
    pub fn accepted(&mut self, is_kept: bool) {
        self.is_linearized &= is_kept;
        self.is_fresh = false;
    }

    /// Discards the matrix.
    pub fn forget(&mut self) {
        (self.is_linearized, self.is_fresh) = (false, false);
    }

    /// g and the state of the matrix if it is kept, for [`Self::recall`].
    pub fn memory(&self) -> Vec<f64> {
        match self.factored.filter(|_| self.is_linearized) {
            Some(g) => [&[g, f64::from(self.is_fresh)], self.at.point()].concat(),
            None => vec![0.0],
        }
    }

    /// Restores a [`memory`](Self::memory) at the next step.
    pub fn recall(&mut self, mut memory: Reader) {
        let g = memory.number();
        let is_fresh = memory.number() != 0.0;
        self.recalled = (g > 0.0).then(|| (g, is_fresh, memory.rest().to_vec()));
    }

    /// Computes the matrix of a saved run again, without counting the work.
    pub fn renew(&mut self, problem: &mut Problem, from: From) -> Result<(), StepError> {
        let Some((g, is_fresh, point)) = self.recalled.take() else { return Ok(()) };
        let counted = problem.dynamics.statistics;
        self.at.recall(&point, &mut problem.dynamics)?;
        self.dropped.clone_from(&problem.dynamics.dropped);
        self.factor(problem, (from, g), g)?;
        problem.dynamics.statistics = counted;
        (self.is_linearized, self.is_fresh) = (true, is_fresh);
        Ok(())
    }
}
