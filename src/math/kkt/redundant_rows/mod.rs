//! Redundant rows of G, by sparse factorizations.
//!
//! With all coordinates before all multipliers the elimination of the latter acts on -G M^-1 G^T. A pivot that vanishes
//! there has a vanishing row, so its multiplier can be dropped (zero) and nothing else changes: the others solve the
//! system exactly if the right side lies in the range of G, which `least` makes sure of, and multipliers of least norm
//! are made of any by the same projection.

mod least;

pub use least::{Least, has_least_norm};

use super::Singular;
use super::ldlt::Ldlt;
use super::pivot::{Quality, Rule};
use super::system::System;
use crate::math::{add, index_of_largest, largest};
use crate::tolerances;

pub(super) struct RedundantRowSolve {
    factor: Ldlt,
    skipped: Vec<usize>,
    replaced: bool,
    inconsistency: f64,
    least: Least,
    /// Scratch: n and m numbers.
    a: Vec<f64>,
    top: Vec<f64>,
    lambda: Vec<f64>,
    bottom: Vec<f64>,
    lengths: Vec<f64>,
    probe: (Vec<f64>, Vec<f64>),
}

impl RedundantRowSolve {
    pub fn new(System { mass, g, analysis, .. }: &System) -> Self {
        let n = g.cols;
        let m = g.rows;
        let early = vec![false; n];
        let zeros = || vec![0.0; m];
        RedundantRowSolve {
            factor: Ldlt::of(&analysis.plan(mass, g, &early), mass, g, &early),
            skipped: Vec::with_capacity(m),
            replaced: false,
            inconsistency: 0.0,
            least: Least::new(g),
            a: vec![0.0; n],
            top: vec![0.0; n],
            lambda: zeros(),
            bottom: zeros(),
            lengths: zeros(),
            probe: (vec![0.0; n], zeros()),
        }
    }

    /// Drops rows with pivots at or below `collapsed`. The result is `doubtful` if it is not certain which rows are
    /// dependent.
    pub fn factor(&mut self, system: &System, collapsed: f64) -> Result<Quality, Singular> {
        self.a.fill(0.0);
        system.mass.add_diagonal(&system.mass_values, &mut self.a);
        let rule = Rule::lenient(collapsed, &self.a);
        let result = self.factor.factor(&system.mass_values, &system.g_values, rule, &mut self.skipped);
        let quality = result.map_err(|_| Singular::NotFinite)?;
        self.replaced = quality.replaced;
        self.least.clear();
        Ok(quality)
    }

    /// Checks that the motion is determined although pivots were replaced: solves with an arbitrary right side and
    /// tests whether refinement corrects for the replaced pivots.
    pub fn probe(&mut self, system: &System) -> Result<(), Singular> {
        let (mut top, mut bottom) = std::mem::take(&mut self.probe);
        bottom.fill(0.0);
        top.iter_mut().enumerate().for_each(|(i, v)| *v = arbitrary(i));
        self.solve(system, &mut top, &mut bottom, false);
        let coordinate = index_of_largest(&top);
        self.top.iter_mut().enumerate().for_each(|(i, v)| *v = arbitrary(i));
        self.bottom.fill(0.0);
        system.residual(&top, &bottom, &mut self.top, &mut self.bottom);
        // Written so that a NaN is an error.
        self.probe = (top, bottom);
        let is_solved = self.top.iter().all(|v| v.abs() < 1e-6);
        if is_solved { Ok(()) } else { Err(Singular::Undetermined { coordinate }) }
    }

    /// Rank indicator of the dropped rows. Pivots are squares of sines, so that round-off hides sines below 1e-7. Null
    /// vectors show them: the length (metric M^-1) of G^T N w for a combination w of the dropped rows, all scaled to
    /// the same length.
    pub fn rank_indicator(&mut self, system: &System) -> f64 {
        if self.skipped.is_empty() {
            return 0.0;
        }
        let RedundantRowSolve { factor, skipped, least, a, top: mass, lengths, .. } = self;
        mass.fill(0.0);
        system.mass.add_diagonal(&system.mass_values, mass);
        lengths.fill(0.0);
        for (&(j, i), value) in system.g.entries.iter().zip(&system.g_values) {
            lengths[j] += value * value / mass[i];
        }
        lengths.iter_mut().for_each(|square| *square = square.sqrt());
        let combine = |direction: &mut [f64]| {
            for &j in skipped.iter().filter(|j| lengths[**j] > 0.0) {
                direction[j] = (1.0 + 0.5 * arbitrary(j)) / lengths[j];
            }
        };
        let null = least.null(system, combine, &mut |top, bottom| factor.solve(top, bottom));
        a.fill(0.0);
        system.g.subtract_transposed(&system.g_values, null, a);
        a.iter().zip(&*mass).map(|(a, mass)| a * a / mass).sum::<f64>().sqrt()
    }

    /// Rows that the last factorization dropped.
    pub fn left_out(&self) -> &[usize] {
        &self.skipped
    }

    /// The smallest ratio of a pivot to its size; zero if rows are surely dependent.
    pub fn smallest_ratio(&self) -> f64 {
        let (ratio, dependent) = self.factor.smallest_ratio(tolerances::ROUND_OFF_OF_FACTORS);
        if dependent > 0 { 0.0 } else { ratio }
    }

    /// The smallest ratio of a pivot to its size without the rows that are dropped.
    pub fn kept_ratio(&self) -> f64 {
        self.factor.smallest_ratio(tolerances::ROUND_OFF_OF_SOLUTIONS).0
    }

    /// Norm of the inconsistent part of the last right side r2.
    pub fn inconsistency(&self) -> f64 {
        self.inconsistency
    }

    /// Solves in place, refined to round-off; contradicting right sides by least squares. If `is_least`, multipliers
    /// are those of least norm.
    pub fn solve(&mut self, system: &System, top: &mut [f64], bottom: &mut [f64], is_least: bool) {
        self.inconsistency = self.project(system, bottom);
        self.iterate(system, top, bottom);
        top.copy_from_slice(&self.a);
        bottom.copy_from_slice(&self.lambda);
        if is_least {
            self.project(system, bottom);
        }
    }

    /// [M G^T; G 0] [a; lambda] = [top; bottom] with a factor that may be of a nearby matrix: corrected until a
    /// correction is round-off.
    fn iterate(&mut self, system: &System, top: &[f64], bottom: &[f64]) {
        let RedundantRowSolve { factor, a, lambda, top: r1, bottom: r2, replaced, .. } = self;
        a.fill(0.0);
        lambda.fill(0.0);
        let mut last = [f64::INFINITY; 2];
        // Replaced masses make the contraction slow.
        let refinements = if *replaced { 40 } else { 3 };
        for _ in 0..refinements {
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

    /// v := P v; returns the norm of the removed part.
    fn project(&mut self, system: &System, v: &mut [f64]) -> f64 {
        let RedundantRowSolve { factor, least, skipped, .. } = self;
        least.project(system, skipped, &mut |top, bottom| factor.solve(top, bottom), v)
    }
}

/// Numbers in [-1, 1] without pattern.
fn arbitrary(i: usize) -> f64 {
    (1.0 + 0.7 * i as f64 * (i as f64 + 3.0)).sin()
}
