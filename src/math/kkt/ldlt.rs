//! A factor L D L^T without pivoting, dense for a few unknowns, over small blocks of a frozen pattern or, where it fills, over faer's.

use super::Pattern;
use super::blocks::{Blocks, Small};
use super::parts::{FactorPlan, Parts};
use super::pivot::{Quality, Rule};
use super::supernodal::Supernodal;

/// Multiplications per entry of L from which faer's blocks win, and the number of products of blocks from which the
/// memory of their list counts.
const FILL_FOR_FAER: usize = 40;
const LONGEST_LIST: usize = 30_000_000;

pub(super) enum Ldlt {
    Small(Box<Small>),
    Blocks(Box<Blocks>),
    Parts(Box<Parts>),
    Supernodal(Box<Supernodal>),
}

impl Ldlt {
    pub fn new(mass: &Pattern, g: &Pattern, late: &[bool]) -> Self {
        Self::of(&FactorPlan::new(mass, g, late, &[]), mass, g, late)
    }

    /// With a structure that is known.
    pub fn of(plan: &FactorPlan, mass: &Pattern, g: &Pattern, late: &[bool]) -> Self {
        if let Some(small) = Small::new(mass, g).filter(|_| !late.contains(&true)) {
            return Ldlt::Small(Box::new(small));
        }
        let [len, operations, products] = plan.sizes();
        let is_filled = operations > FILL_FOR_FAER * len || products > LONGEST_LIST;
        let faer = if is_filled { Supernodal::new(mass, g, late) } else { None };
        match (faer, plan) {
            (Some(supernodal), _) => Ldlt::Supernodal(Box::new(supernodal)),
            (None, FactorPlan::Whole(layout)) => Ldlt::Blocks(Box::new(Blocks::new(layout.clone(), mass.rows))),
            (None, FactorPlan::Parts(division)) => Ldlt::Parts(Box::new(Parts::new(division.clone()))),
        }
    }

    /// Factors; `skipped` receives the multipliers that are dropped. The error is the node whose pivot collapsed.
    #[inline]
    pub fn factor(&mut self, mass: &[f64], g: &[f64], rule: Rule, skipped: &mut Vec<usize>) -> Result<Quality, usize> {
        skipped.clear();
        match self {
            Ldlt::Small(f) => f.factor(mass, g, rule, skipped),
            Ldlt::Blocks(f) => f.factor(mass, g, rule, skipped),
            Ldlt::Parts(f) => f.factor(mass, g, rule, skipped),
            Ldlt::Supernodal(f) => f.factor(mass, g, rule, skipped),
        }
    }

    /// Solves in place; dropped multipliers are zero.
    #[inline]
    pub fn solve(&mut self, top: &mut [f64], bottom: &mut [f64]) {
        match self {
            Ldlt::Small(f) => f.solve(top, bottom),
            Ldlt::Blocks(f) => f.solve(top, bottom),
            Ldlt::Parts(f) => f.solve(top, bottom),
            Ldlt::Supernodal(f) => f.solve(top, bottom),
        }
    }

    /// Solves for two right sides with zero for the coordinates at once; false where that is no less work than one after
    /// the other.
    pub fn project(&mut self, bottoms: [&[f64]; 2], corrections: [&mut [f64]; 2]) -> bool {
        let Ldlt::Blocks(f) = self else { return false };
        f.project(bottoms, corrections);
        true
    }

    /// The smallest ratio above `collapsed` of a pivot to its size, and the number of multipliers whose ratio is not
    /// above it.
    #[inline]
    pub fn smallest_ratio(&self, collapsed: f64) -> (f64, usize) {
        match self {
            Ldlt::Small(f) => f.smallest_ratio(collapsed),
            Ldlt::Blocks(f) => f.smallest_ratio(collapsed),
            Ldlt::Parts(f) => f.smallest_ratio(collapsed),
            Ldlt::Supernodal(f) => f.smallest_ratio(collapsed),
        }
    }
}
