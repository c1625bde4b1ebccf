//! Every method of linearization, and the linear model by one of them.

use super::entry::{Built, Entry, Request};
use super::minimal::MCS;
use super::spectrum::{Spectrum, spectrum};
use super::unconstrained::{AUGMENTED_LAGRANGIAN, BAUMGARTE, FORCE_PROJECTION, PENALTY};
use super::variation::refuse_all_modes;
use super::{Cost, LinearModel, Variation, redundant};
use crate::error::Result;
use std::time::Instant;

/// Every method, in the order of the documentation.
pub fn registry() -> &'static [Entry] {
    &[MCS, redundant::RCS, BAUMGARTE, PENALTY, AUGMENTED_LAGRANGIAN, FORCE_PROJECTION]
}

/// Matrices of the size of the velocities, states being twice as many: the model, its directions, and eigenvectors that
/// are complex.
const COPIES: f64 = 40.0;

/// Refuses all modes of so many velocities where their matrices would not fit: before a motion is followed for them.
///
/// # Errors
/// Bad input with what to use instead.
pub fn refuse_large(velocities: usize) -> Result<()> {
    refuse_all_modes(velocities, COPIES)
}

/// The linear model at the state of `variation`.
///
/// # Errors
/// An unknown method or option; a chart that does not exist there; eigenvalues that cannot be computed.
pub fn linearize(variation: &mut Variation, request: &Request) -> Result<LinearModel> {
    let entry = request.method.entry(registry())?;
    refuse_large(variation.len())?;
    let clock = Instant::now();
    let built = (entry.build)(variation, request)?;
    let assembly_seconds = clock.elapsed().as_secs_f64();
    let clock = Instant::now();
    let Spectrum { modes, conditioning, off_constraints } = spectrum(variation, &built, request)?;
    let eigen_seconds = clock.elapsed().as_secs_f64();
    let cost = Cost { assembly_seconds, eigen_seconds, conditioning, size: built.a.nrows(), off_constraints };
    let Built { chart, states, a, b, c, d, e, .. } = built;
    let (inputs, outputs) = variation.names();
    let (method, point) = (request.method.to_string(), variation.point.clone());
    Ok(LinearModel { method, chart, states, inputs, outputs, a, b, c, d, e, modes, point, cost })
}
