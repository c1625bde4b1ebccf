//! The simplified Newton iteration: one saddle-point system for each eigenvalue of A.

use super::collocation::{Collocation, StageMode};
use super::stages::Unknowns;
use crate::error::Result;
use crate::formulation::{Dae, Dynamics, Iteration, Linearized, Number, Residual, Slopes, StepError};
use crate::integrator::newton_matrix::{Factors, Size};
use crate::integrator::{Setup, no_memory};
use crate::math::kkt::Singular;
use faer::c64;

/// The matrices of all eigenvalues of one method.
pub struct Matrices {
    pub real: Iteration<f64>,
    pairs: Vec<Iteration<c64>>,
    /// The eigenvalues of each method, the real one and one of each conjugate pair.
    eigenvalues: Vec<(f64, Vec<c64>)>,
}

impl Matrices {
    pub fn new(dae: Dae, methods: &[Collocation], setup: &Setup) -> Result<Self> {
        let pair = |_| Iteration::new(dae, setup.system).ok_or_else(no_memory);
        let most_pairs = methods.iter().map(|method| method.pairs.len()).max().unwrap_or(0);
        let of_pairs = |method: &Collocation| method.pairs.iter().map(|pair| pair.value).collect();
        Ok(Matrices {
            real: Iteration::new(dae, setup.system).ok_or_else(no_memory)?,
            pairs: (0..most_pairs).map(pair).collect::<Result<_>>()?,
            eigenvalues: methods.iter().map(|method| (method.real.value, of_pairs(method))).collect(),
        })
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

/// With W the change of V' along an eigenvector of A with the eigenvalue a, V changes by h a W and Q by (h a)^2 W.
impl Factors for Matrices {
    /// Steps of other sizes have matrices of their own.
    const BAND: f64 = 1.0;

    fn metric(&self, Size { h, method }: Size) -> f64 {
        Slopes::implicit(h * self.eigenvalues[method].0).q
    }

    fn factor(&mut self, Size { h, method }: Size, at: &Linearized, dynamics: &mut Dynamics) -> Result<(), Singular> {
        let (real, pairs) = &self.eigenvalues[method];
        self.real.factor(Slopes::implicit(h * real), at, dynamics)?;
        let mut all = self.pairs.iter_mut().zip(pairs);
        all.try_for_each(|(pair, value)| pair.factor(Slopes::implicit(value * h), at, dynamics))
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
