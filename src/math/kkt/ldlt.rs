//! A factor L D L^T without pivoting, simplicial or supernodal.

use super::Pattern;
use super::pivot::{Quality, Rule};
use super::simplicial::Simplicial;
use super::supernodal::Supernodal;
use super::symbolic::Symbolic;

/// Multiplications per nonzero of L from which dense blocks win over a list of destinations, and the length of that
/// list from which its memory counts. Measured: see `Simplicial`.
const FILL_FOR_BLOCKS: usize = 40;
const LONGEST_LIST: usize = 30_000_000;

pub(super) enum Ldlt {
    Simplicial(Box<Simplicial>),
    Supernodal(Box<Supernodal>),
}

impl Ldlt {
    pub fn new(mass: &Pattern, g: &Pattern, late: &[bool]) -> Self {
        let symbolic = Symbolic::new(mass, g, late);
        let operations = symbolic.operations();
        if operations > FILL_FOR_BLOCKS * (symbolic.rows.len() + symbolic.size()) || operations > LONGEST_LIST {
            Self::blocked(symbolic, mass, g, late)
        } else {
            Ldlt::Simplicial(Box::new(Simplicial::new(symbolic)))
        }
    }

    pub fn blocked(symbolic: Symbolic, mass: &Pattern, g: &Pattern, late: &[bool]) -> Self {
        match Supernodal::new(symbolic, mass, g, late) {
            Some(blocked) => Ldlt::Supernodal(Box::new(blocked)),
            None => Ldlt::Simplicial(Box::new(Simplicial::new(Symbolic::new(mass, g, late)))),
        }
    }

    /// Factors; `skipped` receives the multipliers that are dropped. The error is the node whose pivot collapsed.
    pub fn factor(&mut self, mass: &[f64], g: &[f64], rule: Rule, skipped: &mut Vec<usize>) -> Result<Quality, usize> {
        skipped.clear();
        match self {
            Ldlt::Simplicial(f) => f.factor(mass, g, rule, skipped),
            Ldlt::Supernodal(f) => f.factor(mass, g, rule, skipped),
        }
    }

    /// Solves in place; dropped multipliers are zero.
    pub fn solve(&mut self, top: &mut [f64], bottom: &mut [f64]) {
        match self {
            Ldlt::Simplicial(f) => f.solve(top, bottom),
            Ldlt::Supernodal(f) => f.solve(top, bottom),
        }
    }

    /// The smallest ratio above `collapsed` of a pivot to its size, and the number of multipliers whose ratio is not
    /// above it.
    pub fn smallest_ratio(&self, collapsed: f64) -> (f64, usize) {
        match self {
            Ldlt::Simplicial(f) => f.smallest_ratio(collapsed),
            Ldlt::Supernodal(f) => f.smallest_ratio(collapsed),
        }
    }
}
