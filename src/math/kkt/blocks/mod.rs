//! Block L D L^T over a frozen pattern.
//!
//! The saddle-point matrix is a matrix of small blocks, one for a body and a joint on it, in the order of
//! [`order`](super::order). Right-looking: with its diagonal block factored, L_jj D_j L_jj^T, column j subtracts
//!
//! ```text
//! A_kl -= X_k D_j^-1 X_l^T,      X_k = A_kj L_jj^-T = L_kj D_j
//! ```
//!
//! from the blocks right of it. For a rigid body that is the part of G M^-1 G^T that the body couples two of its joints
//! by, for a joint one update of Gaussian elimination. Pivots are those of the scalar factorization, and are judged one
//! by one. Rigid bodies come first, without places of their own ([`bodies`]).

mod bodies;
mod dense;
mod groups;
mod judge;
mod kernels;
mod layout;
mod schur;

use super::pivot::{Quality, Rule};
use super::system::add;
use dense::Dense;
pub(super) use groups::Groups;
pub(super) use judge::Judge;
use kernels::{Elimination, Solution};
pub(super) use layout::Layout;
use layout::Run;
use schur::{Passage, Schur};
use std::ops::Range;
use std::sync::Arc;

/// The factors, with the memory to make them and to solve.
pub(super) struct Blocks {
    layout: Arc<Layout>,
    /// Number of coordinates.
    n: usize,
    /// D, L_jj and X at the places of the layout.
    work: Vec<f64>,
    /// Inverses of the pivots, and what they are compared with, by position.
    inverse: Vec<f64>,
    sizes: Vec<f64>,
    x: Vec<f64>,
    /// Values of G, inverses of the masses of bodies by coordinate, and L of those whose M is not diagonal.
    pub g: Vec<f64>,
    inverse_masses: Vec<f64>,
    lower: Vec<f64>,
    /// Values of M that these belong to; empty if some of them were judged.
    mass: Vec<f64>,
}

/// Calls a method with the widths of a run's columns and of their partners as constants, and their product: those of
/// usual joints (one row, hinge and sphere in the plane and in space), or another method for the other runs.
macro_rules! by_widths {
    ($run:ident, $part:ident, $alike:ident, $mixed:ident) => {
        match ($run.width, $run.partner_width) {
            (1, 1) => $part.$alike::<1, 1, 1>($run),
            (2, 1) => $part.$alike::<2, 1, 2>($run),
            (2, 2) => $part.$alike::<2, 2, 4>($run),
            (3, 1) => $part.$alike::<3, 1, 3>($run),
            (3, 2) => $part.$alike::<3, 2, 6>($run),
            (3, 3) => $part.$alike::<3, 3, 9>($run),
            (5, 5) => $part.$alike::<5, 5, 25>($run),
            (6, 1) => $part.$alike::<6, 1, 6>($run),
            (6, 3) => $part.$alike::<6, 3, 18>($run),
            (6, 5) => $part.$alike::<6, 5, 30>($run),
            (1, _) => $part.$mixed::<1>($run),
            (2, _) => $part.$mixed::<2>($run),
            (3, _) => $part.$mixed::<3>($run),
            (4, _) => $part.$mixed::<4>($run),
            (5, _) => $part.$mixed::<5>($run),
            (6, _) => $part.$mixed::<6>($run),
            (7, _) => $part.$mixed::<7>($run),
            _ => $part.$mixed::<{ groups::LARGEST }>($run),
        }
    };
}

/// The same for bodies, whose points with all their translations in the plane and in space are levers.
macro_rules! by_kinds {
    ($run:ident, $part:ident, $levers:ident::<$plane:tt, $space:tt>, $alike:ident, $mixed:ident) => {
        match ($run.are_levers, $run.width, $run.partner_width) {
            (true, 3, 2) => by_kinds!(@ $part.$levers $plane($run)),
            (true, 6, 3) => by_kinds!(@ $part.$levers $space($run)),
            _ => by_widths!($run, $part, $alike, $mixed),
        }
    };
    (@ $part:ident.$levers:ident [$($n:literal),*]($run:ident)) => { $part.$levers::<$($n),*>($run) };
}

