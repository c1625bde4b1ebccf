//! Redundant rows in a sparse factor: they are left out, and least squares is done over what they leave.
//!
//! With all coordinates before all multipliers the rest of the elimination acts on -G M^-1 G^T. A pivot that vanishes
//! there has a vanishing row, so its multiplier can be left out (zero) and nothing else changes: the others solve the
//! system exactly if the right side lies in the range of G. Every left-out row j gives a null vector of G^T:
//! n_j = e_j - c, where G^T c = G_j^T is solved with the factor itself. N = [n_j], whose part on the left-out rows is
//! the identity, so that N^T N >= I is well conditioned. Then P = I - N (N^T N)^-1 N^T makes the right side consistent
//! (least squares) and the multipliers least in norm. A few null vectors are made orthonormal once for a factorization;
//! of many, P is applied by conjugate gradients, with N^T N of an earlier factorization for a preconditioner.

use super::Pattern;
use super::Singular;
use super::fast::Fast;
use super::gram::Gram;
use super::pivot::{Quality, ROUND_OFF, Rule};
use super::system::{System, add, add_scaled, dot, index_of_largest};
use crate::math::largest;

/// Refinements where the coordinate pivots are true ones, and where some were replaced.
const SWEEPS: [usize; 2] = [3, 40];
const MOST_GRADIENTS: usize = 300;
/// Null vectors that are formed: each costs a solution, a projection by conjugate gradients two for each step.
const FEW: usize = 16;

pub(super) struct Skipping {
    factor: Fast,
    skipped: Vec<usize>,
    is_skipped: Vec<bool>,
    replaced: bool,
    is_holding: bool,
    inconsistency: f64,
    /// Orthonormal null vectors, one after the other, where they are few; and whether they belong to the last factors.
    basis: Vec<f64>,
    is_spanned: bool,
    gram: Gram,
    /// G without the rows that are held out.
    values: Vec<f64>,
    /// Scratch of n and of m numbers.
    a: Vec<f64>,
    top: Vec<f64>,
    lambda: Vec<f64>,
    bottom: Vec<f64>,
    weights: Vec<f64>,
    residual: Vec<f64>,
    direction: Vec<f64>,
    image: Vec<f64>,
    probe: (Vec<f64>, Vec<f64>),
}

impl Skipping {
    pub fn new(mass: &Pattern, g: &Pattern) -> Self {
        let (n, m) = (g.cols, g.rows);
        let zeros = || vec![0.0; m];
        Skipping {
            factor: Fast::new(mass, g, &vec![false; n]),
            skipped: Vec::with_capacity(m),
            is_skipped: vec![false; m],
            replaced: false,
            is_holding: false,
            inconsistency: 0.0,
            basis: Vec::with_capacity(FEW.min(m) * m),
            is_spanned: false,
            gram: Gram::new(),
            values: Vec::with_capacity(g.entries.len()),
            a: vec![0.0; n],
            top: vec![0.0; n],
            lambda: zeros(),
            bottom: zeros(),
            weights: zeros(),
            residual: zeros(),
            direction: zeros(),
            image: zeros(),
            probe: (vec![0.0; n], zeros()),
        }
    }

    /// Leaves out the rows that `held` names, and those with pivots that are `collapsed`. `doubtful` in what is returned: it is not sure
    /// which rows are dependent.
    pub fn factor(&mut self, system: &System, held: &[bool], collapsed: f64) -> Result<Quality, Singular> {
        self.a.fill(0.0);
        system.mass.add_diagonal(&system.mass_values, &mut self.a);
        let rule = Rule::lenient(collapsed, &self.a);
        self.is_holding = held.contains(&true);
        // A row of zeros collapses.
        self.values.clear();
        let rows = system.g.entries.iter().map(|(row, _)| held[*row]);
        self.values.extend(system.g_values.iter().zip(rows).map(|(value, held)| if held { 0.0 } else { *value }));
        let result = self.factor.factor(&system.mass_values, &self.values, rule, &mut self.skipped);
        let quality = result.map_err(|_| Singular::NotFinite)?;
        self.is_skipped.fill(false);
        self.skipped.iter().for_each(|&j| self.is_skipped[j] = true);
        self.replaced = quality.replaced;
        self.is_spanned = false;
        Ok(quality)
    }

