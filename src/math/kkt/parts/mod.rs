//! The saddle-point matrix in parts, whose factors are made at once.
//!
//! Few unknowns, the separator, are all that the parts have in common: behind the unknowns of all parts,
//!
//! ```text
//! [ K_1            B_1^T ]
//! [       K_2      B_2^T ]          S = C - sum_p B_p K_p^-1 B_p^T
//! [           ...        ]
//! [ B_1   B_2      C     ]
//! ```
//!
//! Each part eliminates its own unknowns from [K_p B_p^T; B_p C_p], with C the sum of all C_p; what that leaves of the
//! separator is added in the order of the parts, and factored with the first one. The parts follow from the structure
//! alone, so that factors and solutions are the same to the bit for any number of threads.

mod division;
mod plan;

pub use division::{SEPARATOR, divide};
pub use plan::{Division, FactorPlan};

use super::blocks::Blocks;
use super::pivot::{Quality, Rule};
use crate::math::add;
use crate::math::threads::{Divisible, each, each_of};
use crate::tolerances::NUMBERS_OF_A_PORTION;
use plan::{PartPlan, PartRange};
use std::sync::Arc;

/// The factors of all parts, with the memory to make them and to solve.
pub struct Parts {
    division: Arc<Division>,
    all: Vec<MatrixPart>,
}

struct MatrixPart {
    number: usize,
    blocks: Blocks,
    /// Values and right sides of this part; those of the separator are zero in all parts but the first.
    mass: Vec<f64>,
    top: Vec<f64>,
    bottom: Vec<f64>,
    /// What the last factorization of its own columns found, by its own numbers.
    skipped: Vec<usize>,
    quality: Result<Quality, usize>,
}

/// Pieces of a solution that are put together.
struct Collection<'a> {
    pieces: &'a [PartRange],
    to: &'a mut [f64],
}

impl Divisible for Collection<'_> {
    fn is_whole(&self) -> bool {
        self.pieces.len() < 2 || self.to.len() < NUMBERS_OF_A_PORTION
    }

    fn divided(self) -> [Self; 2] {
        let (pieces, others) = self.pieces.split_at(self.pieces.len() / 2);
        let (to, rest) = self.to.split_at_mut(others[0].first - pieces[0].first);
        [Collection { pieces, to }, Collection { pieces: others, to: rest }]
    }
}

/// Puts a list together from the lists of the parts.
fn collect<'p>(pieces: &[PartRange], of: impl Fn(usize) -> &'p [f64] + Sync, to: &mut [f64]) {
    each(Collection { pieces, to }, &|Collection { pieces, mut to }| {
        for piece in pieces {
            let Some((own, rest)) = to.split_at_mut_checked(piece.len) else { return };
            own.copy_from_slice(&of(piece.part)[piece.place..][..piece.len]);
            to = rest;
        }
    });
}

impl Parts {
    pub fn new(division: Arc<Division>) -> Self {
        let all = division.parts.iter().enumerate().map(|(number, plan)| MatrixPart::new(number, plan)).collect();
        Parts { all, division }
    }

    /// See [`Blocks::factor`].
    pub fn factor(&mut self, mass: &[f64], g: &[f64], rule: Rule, skipped: &mut Vec<usize>) -> Result<Quality, usize> {
        let Parts { division, all } = self;
        each_of(all, |part| part.factor(&division.parts[part.number], mass, g, rule));
        let mut quality = Quality::GOOD;
        for part in &*all {
            quality = quality.with(part.quality.map_err(|node| division.node(part.number, node))?);
        }
        let Some((first, others)) = all.split_first_mut() else { return Ok(quality) };
        others.iter().for_each(|other| first.blocks.add_last(&other.blocks));
        let mut judge = first.blocks.judge(rule, &mut first.skipped);
        first.blocks.factor_last(&mut judge).map_err(|node| division.node(0, node))?;
        quality = quality.with(judge.quality);
        for (part, plan) in all.iter().zip(&division.parts) {
            skipped.extend(part.skipped.iter().map(|&row| plan.rows.of[row]));
        }
        Ok(quality)
    }

    /// See [`Blocks::solve`].
    pub fn solve(&mut self, top: &mut [f64], bottom: &mut [f64]) {
        let Parts { division, all } = self;
        let given_top: &[f64] = top;
        let given_bottom: &[f64] = bottom;
        each_of(all, |part| part.forward(&division.parts[part.number], given_top, given_bottom));
        let Some((first, others)) = all.split_first_mut() else { return };
        let last = first.blocks.last();
        others.iter_mut().for_each(|other| add(other.blocks.last(), last));
        first.blocks.solve_last();
        let last = first.blocks.last();
        others.iter_mut().for_each(|other| other.blocks.last().copy_from_slice(last));
        each_of(all, |part| part.blocks.backward(&mut part.top, &mut part.bottom));
        let all = &*all;
        collect(&division.coordinates, |part| &all[part].top, top);
        collect(&division.rows, |part| &all[part].bottom, bottom);
    }

    /// See [`Blocks::smallest_ratio`].
    pub fn smallest_ratio(&self, collapsed: f64) -> (f64, usize) {
        let Some((first, others)) = self.all.split_first() else { return (1.0, 0) };
        let found = first.blocks.smallest_ratio(collapsed);
        others.iter().fold(found, |found, part| part.blocks.smaller_own_ratio(found, collapsed))
    }
}

impl MatrixPart {
    fn new(number: usize, plan: &PartPlan) -> Self {
        let zeros = |len: usize| vec![0.0; len];
        let n = plan.coordinates.of.len();
        let m = plan.rows.of.len();
        let mut blocks = Blocks::new(plan.layout.clone(), n);
        blocks.reserve(plan.mass.of.len(), plan.g.of.len());
        MatrixPart {
            number,
            blocks,
            mass: zeros(plan.mass.of.len()),
            top: zeros(n),
            bottom: zeros(m),
            skipped: Vec::with_capacity(m),
            quality: Ok(Quality::GOOD),
        }
    }

    fn factor(&mut self, plan: &PartPlan, mass: &[f64], g: &[f64], rule: Rule) {
        plan.mass.read(mass, &mut self.mass);
        plan.g.read(g, &mut self.blocks.g);
        self.skipped.clear();
        let mut judge = self.blocks.judge(rule, &mut self.skipped);
        self.quality = self.blocks.factor_own(&self.mass, &mut judge).map(|()| judge.quality);
    }

    fn forward(&mut self, plan: &PartPlan, top: &[f64], bottom: &[f64]) {
        plan.coordinates.read(top, &mut self.top);
        plan.rows.read(bottom, &mut self.bottom);
        self.blocks.forward(&mut self.top, &self.bottom);
    }
}