impl Blocks {
    /// For M and G of the layout, with `n` coordinates.
    pub fn new(layout: Arc<Layout>, n: usize) -> Self {
        let zeros = || vec![0.0; layout.nodes.len()];
        Blocks {
            n,
            work: vec![0.0; layout.len],
            inverse: zeros(),
            sizes: zeros(),
            x: zeros(),
            g: Vec::new(),
            inverse_masses: vec![0.0; n],
            lower: vec![0.0; layout.bodies.dense.last().map_or(0, Dense::end)],
            mass: Vec::new(),
            layout,
        }
    }

    /// Takes the memory for these numbers of values of M and of G at once.
    pub fn reserve(&mut self, mass: usize, g: usize) {
        self.mass.reserve(mass);
        self.g.resize(g, 0.0);
    }

    /// Factors. The pivot of an early coordinate is compared with its mass; that of a multiplier with (G M^-1 G^T)_jj,
    /// which is on its diagonal after elimination of the early coordinates; that of a late coordinate with what the
    /// early ones subtracted from it. So units of coordinates and rows cancel. The error is the node whose pivot
    /// collapsed.
    pub fn factor(&mut self, mass: &[f64], g: &[f64], rule: Rule, skipped: &mut Vec<usize>) -> Result<Quality, usize> {
        self.g.clear();
        self.g.extend_from_slice(g);
        let mut judge = self.judge(rule, skipped);
        self.factor_own(mass, &mut judge)?;
        self.factor_last(&mut judge)?;
        Ok(judge.quality)
    }

