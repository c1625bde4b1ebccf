//! The model that is validated.

use super::Settings;
use super::perturb::{Norm, Speed};
use crate::error::Result;
use crate::linearize::{CarriedChart, Chart, LinearMatrices, Minimal, State, Variation, minimal};
use crate::system::MechanicalSystem;

/// The model at a state, with the motion from there and the measures of its changes.
pub struct Subject<'a> {
    pub system: &'a dyn MechanicalSystem,
    pub start: &'a State,
    pub model: Minimal,
    /// Name of the chart that was asked for.
    pub chart: String,
    /// True for the plain projection, which belongs to no chart.
    pub is_projected: bool,
    pub carried: CarriedChart<'a>,
    pub speed: Speed,
    pub norm: Norm,
    /// True when the time is over.
    pub is_over: &'a dyn Fn() -> bool,
}

impl<'a> Subject<'a> {
    /// The model of `variation`, which is at `start`, with a `change` whose effect is looked for.
    ///
    /// # Errors
    /// A chart that does not exist at the state.
    pub fn new(
        variation: &mut Variation<'a>,
        start: &'a State,
        settings: &Settings,
        is_over: &'a dyn Fn() -> bool,
        change: impl FnOnce(&mut LinearMatrices),
    ) -> Result<Self> {
        let chart = settings.chart.clone().unwrap_or_else(|| Chart::preferred(variation));
        let mut model = minimal(variation, &chart)?;
        let name = model.coordinates.name.clone();
        // The plain projection has no chart that follows the motion; its states are those of the mass-orthogonal one.
        let is_projected = chart == Chart::Frozen;
        let chart = if is_projected { Chart::MassOrthogonal } else { chart };
        let carried = CarriedChart::new(variation, &chart, is_over)?;
        model.coordinates = carried.start.clone();
        let speed = Speed::of(&model)?;
        change(&mut model.built);
        let norm = Norm { rate: speed.usual };
        Ok(Subject {
            system: variation.system(),
            start,
            model,
            chart: name,
            is_projected,
            carried,
            speed,
            norm,
            is_over,
        })
    }
}
