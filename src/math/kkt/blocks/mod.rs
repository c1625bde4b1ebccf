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

#[macro_use]
mod widths;

mod bodies;
mod dense;
mod factors;
mod groups;
mod kernels;
mod lanes;
mod layout;
mod schur;
mod small;

use super::pivot::{Judge, Quality, Rule, farthest_first};
use crate::math::add;
use crate::math::array::from_fn;
use dense::DenseBody;
use factors::BlockFactors;
pub(super) use groups::Groups;
use kernels::{Elimination, at};
use lanes::Pair;
use layout::ColumnRun;
pub(super) use layout::Layout;
use schur::Schur;
pub(super) use small::Small;
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
    /// Right sides of [`Blocks::project`], of the coordinates and of the unknowns of the layout; empty until needed.
    pairs: [Vec<Pair>; 2],
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
            lower: vec![0.0; layout.bodies.dense.last().map_or(0, DenseBody::end)],
            mass: Vec::new(),
            pairs: [Vec::new(), Vec::new()],
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
        let early = layout.early_runs();
        let own = layout.own_runs;
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
            self.inverse_masses[i] = judge.inverse(mass[entry], mass[entry], 1.0, || i)?;
        }
        for body in &self.layout.bodies.dense {
            body.factor(mass, &mut self.lower, &mut self.inverse_masses, judge)?;
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
            by_kinds!(run, part, levers::<[2, 1, 3, 6, 4], [3, 3, 6, 18, 9]>, blocks);
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
        let own = 0..self.layout.own_runs;
        let (factors, x, _) = self.factors();
        factors.enter(top, bottom, x);
        factors.forward(own, x);
    }

    /// Both ways for the last columns.
    pub fn solve_last(&mut self) {
        let last = self.layout.own_runs..self.layout.runs.len();
        let (factors, x, _) = self.factors();
        factors.forward(last.clone(), x);
        factors.backward(last, x);
    }

    /// The right sides of the last columns after the way forward, then their solution.
    pub fn last(&mut self) -> &mut [f64] {
        &mut self.x[self.layout.last.0..]
    }

    /// The way back for all but the last columns.
    pub fn backward(&mut self, top: &mut [f64], bottom: &mut [f64]) {
        let own = 0..self.layout.own_runs;
        let (factors, x, _) = self.factors();
        factors.backward(own, x);
        factors.leave(top, x);
        factors.layout.g_rows.iter().zip(bottom).for_each(|(&p, value)| *value = x[p as usize]);
    }

    /// Solves [M G^T; G 0] [d; .] = [0; b] for two b at once.
    pub fn project(&mut self, bottoms: [&[f64]; 2], corrections: [&mut [f64]; 2]) {
        let [b, c] = bottoms;
        let [d, e] = corrections;
        let n = self.n;
        let len = self.layout.nodes.len();
        let all = 0..self.layout.runs.len();
        let (factors, _, [top, x]) = self.factors();
        for (side, len) in [(&mut *top, n), (&mut *x, len)] {
            side.clear();
            side.resize(len, Pair::default());
        }
        factors.layout.g_rows.iter().zip(b.iter().zip(c)).for_each(|(&p, (b, c))| x[p as usize] = Pair([*b, *c]));
        factors.forward(all.clone(), x);
        factors.backward(all, x);
        factors.leave(top, x);
        d.iter_mut().zip(e).zip(top).for_each(|((d, e), Pair(top))| [*d, *e] = *top);
    }

    fn factors(&mut self) -> (BlockFactors<'_>, &mut [f64], &mut [Vec<Pair>; 2]) {
        let Blocks { layout, work, inverse, x, g, inverse_masses, lower, pairs, .. } = self;
        (BlockFactors { layout, work, inverse, g, inverse_masses, lower }, x, pairs)
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

    fn smaller_ratio(&self, found: (f64, usize), runs: &[ColumnRun], collapsed: f64) -> (f64, usize) {
        // The last joints first: their ratios are the smallest, as a rule.
        runs.iter().rev().fold(found, |found, run| by_width!(run.width, self.smaller_of(run, found, collapsed)))
    }

    fn smaller_of<const W: usize>(&self, run: &ColumnRun, mut found: (f64, usize), collapsed: f64) -> (f64, usize) {
        let is_row = run.sign < 0.0;
        for first in run.firsts().rev() {
            let place = self.layout.diagonal(first as u32);
            let Some(sizes) = at::<_, W>(&self.sizes, first) else { return found };
            let mut ratios: [f64; W] = from_fn(|p| {
                let pivot = run.sign * self.work[place + p * (W + 1)];
                pivot / if is_row || run.is_early { sizes[p] } else { sizes[p] + pivot }
            });
            // Written so that the NaN of a row of zeros has collapsed.
            let lost = W - ratios.iter().filter(|ratio| **ratio > collapsed).count();
            // In any order of the rows none is smaller than the product of all.
            if is_row && lost == 0 && W > 1 && ratios.iter().product::<f64>() < found.0 {
                let rows = self.work[place..].as_chunks::<W>().0;
                rows.first_chunk().into_iter().for_each(|rows| farthest_first(rows, sizes, &mut ratios));
            }
            found.0 = ratios.iter().filter(|ratio| **ratio > collapsed).fold(found.0, |least: f64, x| least.min(*x));
            found.1 += if is_row { lost } else { 0 };
        }
        found
    }
}
