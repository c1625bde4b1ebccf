//! Orders of elimination of the fast path, determined by the values of the mass matrix alone.

use super::super::ldlt::Ldlt;
use super::super::pivot::{Quality, Rule};
use super::super::system::System;
use super::super::{Analysis, Pattern};
use std::sync::Arc;

/// Factors for one pattern of vanishing masses: the same values get the same order, whatever was factored before.
pub(super) struct Orders {
    /// Entries of M on its diagonal, with their coordinates.
    diagonal: Vec<(usize, usize)>,
    /// Coordinates without mass for which the factors are made; `found` is scratch for those of the current values.
    massless: Vec<bool>,
    found: Vec<bool>,
    /// Coordinates in the rows of very many multipliers: eliminated early, one with k multipliers would make a dense k
    /// x k block.
    hubs: Vec<bool>,
    /// Factors with hubs behind their multipliers, and with hubs ahead, used if a multiplier's pivot collapses in the
    /// first. Coordinates without mass are always behind.
    factors: [Option<Ldlt>; 2],
    analysis: Arc<Analysis>,
    taken: usize,
}

impl Orders {
    pub fn new(mass: &Pattern, g: &Pattern, analysis: Arc<Analysis>) -> Self {
        let entries = mass.entries.iter().enumerate();
        Orders {
            diagonal: entries.filter(|(_, (i, j))| i == j).map(|(entry, (i, _))| (entry, *i)).collect(),
            massless: vec![true; g.cols],
            found: vec![true; g.cols],
            hubs: hubs(g),
            factors: [None, None],
            analysis,
            taken: 0,
        }
    }

    /// Factors; `None` if a pivot collapses in each order.
    #[inline]
    pub fn factor(&mut self, system: &System, mass: &[f64], g: &[f64]) -> Option<Quality> {
        self.meet(mass);
        for order in 0..self.factors.len() {
            if self.factors[order].is_none() {
                self.prepare(order, system);
            }
            // This rule drops no rows.
            match self.factors[order].as_mut()?.factor(mass, g, Rule::STRICT, &mut Vec::new()) {
                Ok(quality) => {
                    self.taken = order;
                    return Some(quality);
                }
                Err(node) if node < system.mass.rows || !self.hubs.contains(&true) => return None,
                Err(_) => {}
            }
        }
        None
    }

    #[cold]
    fn prepare(&mut self, order: usize, System { mass, g, .. }: &System) {
        let late = |(massless, hub): (&bool, &bool)| *massless || *hub && order == 0;
        let late: Vec<bool> = self.massless.iter().zip(&self.hubs).map(late).collect();
        self.factors[order] = Some(Ldlt::of(&self.analysis.plan(mass, g, &late), mass, g, &late));
    }

    /// Forgets the factors if other masses vanish.
    #[inline]
    fn meet(&mut self, mass: &[f64]) {
        if self.diagonal.iter().all(|&(entry, i)| (mass[entry] == 0.0) == self.massless[i]) {
            return;
        }
        self.found.fill(true);
        self.diagonal.iter().for_each(|&(entry, i)| self.found[i] &= mass[entry] == 0.0);
        if self.found != self.massless {
            self.massless.copy_from_slice(&self.found);
            self.factors = [None, None];
        }
    }

    /// The factors of the last success.
    #[inline]
    pub fn taken(&mut self) -> Option<&mut Ldlt> {
        self.factors[self.taken].as_mut()
    }

    /// See [`Ldlt::smallest_ratio`].
    pub fn smallest_ratio(&self) -> f64 {
        self.factors[self.taken].as_ref().map_or(0.0, |fast| fast.smallest_ratio(0.0).0)
    }
}

fn hubs(g: &Pattern) -> Vec<bool> {
    let mut degrees = vec![0_usize; g.cols];
    g.entries.iter().for_each(|&(_, i)| degrees[i] += 1);
    let limit = (4 * g.rows.isqrt()).max(32);
    degrees.into_iter().map(|degree| degree > limit).collect()
}
