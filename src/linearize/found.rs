//! The eigenvalues at one state of a survey.

use super::slopes::Slope;
use super::{LinearModel, LociPoint, Operating, State, Variation};
use crate::error::Warning;

/// Result at one state.
#[derive(Clone)]
pub(super) struct StateResult {
    pub state: State,
    /// The eigenvalues.
    pub sample: LociPoint,
    pub method: String,
    pub chart: String,
    pub is_equilibrium: bool,
    pub turning: Option<f64>,
    pub doubt: Option<Warning>,
}

impl StateResult {
    /// The eigenvalues of a model at a time or value.
    pub fn new(operating: &Operating, variation: &Variation, at: f64, model: LinearModel) -> Self {
        let doubt = operating.doubt.clone().or(model.doubt());
        StateResult {
            state: operating.state.clone(),
            is_equilibrium: model.point.is_equilibrium,
            turning: model.point.axes.map(|spin| spin.speed()),
            sample: LociPoint { at, modes: model.modes, mass: variation.mass(), slopes: Vec::new() },
            method: model.method,
            chart: model.chart,
            doubt,
        }
    }

    /// The same with derivatives.
    pub fn with_slopes(mut self, slopes: Vec<Slope>) -> Self {
        self.sample.slopes = slopes;
        self
    }
}