    pub fn judge<'a>(&self, rule: Rule, skipped: &'a mut Vec<usize>) -> Judge<'a> {
        Judge { n: self.n, rule, skipped, quality: Quality::GOOD }
    }

    /// Factors all but the last columns, with the values of G in place.
    pub fn factor_own(&mut self, mass: &[f64], judge: &mut Judge) -> Result<(), usize> {
        self.invert(mass, judge)?;
        self.work.fill(0.0);
        let Blocks { layout, work, sizes, g, lower, .. } = self;
        layout.bodies.dense.iter().for_each(|body| body.transform(lower, g));
        layout.mass_slots.iter().for_each(|&(entry, slot)| work[slot as usize] += mass[entry as usize]);
        layout.g_slots.iter().for_each(|&(entry, slot)| work[slot as usize] += g[entry as usize]);
        layout.coordinates.iter().for_each(|&(_, p)| sizes[p as usize] = work[layout.diagonal(p)]);
        let (early, own) = (layout.early_runs(), layout.own_runs);
        self.reduce();
        self.eliminate(0..early, judge)?;
        let Blocks { layout, work, sizes, .. } = self;
        layout.late.iter().for_each(|&p| sizes[p as usize] -= work[layout.diagonal(p)]);
        layout.g_rows.iter().for_each(|&p| sizes[p as usize] = -work[layout.diagonal(p)]);
        self.eliminate(early..own, judge)
    }

    /// Factors the last columns.
    pub fn factor_last(&mut self, judge: &mut Judge) -> Result<(), usize> {
        self.eliminate(self.layout.own_runs..self.layout.runs.len(), judge)
    }

    /// Adds what another part of a matrix has in the last columns, which are common to both.
    pub fn add_last(&mut self, other: &Blocks) {
        let [(position, place), (from, its)] = [self.layout.last, other.layout.last];
        add(&other.work[its..], &mut self.work[place..]);
        add(&other.sizes[from..], &mut self.sizes[position..]);
    }

    /// The inverse masses of bodies, unless they are known.
    fn invert(&mut self, mass: &[f64], judge: &mut Judge) -> Result<(), usize> {
        if self.mass == mass {
            return Ok(());
        }
        self.mass.clear();
        for &(entry, i) in &self.layout.bodies.masses {
            self.inverse_masses[i] = judge.inverse(mass[entry], (mass[entry], 1.0), || i)?;
        }
        for body in &self.layout.bodies.dense {
            body.factor(mass, (&mut self.lower, &mut self.inverse_masses), judge)?;
        }
        if !judge.quality.weak && !judge.quality.replaced {
            self.mass.extend_from_slice(mass);
        }
        Ok(())
    }

    /// S -= G M^-1 G^T of bodies.
    fn reduce(&mut self) {
        let Blocks { layout, work, g, inverse_masses, .. } = self;
        let mut part = Schur { bodies: &layout.bodies, g, inverse: inverse_masses, work };
        for run in &layout.bodies.runs {
            by_kinds!(run, part, levers::<[2, 1, 3, 6, 4], [3, 3, 6, 18, 9]>, alike, mixed);
        }
    }

    fn eliminate(&mut self, runs: Range<usize>, judge: &mut Judge) -> Result<(), usize> {
        let Blocks { layout, work, inverse, sizes, .. } = self;
        let mut part = Elimination { layout, work, inverse, sizes, judge };
        for run in &layout.runs[runs] {
            by_widths!(run, part, alike, mixed)?;
        }
        Ok(())
    }

    /// Solves in place; dropped multipliers are zero. 2 multiplications for each entry of L.
    pub fn solve(&mut self, top: &mut [f64], bottom: &mut [f64]) {
        self.forward(top, bottom);
        self.solve_last();
        self.backward(top, bottom);
    }

    /// The way forward for all but the last columns, see [`Self::last`].
    pub fn forward(&mut self, top: &mut [f64], bottom: &[f64]) {
        let Blocks { layout, x, g, inverse_masses, lower, .. } = self;
        layout.bodies.dense.iter().for_each(|body| body.enter(lower, top));
        layout.coordinates.iter().for_each(|&(i, p)| x[p as usize] = top[i as usize]);
        layout.g_rows.iter().zip(bottom).for_each(|(&p, value)| x[p as usize] = *value);
        let mut bodies = Passage { bodies: &layout.bodies, g, inverse: inverse_masses, top, x };
        for run in &layout.bodies.runs {
            by_kinds!(run, bodies, forward_levers::<[2, 1, 3, 6], [3, 3, 6, 18]>, forward, forward_by_rows);
        }
        self.solve_forward(0..self.layout.own_runs);
    }

    /// Both ways for the last columns.
    pub fn solve_last(&mut self) {
        let last = self.layout.own_runs..self.layout.runs.len();
        self.solve_forward(last.clone());
        self.solve_backward(last);
    }

    fn solve_forward(&mut self, runs: Range<usize>) {
        let Blocks { layout, work, inverse, x, .. } = self;
        let mut part = Solution { layout, work, inverse, x };
        for run in &layout.runs[runs] {
            by_widths!(run, part, forward, forward_by_rows);
        }
    }

    fn solve_backward(&mut self, runs: Range<usize>) {
        let Blocks { layout, work, inverse, x, .. } = self;
        let mut part = Solution { layout, work, inverse, x };
        for run in layout.runs[runs].iter().rev() {
            by_widths!(run, part, backward, backward_by_rows);
        }
    }

    /// The right sides of the last columns after the way forward, then their solution.
    pub fn last(&mut self) -> &mut [f64] {
        &mut self.x[self.layout.last.0..]
    }

    /// The way back for all but the last columns.
    pub fn backward(&mut self, top: &mut [f64], bottom: &mut [f64]) {
        self.solve_backward(0..self.layout.own_runs);
        let Blocks { layout, x, g, inverse_masses, lower, .. } = self;
        let mut bodies = Passage { bodies: &layout.bodies, g, inverse: inverse_masses, top, x };
        for run in &layout.bodies.runs {
            by_kinds!(run, bodies, backward_levers::<[2, 1, 3, 6], [3, 3, 6, 18]>, backward, backward_by_rows);
        }
        layout.bodies.dense.iter().for_each(|body| body.leave(lower, top));
        layout.coordinates.iter().for_each(|&(i, p)| top[i as usize] = x[p as usize]);
        layout.g_rows.iter().zip(bottom).for_each(|(&p, value)| *value = x[p as usize]);
    }

    /// The smallest ratio above `collapsed` of a pivot to its size before elimination, and the number of multipliers
    /// not above it. Within a joint as if the largest ratio came first, so that the order of its rows does not matter.
    pub fn smallest_ratio(&self, collapsed: f64) -> (f64, usize) {
        self.smaller_ratio((1.0, 0), &self.layout.runs, collapsed)
    }

    /// The same without the last columns, going on from what was found elsewhere.
    pub fn smaller_own_ratio(&self, found: (f64, usize), collapsed: f64) -> (f64, usize) {
        self.smaller_ratio(found, &self.layout.runs[..self.layout.own_runs], collapsed)
    }

    fn smaller_ratio(&self, mut found: (f64, usize), runs: &[Run], collapsed: f64) -> (f64, usize) {
        // The last joints first: their ratios are the smallest, as a rule.
        for (run, first) in runs.iter().rev().flat_map(|run| run.firsts().rev().map(move |first| (run, first))) {
            let (positions, is_row) = (first..first + run.width, run.sign < 0.0);
            let mut ratios = [1.0; groups::LARGEST];
            for (ratio, p) in ratios.iter_mut().zip(positions) {
                let pivot = run.sign * self.work[self.layout.diagonal(p as u32)];
                *ratio = pivot / if is_row || run.is_early { self.sizes[p] } else { self.sizes[p] + pivot };
            }
            let ratios = &mut ratios[..run.width];
            // Written so that the NaN of a row of zeros has collapsed.
            let lost = run.width - ratios.iter().filter(|ratio| **ratio > collapsed).count();
            // In any order of the rows none is smaller than the product of all.
            let least: f64 = ratios.iter().product();
            if is_row && lost == 0 && run.width > 1 && least < found.0 {
                self.pivoted(first, ratios);
            }
            found.0 = ratios.iter().filter(|ratio| **ratio > collapsed).fold(found.0, |least: f64, x| least.min(*x));
            found.1 += if is_row { lost } else { 0 };
        }
        found
    }

    /// The ratios of a joint's pivots with the largest first, by those without, from L_jj D L_jj^T.
    fn pivoted(&self, first: usize, ratios: &mut [f64]) {
        let (width, place) = (ratios.len(), self.layout.diagonal(first as u32));
        let l = |i: usize, p: usize| if i == p { 1.0 } else { self.work[place + i * width + p] };
        let pivot = |p: usize| -self.work[place + p * (width + 1)];
        let mut block = [[0.0; groups::LARGEST]; groups::LARGEST];
        for (i, j) in (0..width).flat_map(|i| (0..=i).map(move |j| (i, j))) {
            let sum: f64 = (0..=j).map(|p| l(i, p) * pivot(p) * l(j, p)).sum();
            block[i][j] = sum / (self.sizes[first + i] * self.sizes[first + j]).sqrt();
            block[j][i] = block[i][j];
        }
        let mut is_left = [true; groups::LARGEST];
        for ratio in ratios.iter_mut() {
            let left = (0..width).filter(|&i| is_left[i]);
            let Some(next) = left.max_by(|&i, &j| block[i][i].total_cmp(&block[j][j])) else { return };
            is_left[next] = false;
            *ratio = block[next][next];
            let row = block[next];
            for i in (0..width).filter(|&i| is_left[i]) {
                (0..width).for_each(|j| block[i][j] -= row[i] * row[j] / *ratio);
            }
        }
    }
}
