//! The registry of methods of linearization, and the linear model by one of them.

use super::entry::{Linear, LinearMatrices, LinearizationMethod};
use super::minimal::MCS;
use super::slopes::{ModelRate, Slope};
use super::spectrum::{Spectrum, spectrum};
use super::unconstrained::{AUGMENTED_LAGRANGIAN, BAUMGARTE, FORCE_PROJECTION, PENALTY};
use super::variation::refuse_all_modes;
use super::{Cost, LinearModel, Reduction, State, Variation, reduction, redundant};
use crate::error::Result;
use crate::method_spec::{Listed, OptionDoc};
use crate::system::MechanicalSystem;
use std::time::Instant;

/// Returns every method, in the order of the documentation.
pub fn registry() -> &'static [LinearizationMethod] {
    &[MCS, redundant::RCS, BAUMGARTE, PENALTY, AUGMENTED_LAGRANGIAN, FORCE_PROJECTION]
}

impl Listed for LinearizationMethod {
    const KIND: &'static str = "method";

    fn registry() -> &'static [Self] {
        registry()
    }

    fn name(&self) -> &'static str {
        self.name
    }

    fn options(&self) -> &'static [OptionDoc] {
        self.options
    }
}

/// Number of dense n_v x n_v matrices needed, the states being twice as many: the model, its directions, and
/// eigenvectors that are complex.
const COPIES: f64 = 40.0;

/// Refuses a model with all modes of `velocities` velocities where its matrices would not fit, before a motion is
/// simulated for it.
///
/// # Errors
/// Bad input, with the alternative.
pub fn refuse_large(velocities: usize) -> Result<()> {
    refuse_all_modes(velocities, COPIES)
}

/// Returns the linear model of a system at a state, which should be on the constraints.
///
/// ```
/// use holonom::linear::{State, linearize};
/// use holonom::prelude::*;
///
/// /// x'' = -4 x
/// struct Oscillator;
///
/// impl Equations for Oscillator {
///     fn size(&self) -> (usize, usize) {
///         (1, 0)
///     }
///     fn mass<S: Scalar>(&self, _t: S, _q: &[S], mass: &mut [S]) {
///         mass[0] = S::one();
///     }
///     fn force<S: Scalar>(&self, _t: S, q: &[S], _v: &[S], f: &mut [S]) {
///         f[0] = q[0] * -4.0;
///     }
///     fn phi<S: Scalar>(&self, _t: S, _q: &[S], _phi: &mut [S]) {}
/// }
///
/// let model = linearize(&Oscillator, &State::new(0.0, [0.0], [0.0]), &Linear::default())?;
/// assert!((model.eigenvalues()[0].im.abs() - 2.0).abs() < 1e-14);
/// # Ok::<(), holonom::Error>(())
/// ```
///
/// # Errors
/// See [`Variation::new`] and [`Variation::linearize`].
pub fn linearize(system: &dyn MechanicalSystem, state: &State, request: &Linear) -> Result<LinearModel> {
    state.variation(system)?.linearize(request)
}

impl Variation<'_> {
    /// Returns the linear model at the state of these equations.
    ///
    /// # Errors
    /// An unknown method or option; a chart that does not exist there; eigenvalues that cannot be computed.
    pub fn linearize(&mut self, request: &Linear) -> Result<LinearModel> {
        Ok(solve(self, request)?.finish(self, request))
    }
}

/// Returns the matrices of the model at the state of `variation`.
///
/// # Errors
/// An unknown method or option; a chart that does not exist there.
pub(super) fn build(variation: &mut Variation, request: &Linear) -> Result<LinearMatrices> {
    let entry = request.method.entry::<LinearizationMethod>()?;
    if variation.has_drivers() {
        variation.prescribed()?;
    }
    (entry.build)(variation, request)
}

/// A model with its eigenvectors.
pub(super) struct Solved {
    pub built: LinearMatrices,
    pub spectrum: Spectrum,
    reduction: Reduction,
    cost: Cost,
}

/// Returns the model at the state of `variation`, before its matrices are named.
///
/// # Errors
/// See [`Variation::linearize`].
pub(super) fn solve(variation: &mut Variation, request: &Linear) -> Result<Solved> {
    request.method.entry::<LinearizationMethod>()?;
    refuse_large(variation.velocities())?;
    let clock = Instant::now();
    let reduction = reduction::measure(variation, request)?;
    let built = build(variation, request)?;
    let assembly_seconds = clock.elapsed().as_secs_f64();
    let clock = Instant::now();
    let spectrum = spectrum(variation, &built, request)?;
    let eigen_seconds = clock.elapsed().as_secs_f64();
    let Spectrum { conditioning, off_constraints, .. } = spectrum;
    let cost = Cost { assembly_seconds, eigen_seconds, conditioning, size: built.a.nrows(), off_constraints };
    Ok(Solved { built, spectrum, reduction, cost })
}

impl Solved {
    /// Returns the derivatives of the finite modes, where there are left vectors and models beside this one; see
    /// [`ModelRate::new`].
    pub fn slopes(&self, steps: &[f64], model: impl FnMut(f64) -> Result<LinearMatrices>) -> Vec<Slope> {
        let Spectrum { vectors, modes, .. } = &self.spectrum;
        let Some(vectors) = vectors else { return Vec::new() };
        ModelRate::new(&self.built, steps, model).map_or_else(Vec::new, |rate| rate.slopes(vectors, modes))
    }

    /// The model, without the eigenvectors.
    pub fn finish(self, variation: &mut Variation, request: &Linear) -> LinearModel {
        let Solved { built, spectrum: Spectrum { mut modes, .. }, reduction, cost } = self;
        modes.iter_mut().for_each(|mode| mode.error = mode.error.max(reduction.error * mode.value.norm()));
        LinearModel { reduction, ..built.finish(variation, request.method.to_string(), modes, cost) }
    }
}