    /// Whether the motion is determined although pivots were replaced: solves with an arbitrary right side and looks
    /// whether refinement gets rid of what was replaced.
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

    /// Pivots are squares of sines, so that round-off hides sines below 1e-7. Null vectors show them: the length (metric
    /// M^-1) of G^T N w for a mix w of the left-out rows, all scaled to the same length.
    pub fn sine(&mut self, system: &System) -> f64 {
        if self.skipped.is_empty() {
            return 0.0;
        }
        self.top.fill(0.0);
        system.mass.add_diagonal(&system.mass_values, &mut self.top);
        self.weights.fill(0.0);
        for (&(j, i), value) in system.g.entries.iter().zip(&system.g_values) {
            self.weights[j] += value * value / self.top[i];
        }
        self.direction.fill(0.0);
        for &j in &self.skipped {
            let length = self.weights[j].sqrt();
            self.direction[j] = if length > 0.0 { (1.0 + 0.5 * arbitrary(j)) / length } else { 0.0 };
        }
        self.null(system);
        self.a.fill(0.0);
        system.g.subtract_transposed(&system.g_values, &self.image, &mut self.a);
        self.a.iter().zip(&self.top).map(|(a, mass)| a * a / mass).sum::<f64>().sqrt()
    }

    pub fn rank(&self) -> usize {
        self.bottom.len() - self.skipped.len()
    }

    /// The rows that the last factorization left out.
    pub fn left_out(&self) -> &[usize] {
        &self.skipped
    }

    /// The smallest pivot over its size, but of `held` rows; zero where more are surely dependent.
    pub fn smallest_ratio(&self, held: usize) -> f64 {
        let (ratio, dependent) = self.factor.smallest_ratio(ROUND_OFF);
        if dependent > held { 0.0 } else { ratio }
    }

    /// The norm of the part of the last right side that no motion can meet.
    pub fn inconsistency(&self) -> f64 {
        self.inconsistency
    }

    /// Solves in place, refined to round-off. Right sides of rows that are held out say nothing; those of others that
    /// were left out count, in least squares. Multipliers are those of least norm where it `is_least`.
    pub fn solve(&mut self, system: &System, top: &mut [f64], bottom: &mut [f64], is_least: bool) {
        self.inconsistency = if self.is_holding { 0.0 } else { self.project(system, bottom) };
        self.a.fill(0.0);
        self.lambda.fill(0.0);
        let mut last = [f64::INFINITY; 2];
        for _ in 0..SWEEPS[usize::from(self.replaced)] {
            self.top.copy_from_slice(top);
            self.bottom.copy_from_slice(bottom);
            system.residual(&self.a, &self.lambda, &mut self.top, &mut self.bottom);
            self.factor.solve(&mut self.top, &mut self.bottom);
            let sizes = [largest(&self.top), largest(&self.bottom)];
            // A correction that does not shrink is round-off.
            if !(sizes[0] < 0.5 * last[0] || sizes[1] < 0.5 * last[1]) {
                break;
            }
            add(&self.top, &mut self.a);
            add(&self.bottom, &mut self.lambda);
            let small = 1e-16;
            if sizes[0] <= small * largest(&self.a) && sizes[1] <= small * largest(&self.lambda) {
                break;
            }
            last = sizes;
        }
        top.copy_from_slice(&self.a);
        bottom.copy_from_slice(&self.lambda);
        if is_least {
            self.project(system, bottom);
        }
    }

    /// v := P v; returns the norm of what was taken away.
    fn project(&mut self, system: &System, v: &mut [f64]) -> f64 {
        match self.skipped.len() {
            0 => 0.0,
            1..=FEW => self.project_directly(system, v),
            _ => self.project_by_gradients(system, v),
        }
    }

