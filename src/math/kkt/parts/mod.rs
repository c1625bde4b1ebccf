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

pub use plan::Plan;
use plan::PartPlan;

use super::blocks::Blocks;
use super::pivot::{Quality, Rule};
use crate::math::threads::each;
use std::sync::Arc;

/// The factors of all parts, with the memory to make them and to solve.
pub struct Parts {
    plan: Arc<Vec<PartPlan>>,
    /// Number of coordinates.
    n: usize,
    all: Vec<Part>,
}

struct Part {
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

impl PartPlan {
    /// Coordinate i, or n + row, of the whole matrix with n coordinates.
    fn node(&self, own: usize, n: usize) -> usize {
        let count = self.coordinates.of.len();
        if own < count { self.coordinates.of[own] } else { n + self.rows.of[own - count] }
    }
}

impl Parts {
    /// For a plan of a matrix with `n` coordinates.
    pub fn new(plan: Arc<Vec<PartPlan>>, n: usize) -> Self {
        let zeros = |len: usize| vec![0.0; len];
        let part = |(number, plan): (usize, &PartPlan)| {
            let mut blocks = Blocks::new(plan.layout.clone(), plan.coordinates.of.len());
            blocks.g = zeros(plan.g.of.len());
            Part {
                number,
                blocks,
                mass: zeros(plan.mass.of.len()),
                top: zeros(plan.coordinates.of.len()),
                bottom: zeros(plan.rows.of.len()),
                skipped: Vec::with_capacity(plan.rows.of.len()),
                quality: Ok(Quality::GOOD),
            }
        };
        Parts { all: plan.iter().enumerate().map(part).collect(), plan, n }
    }

    /// See [`Blocks::factor`].
    pub fn factor(&mut self, mass: &[f64], g: &[f64], rule: Rule, skipped: &mut Vec<usize>) -> Result<Quality, usize> {
        let (plan, n) = (&self.plan, self.n);
        each(&mut self.all[..], &|parts: &mut [Part]| {
            parts.iter_mut().for_each(|part| part.factor(&plan[part.number], (mass, g), rule));
        });
        let mut quality = Quality::GOOD;
        for (part, plan) in self.all.iter().zip(&**plan) {
            quality = quality.with(part.quality.map_err(|node| plan.node(node, n))?);
        }
        let Some((first, others)) = self.all.split_first_mut() else { return Ok(quality) };
        others.iter().for_each(|other| first.blocks.add_last(&other.blocks));
        let mut judge = first.blocks.judge(rule, &mut first.skipped);
        first.blocks.factor_last(&mut judge).map_err(|node| plan[0].node(node, n))?;
        quality = quality.with(judge.quality);
        for (part, plan) in self.all.iter().zip(&**plan) {
            skipped.extend(part.skipped.iter().map(|&row| plan.rows.of[row]));
        }
        Ok(quality)
    }

    /// See [`Blocks::solve`].
    pub fn solve(&mut self, top: &mut [f64], bottom: &mut [f64]) {
        let plan = &self.plan;
        let given: (&[f64], &[f64]) = (top, bottom);
        each(&mut self.all[..], &|parts: &mut [Part]| {
            parts.iter_mut().for_each(|part| part.forward(&plan[part.number], given));
        });
        let Some((first, others)) = self.all.split_first_mut() else { return };
        let last = first.blocks.last();
        others.iter_mut().for_each(|other| super::system::add(other.blocks.last(), last));
        first.blocks.solve_last();
        let last = first.blocks.last();
        others.iter_mut().for_each(|other| other.blocks.last().copy_from_slice(last));
        each(&mut self.all[..], &|parts: &mut [Part]| {
            parts.iter_mut().for_each(|part| part.blocks.backward(&mut part.top, &mut part.bottom));
        });
        for (part, plan) in self.all.iter().zip(&**plan) {
            plan.coordinates.write(&part.top, top);
            plan.rows.write(&part.bottom, bottom);
        }
    }

    /// See [`Blocks::smallest_ratio`].
    pub fn smallest_ratio(&self, collapsed: f64) -> (f64, usize) {
        let Some((first, others)) = self.all.split_first() else { return (1.0, 0) };
        let found = first.blocks.smallest_ratio(collapsed);
        others.iter().fold(found, |found, part| part.blocks.smaller_own_ratio(found, collapsed))
    }
}

impl Part {
    fn factor(&mut self, plan: &PartPlan, (mass, g): (&[f64], &[f64]), rule: Rule) {
        plan.mass.read(mass, &mut self.mass);
        plan.g.read(g, &mut self.blocks.g);
        self.skipped.clear();
        let mut judge = self.blocks.judge(rule, &mut self.skipped);
        self.quality = self.blocks.factor_own(&self.mass, &mut judge).map(|()| judge.quality);
    }

    fn forward(&mut self, plan: &PartPlan, (top, bottom): (&[f64], &[f64])) {
        if self.number > 0 {
            self.top.fill(0.0);
            self.bottom.fill(0.0);
        }
        plan.coordinates.read(top, &mut self.top);
        plan.rows.read(bottom, &mut self.bottom);
        self.blocks.forward(&mut self.top, &self.bottom);
    }
}
