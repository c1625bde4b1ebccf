//! The simplified Newton iteration: one saddle-point system for each eigenvalue of A.

use super::collocation::{Collocation, StageMode};
use super::stages::Unknowns;
use crate::error::{Error, Result};
use crate::formulation::{Dae, Dynamics, Iteration, Linearized, Number, Residual, Slopes, StepError};
use crate::integrator::Setup;
use crate::math::kkt::Singular;
use faer::c64;

/// The matrices of all eigenvalues at one state, for one step size and method.
pub struct Matrices {
    pub real: Iteration<f64>,
    pairs: Vec<Iteration<c64>>,
    /// Step size and method for which they are factored, and the rows that are dropped there.
    factored: Option<(f64, usize)>,
    dropped: Vec<usize>,
}

/// With W the change of V' along an eigenvector of A with the eigenvalue a, V changes by h a W and Q by (h a)^2 W.
fn slopes<T: Number>(ha: T) -> Slopes<T> {
    Slopes { v: ha, q: ha * ha, w: ha, w_q: ha * ha, u: ha }
}

impl Matrices {
    pub fn new(dae: Dae, most_pairs: usize, setup: &Setup) -> Result<Self> {
        let no_memory = || Error::input("there is not enough memory for the matrices of this size");
        let pair = |_| Iteration::new(dae, setup.system).ok_or_else(no_memory);
        Ok(Matrices {
            real: Iteration::new(dae, setup.system).ok_or_else(no_memory)?,
            pairs: (0..most_pairs).map(pair).collect::<Result<_>>()?,
            factored: None,
            dropped: Vec::new(),
        })
    }

    fn is_factored(&self, index: usize, h: f64, dynamics: &Dynamics) -> bool {
        self.factored == Some((h, index)) && self.dropped == dynamics.dropped
    }

    /// Sets the metric of shifts for a step `h` of `method`, whose index is `index`, before the matrices are factored
    /// for it. An output row within the step keeps the metric of the step.
    pub fn weigh(
        &self,
        (method, index): (&Collocation, usize),
        h: f64,
        at: &mut Linearized,
        dynamics: &mut Dynamics,
    ) -> Result<(), Singular> {
        if self.is_factored(index, h, dynamics) { Ok(()) } else { at.weigh(slopes(h * method.real.value).q, dynamics) }
    }

    /// Factors for a step `h` of `method`, whose index is `index`, unless that is done.
    pub fn factor(
        &mut self,
        (method, index): (&Collocation, usize),
        h: f64,
        at: &Linearized,
        dynamics: &mut Dynamics,
    ) -> Result<(), Singular> {
        if self.is_factored(index, h, dynamics) {
            return Ok(());
        }
        self.factored = None;
        self.real.factor(slopes(h * method.real.value), at, dynamics)?;
        for (pair, mode) in self.pairs.iter_mut().zip(&method.pairs) {
            pair.factor(slopes(mode.value * h), at, dynamics)?;
        }
        self.factored = Some((h, index));
        self.dropped.clone_from(&dynamics.dropped);
        Ok(())
    }

    /// Step size and method for which they are factored.
    pub fn factored(&self) -> Option<(f64, usize)> {
        self.factored
    }

    /// True if exactly the rows `dropped` are dropped from the factors, or there are no factors.
    pub fn serves(&self, dropped: &[usize]) -> bool {
        self.factored.is_none() || self.dropped == dropped
    }

    /// Discards the factors: the state is another from now on.
    pub fn forget(&mut self) {
        self.factored = None;
    }

    /// Sets the multipliers of dropped rows to zero, since no correction reaches them.
    pub fn leave_out(&self, unknowns: &mut Unknowns) {
        unknowns.leave_out(self.real.matrix.left_out());
        self.pairs.iter().for_each(|pair| unknowns.leave_out(pair.matrix.left_out()));
    }

    /// One correction of all stages by their residuals.
    pub fn correct(
        &mut self,
        method: &Collocation,
        residuals: &[Residual],
        at: &mut Linearized,
        unknowns: &mut Unknowns,
        dynamics: &mut Dynamics,
    ) -> Result<(), StepError> {
        dynamics.statistics.newton_iterations += 1;
        correct(&mut self.real, &method.real, residuals, at, unknowns, dynamics)?;
        let mut pairs = self.pairs.iter_mut().zip(&method.pairs);
        pairs.try_for_each(|(pair, mode)| correct(pair, mode, residuals, at, unknowns, dynamics))
    }
}

/// Correction of all stages along one eigenvector.
fn correct<T: Number>(
    iteration: &mut Iteration<T>,
    mode: &StageMode<T>,
    residuals: &[Residual],
    at: &mut Linearized,
    unknowns: &mut Unknowns,
    dynamics: &Dynamics,
) -> Result<(), StepError> {
    iteration.load(mode.left.iter().copied().zip(residuals));
    iteration.solve(at, &dynamics.structure)?;
    let (change, Unknowns { a, lambda, w, eta, u, mu }) = (&iteration.change, unknowns);
    spread(mode, &change.a, a);
    spread(mode, &change.lambda, lambda);
    spread(mode, &change.w, w);
    spread(mode, &change.eta, eta);
    spread(mode, &change.u, u);
    spread(mode, &change.mu, mu);
    Ok(())
}

/// Adds a part along a mode, and along its conjugate, to the stages.
fn spread<T: Number>(mode: &StageMode<T>, change: &[T], out: &mut [Vec<f64>]) {
    for (&right, out) in mode.right.iter().zip(out) {
        out.iter_mut().zip(change).for_each(|(out, &change)| *out += (right * change).total());
    }
}