    fn project_directly(&mut self, system: &System, v: &mut [f64]) -> f64 {
        if !self.is_spanned {
            self.span(system);
        }
        let mut square = 0.0;
        for null in self.basis.chunks_exact(v.len()) {
            let part = dot(null, v);
            add_scaled(-part, null, v);
            square += part * part;
        }
        square.sqrt()
    }

    /// The basis, by Gram-Schmidt done twice.
    fn span(&mut self, system: &System) {
        let m = self.bottom.len();
        self.basis.clear();
        for k in 0..self.skipped.len() {
            self.direction.fill(0.0);
            self.direction[self.skipped[k]] = 1.0;
            self.null(system);
            for _ in 0..2 {
                for done in self.basis.chunks_exact(m) {
                    add_scaled(-dot(done, &self.image), done, &mut self.image);
                }
                let length = dot(&self.image, &self.image).sqrt();
                self.image.iter_mut().for_each(|x| *x /= length);
            }
            self.basis.extend_from_slice(&self.image);
        }
        self.is_spanned = true;
    }

    fn project_by_gradients(&mut self, system: &System, v: &mut [f64]) -> f64 {
        self.form_gram(system);
        self.weights.fill(0.0);
        self.residual.copy_from_slice(v);
        self.null_transposed(system);
        let tolerance = 1e-15 * dot(v, v).max(dot(&self.residual, &self.residual)).sqrt();
        self.direction.copy_from_slice(&self.residual);
        self.gram.solve(&self.skipped, &mut self.direction);
        let mut product = dot(&self.residual, &self.direction);
        let mut steps = 0;
        while steps < MOST_GRADIENTS && dot(&self.residual, &self.residual).sqrt() > tolerance {
            // image = N p, and p^T N^T N p = |N p|^2.
            self.null(system);
            let step = product / dot(&self.image, &self.image);
            add_scaled(step, &self.direction, &mut self.weights);
            // r = N^T (v - N w) afresh would cost as much as this update.
            std::mem::swap(&mut self.residual, &mut self.image);
            self.null_transposed(system);
            std::mem::swap(&mut self.residual, &mut self.image);
            add_scaled(-step, &self.image, &mut self.residual);
            self.image.copy_from_slice(&self.residual);
            self.gram.solve(&self.skipped, &mut self.image);
            let next = dot(&self.residual, &self.image);
            let ratio = next / product;
            for (p, z) in self.direction.iter_mut().zip(&self.image) {
                *p = z + ratio * *p;
            }
            (product, steps) = (next, steps + 1);
        }
        self.gram.took(steps);
        self.direction.copy_from_slice(&self.weights);
        self.null(system);
        add_scaled(-1.0, &self.image, v);
        dot(&self.image, &self.image).sqrt()
    }

    fn form_gram(&mut self, system: &System) {
        if !self.gram.is_stale(&self.skipped) {
            return;
        }
        self.gram.clear(&self.skipped);
        for k in 0..self.skipped.len() {
            self.direction.fill(0.0);
            self.direction[self.skipped[k]] = 1.0;
            self.null(system);
            self.gram.push(&self.image);
        }
        self.gram.factor();
    }

    /// image = N direction, where `direction` is zero but on the left-out rows.
    fn null(&mut self, system: &System) {
        self.a.fill(0.0);
        system.g.subtract_transposed(&system.g_values, &self.direction, &mut self.a);
        self.image.fill(0.0);
        self.factor.solve(&mut self.a, &mut self.image);
        add(&self.direction, &mut self.image);
    }

    /// residual := N^T residual, standing on the left-out rows.
    fn null_transposed(&mut self, system: &System) {
        self.a.fill(0.0);
        self.lambda.copy_from_slice(&self.residual);
        self.factor.solve(&mut self.a, &mut self.lambda);
        system.g.subtract(&system.g_values, &self.a, &mut self.residual);
        for (r, &skipped) in self.residual.iter_mut().zip(&self.is_skipped) {
            *r = if skipped { *r } else { 0.0 };
        }
    }
}

/// Numbers in [-1, 1] without pattern.
fn arbitrary(i: usize) -> f64 {
    (1.0 + 0.7 * i as f64 * (i as f64 + 3.0)).sin()
}
