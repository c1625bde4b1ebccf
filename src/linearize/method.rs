//! The methods of linearization, and what each makes.

use super::spectrum::{Spectrum, spectrum};
use super::unconstrained::{AUGMENTED_LAGRANGIAN, BAUMGARTE, FORCE_PROJECTION, PENALTY};
use super::variation::refuse_all_modes;
use super::{Changes, Chart, Cost, LinearModel, Matrix, Minimal, Variation, minimal, redundant};
use crate::choice::{Choice, Listed, OptionDoc};
use crate::error::Result;
use std::time::Instant;

/// What is asked for.
#[derive(Clone, Debug, PartialEq)]
pub struct Request {
    pub method: Choice,
    /// Of minimal coordinates; none: `intrinsic` where the equations allow it, else `mass_orthogonal`.
    pub chart: Option<Chart>,
}

impl Request {
    pub(super) fn chart(&self, variation: &mut Variation) -> Chart {
        self.chart.clone().unwrap_or_else(|| Chart::preferred(variation))
    }
}

/// The matrices of a method.
pub struct Built {
    pub chart: String,
    pub states: Vec<String>,
    pub a: Matrix,
    pub b: Matrix,
    pub c: Matrix,
    pub d: Matrix,
    pub e: Option<Matrix>,
    /// (dq, dv) of each state.
    pub changes: Changes,
    /// How many eigenvalues are infinite.
    pub infinite: usize,
}

impl Built {
    pub fn minimal(model: Minimal) -> Self {
        let Minimal { coordinates, changes, a, b, c, d } = model;
        Built { chart: coordinates.name, states: coordinates.states, a, b, c, d, e: None, changes, infinite: 0 }
    }
}

/// One method as the command line and the table of methods know it.
pub struct Entry {
    pub name: &'static str,
    pub about: &'static str,
    pub options: &'static [OptionDoc],
    pub build: fn(&mut Variation, &Request) -> Result<Built>,
}

/// Minimal coordinates: see [`minimal`].
const MCS: Entry = Entry {
    name: "mcs",
    about: "minimal coordinates in a chart: exact at every state, no spurious eigenvalues",
    options: &[],
    build: |variation, request| {
        let chart = request.chart(variation);
        Ok(Built::minimal(minimal(variation, &chart)?))
    },
};

impl Listed for Entry {
    const KIND: &'static str = "method";

    fn name(&self) -> &'static str {
        self.name
    }

    fn options(&self) -> &'static [OptionDoc] {
        self.options
    }
}

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
