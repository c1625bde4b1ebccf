//! The saddle-point matrix itself, for residuals.

use super::{Analysis, Pattern};
use std::sync::Arc;

/// The patterns and a copy of the values of the last factorization that needs them; room is taken up by the first.
pub(super) struct System {
    pub mass: Arc<Pattern>,
    pub g: Arc<Pattern>,
    pub analysis: Arc<Analysis>,
    pub mass_values: Vec<f64>,
    pub g_values: Vec<f64>,
}

impl System {
    pub fn new(mass: &Pattern, g: &Pattern) -> Self {
        Self::of(Arc::new(mass.clone()), Arc::new(g.clone()), Arc::default())
    }

    pub fn of(mass: Arc<Pattern>, g: Arc<Pattern>, analysis: Arc<Analysis>) -> Self {
        let room = |pattern: &Pattern| Vec::with_capacity(pattern.entries.len());
        System { mass_values: room(&mass), g_values: room(&g), mass, g, analysis }
    }

    /// Stores values; lengths must be those of the patterns.
    pub fn store(&mut self, mass: &[f64], g: &[f64]) {
        for (own, values) in [(&mut self.mass_values, mass), (&mut self.g_values, g)] {
            own.clear();
            own.extend_from_slice(values);
        }
    }

    /// top -= M a + G^T lambda, bottom -= G a.
    pub fn residual(&self, a: &[f64], lambda: &[f64], top: &mut [f64], bottom: &mut [f64]) {
        self.mass.subtract_symmetric(&self.mass_values, a, top);
        self.g.subtract_transposed(&self.g_values, lambda, top);
        self.g.subtract(&self.g_values, a, bottom);
    }
}
