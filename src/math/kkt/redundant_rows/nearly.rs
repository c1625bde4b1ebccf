//! Approximate part of a vector in the null space of G^T, by one sparse factorization for any number of dependent rows.
//!
//! With D = diag M and a small delta
//!
//! ```text
//! [I    G       ] [nu]   [v]
//! [G^T  -delta D] [y ] = [0]
//! ```
//!
//! nu is delta/(delta + sigma^2) times the part of v along an eigenvector of G D^-1 G^T with eigenvalue sigma^2: all of
//! the part in the null space, and the less of the others the smaller delta is. The system has the form of that of the
//! motion, with the multipliers as coordinates and, for delta D, one more coordinate in each row, and is factored in
//! the same way.

use super::super::Pattern;
use super::super::ldlt::Ldlt;
use super::super::pivot::Rule;
use super::super::system::System;
use crate::tolerances::math as tolerances;

pub struct Nearly {
    factor: Ldlt,
    /// 1 for the multipliers, 1 / (delta D) for the added coordinates.
    mass: Vec<f64>,
    /// G^T, then the identity.
    g: Vec<f64>,
    skipped: Vec<usize>,
    diagonal: Vec<f64>,
    lengths: Vec<f64>,
    top: Vec<f64>,
    bottom: Vec<f64>,
}

impl Nearly {
    pub fn new(system: &System) -> Self {
        let Pattern { rows: m, cols: n, entries } = &*system.g;
        let patterns = || {
            let beside = (0..*n).map(|i| (i, m + i));
            let entries = entries.iter().map(|&(row, column)| (column, row)).chain(beside).collect();
            [Pattern::diagonal(m + n), Pattern { rows: *n, cols: m + n, entries }]
        };
        let (mass, transposed, plan) = system.analysis.nearly(patterns);
        let mut g = vec![1.0; transposed.entries.len()];
        g[..entries.len()].fill(0.0);
        Nearly {
            factor: Ldlt::of(plan, mass, transposed, &vec![false; m + n]),
            mass: vec![1.0; m + n],
            g,
            skipped: Vec::with_capacity(*n),
            diagonal: vec![0.0; *n],
            lengths: vec![0.0; *m],
            top: vec![0.0; m + n],
            bottom: vec![0.0; *n],
        }
    }

    /// Factors with the values of the system; `rank_indicator` is that of the independent rows of G.
    pub fn factor(&mut self, system: &System, rank_indicator: f64) {
        let Nearly { factor, mass, g, skipped, diagonal, lengths, .. } = self;
        diagonal.fill(0.0);
        system.mass.add_diagonal(&system.mass_values, diagonal);
        let largest = diagonal.iter().copied().fold(f64::MIN_POSITIVE, f64::max);
        // Coordinates without mass get the largest of the others.
        diagonal.iter_mut().filter(|d| **d <= 0.0).for_each(|d| *d = largest);
        lengths.fill(0.0);
        let entries = system.g.entries.iter().zip(&system.g_values);
        entries.for_each(|((row, column), value)| lengths[*row] += value * value / diagonal[*column]);
        let delta = (tolerances::REGULARIZATION * rank_indicator * rank_indicator)
            .max(tolerances::ROUND_OFF_OF_FACTORS)
            * lengths.iter().copied().fold(0.0, f64::max);
        mass[lengths.len()..].iter_mut().zip(&*diagonal).for_each(|(beside, d)| *beside = 1.0 / (delta * d));
        g[..system.g_values.len()].copy_from_slice(&system.g_values);
        // Pivots of coordinates in no row are as small as delta; none is zero except by round-off.
        let _ = factor.factor(mass, g, Rule::lenient(f64::MIN_POSITIVE, mass), skipped);
    }

    /// v := nu.
    pub fn null_part(&mut self, v: &mut [f64]) {
        for _ in 0..tolerances::REGULARIZED_SOLUTIONS {
            self.top.fill(0.0);
            self.top[..v.len()].copy_from_slice(v);
            self.bottom.fill(0.0);
            self.factor.solve(&mut self.top, &mut self.bottom);
            v.copy_from_slice(&self.top[..v.len()]);
        }
    }
}
