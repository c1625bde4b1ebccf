//! Condition number of the saddle-point matrix, for reports.

use super::super::supernodal::balance;
use super::super::system::System;
use super::{SaddlePoint, Singular};
use crate::math::{add, norm};
use crate::tolerances;
use faer::{Mat, Side};

impl SaddlePoint {
    /// The 2-norm condition number of E K E, where the diagonal E makes the masses one and the rows of G of unit norm in
    /// the mass metric, so that it does not depend on units; without dropped rows. By the eigenvalues up to n + m = 600,
    /// beyond by power iterations (a lower bound, close in practice). Factors with these values.
    /// Infinite for singular matrices, NaN if the values are not finite or do not fit.
    pub fn condition_number(&mut self, mass: &[f64], g: &[f64]) -> f64 {
        let factored = self.factor(mass, g);
        if factored == Err(Singular::Shape) || !mass.iter().chain(g).all(|v| v.is_finite()) {
            return f64::NAN;
        }
        if let (true, Some(kept)) = (self.drops_rows, &mut self.kept) {
            return kept.condition_number(mass);
        }
        self.system.store(mass, g);
        let mut scale = vec![1.0; self.n + self.m];
        balance(&self.system.mass, mass, &self.system.g, g, None, &mut scale);
        if scale.is_empty() {
            1.0
        } else if scale.len() <= tolerances::DENSE_EQUATIONS {
            by_eigenvalues(&self.system, &scale)
        } else if factored.is_err() || self.is_rank_deficient() {
            f64::INFINITY
        } else {
            self.condition_by_iteration(&scale)
        }
    }

    fn condition_by_iteration(&mut self, scale: &[f64]) -> f64 {
        let n = self.n;
        let system = &self.system;
        let times = |x: &[f64], y: &mut [f64]| {
            y.fill(0.0);
            let (top, bottom) = y.split_at_mut(n);
            system.residual(&x[..n], &x[n..], top, bottom);
            true
        };
        let largest = power(scale, |s| *s, times);
        let inverse = |x: &[f64], y: &mut [f64]| {
            y.fill(0.0);
            add(x, y);
            let (top, bottom) = y.split_at_mut(n);
            self.solve(top, bottom).is_ok()
        };
        largest * power(scale, |s| s.recip(), inverse)
    }
}

/// Calls `f(node, node, value)` for one triangle of K.
fn for_each_entry(system: &System, mut f: impl FnMut(usize, usize, f64)) {
    let n = system.mass.rows;
    system.mass.entries.iter().zip(&system.mass_values).for_each(|(&(i, j), &v)| f(i, j, v));
    system.g.entries.iter().zip(&system.g_values).for_each(|(&(j, i), &v)| f(n + j, i, v));
}

fn by_eigenvalues(system: &System, scale: &[f64]) -> f64 {
    let mut matrix = Mat::<f64>::zeros(scale.len(), scale.len());
    for_each_entry(system, |a, b, value| matrix[(a.max(b), a.min(b))] += value * scale[a] * scale[b]);
    faer::set_global_parallelism(faer::Par::Seq);
    let Ok(eigenvalues) = matrix.self_adjoint_eigenvalues(Side::Lower) else { return f64::NAN };
    let sizes = eigenvalues.iter().map(|v| v.abs());
    let (smallest, largest) = sizes.fold((f64::INFINITY, 0.0), |(a, b): (f64, f64), v| (a.min(v), b.max(v)));
    // An eigenvalue below round-off of the largest is zero.
    if smallest <= f64::EPSILON * largest { f64::INFINITY } else { largest / smallest }
}

/// The largest |eigenvalue| of E A E, where `apply` multiplies by A (up to sign) and returns false on failure.
fn power(scale: &[f64], e: impl Fn(&f64) -> f64, mut apply: impl FnMut(&[f64], &mut [f64]) -> bool) -> f64 {
    let mut x: Vec<f64> = (0..scale.len()).map(|i| (1.0 + 0.7 * i as f64 * (i as f64 + 3.0)).sin()).collect();
    let mut y = x.clone();
    let mut stretch = 0.0;
    // Power iterations: the condition number is told with two digits.
    for _ in 0..40 {
        let length = norm(&x);
        x.iter_mut().zip(scale).for_each(|(x, s)| *x *= e(s) / length);
        if !apply(&x, &mut y) {
            return f64::INFINITY;
        }
        y.iter_mut().zip(scale).for_each(|(y, s)| *y *= e(s));
        stretch = norm(&y);
        std::mem::swap(&mut x, &mut y);
    }
    stretch
}
