//! The registry of methods of linearization, and the linear model by one of them.

use super::entry::{Entry, Request};
use super::minimal::MCS;
use super::spectrum::{Spectrum, spectrum};
use super::unconstrained::{AUGMENTED_LAGRANGIAN, BAUMGARTE, FORCE_PROJECTION, PENALTY};
use super::variation::refuse_all_modes;
use super::{Cost, LinearModel, Variation, reduction, redundant};
use crate::error::Result;
use std::time::Instant;

/// Returns every method, in the order of the documentation.
pub fn registry() -> &'static [Entry] {
    &[MCS, redundant::RCS, BAUMGARTE, PENALTY, AUGMENTED_LAGRANGIAN, FORCE_PROJECTION]
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

/// Returns the linear model at the state of `variation`.
///
/// # Errors
/// An unknown method or option; a chart that does not exist there; eigenvalues that cannot be computed.
pub fn linearize(variation: &mut Variation, request: &Request) -> Result<LinearModel> {
    let entry = request.method.entry(registry())?;
    refuse_large(variation.velocities())?;
    let clock = Instant::now();
    if variation.has_drivers() {
        variation.prescribed()?;
    }
    let reduction = reduction::measure(variation, request)?;
    let built = (entry.build)(variation, request)?;
    let assembly_seconds = clock.elapsed().as_secs_f64();
    let clock = Instant::now();
    let Spectrum { modes, conditioning, off_constraints } = spectrum(variation, &built, request)?;
    let eigen_seconds = clock.elapsed().as_secs_f64();
    let cost = Cost { assembly_seconds, eigen_seconds, conditioning, size: built.a.nrows(), off_constraints };
    let mut model = built.finish(variation, request.method.to_string(), modes, cost);
    model.modes.iter_mut().for_each(|mode| mode.error = mode.error.max(reduction.error * mode.value.norm()));
    Ok(LinearModel { reduction, ..model })
}
