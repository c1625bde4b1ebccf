//! The saddle-point matrix itself, for residuals and scaling.

use super::ldlt::Ldlt;
use super::{Analysis, Pattern};
use crate::math::largest;
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

/// Solves [M G^T; G 0] [a; lambda] = [top; bottom] with a factor that may be of a nearby matrix, in at most `sweeps`
/// corrections, until a correction is round-off. `residual` is scratch.
pub(super) fn iterate(
    factor: &mut Ldlt,
    system: &System,
    (top, bottom): (&[f64], &[f64]),
    (a, lambda): (&mut [f64], &mut [f64]),
    (r1, r2): (&mut [f64], &mut [f64]),
    sweeps: usize,
) {
    a.fill(0.0);
    lambda.fill(0.0);
    let mut last = [f64::INFINITY; 2];
    for _ in 0..sweeps {
        r1.copy_from_slice(top);
        r2.copy_from_slice(bottom);
        system.residual(a, lambda, r1, r2);
        factor.solve(r1, r2);
        let sizes = [largest(r1), largest(r2)];
        // A correction that does not shrink is round-off.
        if !(sizes[0] < 0.5 * last[0] || sizes[1] < 0.5 * last[1]) {
            break;
        }
        add(r1, a);
        add(r2, lambda);
        let small = 1e-16;
        if sizes[0] <= small * largest(a) && sizes[1] <= small * largest(lambda) {
            break;
        }
        last = sizes;
    }
}

/// Scales that make the masses one and the rows of G of unit norm in the mass metric, (G diag(M)^-1 G^T)_jj = 1, by
/// node. Late coordinates (by default those without mass) are scaled by the entries of the scaled rows.
pub(super) fn balance(
    (mass, mass_values): (&Pattern, &[f64]),
    (g, g_values): (&Pattern, &[f64]),
    late: Option<&[bool]>,
    scale: &mut [f64],
) {
    scale.fill(0.0);
    let (coordinates, rows) = scale.split_at_mut(mass.rows);
    mass.add_diagonal(mass_values, coordinates);
    for (i, s) in coordinates.iter_mut().enumerate() {
        let is_late = late.map_or(*s <= 0.0, |late| late[i]);
        *s = if is_late { 0.0 } else { inverse_root(*s) };
    }
    for (&(j, i), value) in g.entries.iter().zip(g_values) {
        rows[j] += (value * coordinates[i]).powi(2);
    }
    rows.iter_mut().for_each(|s| *s = inverse_root(*s));
    // Squares of late coordinates are summed with negative sign, which tells them from scales.
    for (&(j, i), value) in g.entries.iter().zip(g_values) {
        if coordinates[i] <= 0.0 {
            coordinates[i] -= (value * rows[j]).powi(2);
        }
    }
    coordinates.iter_mut().filter(|s| **s <= 0.0).for_each(|s| *s = inverse_root(-*s));
}

fn inverse_root(square: f64) -> f64 {
    if square > 0.0 { square.sqrt().recip() } else { 1.0 }
}

pub(super) fn add(x: &[f64], y: &mut [f64]) {
    for (y, x) in y.iter_mut().zip(x) {
        *y += x;
    }
}

/// y += factor x.
pub(super) fn add_scaled(factor: f64, x: &[f64], y: &mut [f64]) {
    for (y, x) in y.iter_mut().zip(x) {
        *y += factor * x;
    }
}

/// The index of the entry of largest magnitude.
pub(super) fn index_of_largest(x: &[f64]) -> usize {
    (0..x.len()).fold(0, |best, i| if x[i].abs() > x[best].abs() { i } else { best })
}
