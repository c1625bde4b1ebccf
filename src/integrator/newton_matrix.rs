//! The matrix of Newton's method, kept from step to step.

use super::{Problem, StepStart};
use crate::formulation::{Dae, Dynamics, Linearized, Point, StepError};
use crate::math::kkt::Singular;
use crate::math::newton::Monitor;
use crate::system::{MechanicalSystem, OperatingPoint};
use crate::tolerances;
use serde::{Deserialize, Serialize};

/// The step for which a matrix is factored.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct Size {
    /// Factor of the rates in the state, s.
    pub h: f64,
    /// Index of the method, where there are several.
    pub method: usize,
}

/// The factors of a method.
pub trait Factors {
    /// They serve steps up to this factor longer or shorter.
    const BAND: f64;

    /// dq/da of the metric of the shifts: see [`Linearized::weigh`].
    fn metric(&self, size: Size) -> f64;

    /// Factors M, G, L, K and C for a step.
    ///
    /// # Errors
    /// A singular matrix.
    fn factor(&mut self, size: Size, at: &Linearized, dynamics: &mut Dynamics) -> Result<(), Singular>;

    /// Uses the present factors for a step within the band.
    fn rescale(&mut self, _: Size) {}
}

/// M, G, L, K and C at one state, with the factors for one step, and the monitor of the iterations with them.
pub struct NewtonMatrix<F> {
    pub at: Linearized,
    pub factors: F,
    pub monitor: Monitor,
    /// True if `at` is to be used.
    is_linearized: bool,
    /// True if that was evaluated for the present attempt.
    pub is_fresh: bool,
    /// The step for which the matrix is factored, and the rows that are dropped from it.
    factored: Option<Size>,
    dropped: Vec<usize>,
    /// The matrix of a saved run.
    recalled: Option<SavedMatrix>,
}

/// What steps pass on: the contraction of the iterations, and the matrix if there is one.
#[derive(Serialize, Deserialize)]
pub struct Memory {
    pub monitor: [f64; 2],
    pub matrix: Option<SavedMatrix>,
}

/// A matrix as it is saved: it is evaluated and factored again.
#[derive(Serialize, Deserialize)]
pub struct SavedMatrix {
    pub size: Size,
    pub is_fresh: bool,
    pub point: Point,
}

impl<F: Factors> NewtonMatrix<F> {
    /// Memory for `dae` on a system.
    pub fn new(dae: Dae, system: &dyn MechanicalSystem, factors: F) -> Self {
        NewtonMatrix {
            at: Linearized::new(dae, system),
            factors,
            monitor: Monitor::default(),
            is_linearized: false,
            is_fresh: false,
            factored: None,
            dropped: Vec::new(),
            recalled: None,
        }
    }

    /// True if there is a matrix without the rows that are dropped now.
    pub fn serves(&self, dynamics: &Dynamics) -> bool {
        self.is_linearized && self.dropped == dynamics.dropped
    }

    /// Evaluates M, G, L, K and C at a state.
    ///
    /// # Errors
    /// Equations without K and C.
    pub fn linearize(&mut self, at: OperatingPoint, dynamics: &mut Dynamics) -> Result<(), StepError> {
        self.forget();
        self.factored = None;
        self.at.update(at, dynamics)?;
        self.dropped.clone_from(&dynamics.dropped);
        (self.is_linearized, self.is_fresh) = (true, true);
        Ok(())
    }

    /// Factors the matrix for a step, unless the factors are those of a size within the band.
    ///
    /// # Errors
    /// A singular matrix.
    pub fn factor(&mut self, problem: &mut Problem, from: StepStart, size: Size) -> Result<(), StepError> {
        let is_near = |own: Size| own.method == size.method && own.h.max(size.h) <= F::BAND * own.h.min(size.h);
        if self.factored.is_some_and(is_near) {
            self.factors.rescale(size);
            return Ok(());
        }
        self.factored = None;
        let weighed = self.at.weigh(self.factors.metric(size), &mut problem.dynamics);
        let factored = weighed.and_then(|()| self.factors.factor(size, &self.at, &mut problem.dynamics));
        factored.map_err(|singular| collapsed(singular, problem, from))?;
        self.factored = Some(size);
        Ok(())
    }

    /// Ends an attempt: the next one uses the matrix if it `is_kept`.
    pub fn pass_on(&mut self, is_kept: bool) {
        self.is_linearized &= is_kept;
        self.is_fresh = false;
    }

    /// Discards the matrix.
    pub fn forget(&mut self) {
        (self.is_linearized, self.is_fresh) = (false, false);
    }

    /// The values for [`Self::recall`].
    pub fn memory(&self) -> Memory {
        let size = self.factored.filter(|_| self.is_linearized);
        let saved = |size| SavedMatrix { size, is_fresh: self.is_fresh, point: self.at.point.clone() };
        Memory { monitor: self.monitor.memory(), matrix: size.map(saved) }
    }

    /// Restores a [`memory`](Self::memory), the matrix by [`Self::renew`].
    pub fn recall(&mut self, Memory { monitor, matrix }: Memory) {
        self.monitor.recall(monitor);
        self.recalled = matrix;
    }

    /// Computes the matrix of a saved run again, without counting the work.
    ///
    /// # Errors
    /// Those of the first time.
    pub fn renew(&mut self, problem: &mut Problem, from: StepStart) -> Result<(), StepError> {
        let n = problem.dynamics.system.dimensions();
        let Some(SavedMatrix { size, is_fresh, point }) = self.recalled.take().filter(|saved| saved.point.fits(n))
        else {
            return Ok(());
        };
        let counted = problem.dynamics.statistics;
        self.linearize(point.borrowed(), &mut problem.dynamics)?;
        self.factor(problem, from, size)?;
        problem.dynamics.statistics = counted;
        self.is_fresh = is_fresh;
        Ok(())
    }
}

/// The cause of a singular matrix. If all rows are in it, some depend on others at the start of the step and ahead, and
/// they prescribe different positions there, the rows contradict each other.
fn collapsed(singular: Singular, problem: &mut Problem, from: StepStart) -> StepError {
    if singular != Singular::Collapsed || !problem.dynamics.dropped.is_empty() {
        return singular.into();
    }
    let ahead: Vec<f64> = from.y.iter().zip(from.slope).map(|(y, slope)| y + from.h * slope).collect();
    let mut open = |t: f64, y: &[f64]| {
        let (q, v) = problem.split(y);
        problem.dynamics.dependent_rows_open(t, q, v)
    };
    let is_torn = open(from.t, from.y).is_some()
        && open(from.t + from.h, &ahead).is_some_and(|open| open > tolerances::ROUND_OFF_OF_PHI);
    if is_torn { CONTRADICTION } else { singular.into() }
}

const CONTRADICTION: StepError = StepError::Unsuitable {
    reason: "redundant constraints contradict each other during the motion",
    hint: "`holonom check` names the redundant joints; take one away, or make them say the same at all times",
};
