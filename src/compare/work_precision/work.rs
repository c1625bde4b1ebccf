//! Cost of runs by counted work: the same on a busy machine and on an idle one.

use super::WorkPrecision;
use super::cell::{Cell, median};
use crate::formulation::{Statistics, Work};
use crate::simulate::Method;
use std::collections::BTreeMap;

/// Work in solutions of the equations of motion. Over 1672 runs on nine scenes the times of a class are proportional to
/// this
/// within 30 %, which is as much as one run's time varies on a busy machine. Rows are counted in: over 204 runs of
/// Andrews' mechanism with 200 rows the spread of a class is 5 to 17 %, without them 10 to 30 %.
const STEP: f64 = 0.3;
const SWEEP: f64 = 0.9;
const JACOBIAN: f64 = 2.0;
const FACTORIZATION: f64 = 2.0;
const ITERATION: f64 = 1.0;
/// Formulations that solve the matrix of `index1`, with their cost relative to it.
const LIKE_INDEX1: [(&str, f64); 3] = [("baumgarte", 1.0), ("force_projection", 1.2), ("invariant_manifold", 1.2)];

/// Runs with the same kind of work, whose time per unit is the same: explicit methods on one formulation; an implicit
/// method on one formulation.
pub type Class<'c> = (&'c str, &'c str);

/// A method and whether stability limits its steps.
#[derive(Clone, Copy)]
pub struct Worker<'c> {
    /// The method.
    pub method: &'c Method,
    /// True if stability limits its steps.
    pub is_explicit: bool,
}

impl<'c> Worker<'c> {
    /// Returns the units of work.
    pub fn work(self, statistics: Statistics) -> f64 {
        let Statistics { steps, rejected, .. } = statistics;
        let Work { rhs_evaluations, jacobian_evaluations, factorizations, newton_iterations, projections } =
            statistics.whole();
        let every = STEP * (steps + rejected) as f64 + rhs_evaluations as f64 + SWEEP * projections as f64;
        // A factorization is part of every evaluation of an explicit method.
        let implicit = JACOBIAN * jacobian_evaluations as f64
            + FACTORIZATION * factorizations as f64
            + ITERATION * newton_iterations as f64;
        let all = if self.is_explicit { every } else { every + implicit };
        self.like_index1().unwrap_or(1.0) * all
    }

    /// Returns the kind of its work.
    pub fn class(self) -> Class<'c> {
        let formulation = if self.like_index1().is_some() { "index1" } else { &self.method.formulation.name };
        (formulation, if self.is_explicit { "" } else { &self.method.integrator.name })
    }

    /// Returns the price of its evaluations over those of `index1`, where it is known.
    fn like_index1(self) -> Option<f64> {
        let like = LIKE_INDEX1.iter().find(|(name, _)| self.is_explicit && *name == self.method.formulation.name);
        like.map(|(_, price)| *price)
    }
}

impl Cell {
    fn worker(&self) -> Worker<'_> {
        Worker { method: &self.method, is_explicit: self.is_explicit }
    }

    /// Returns the units of work; none where the run did not complete.
    fn work(&self) -> Option<f64> {
        Some(self.worker().work(self.statistics()?))
    }
}

impl WorkPrecision {
    /// Sets the cost of every run: its work times the time of a unit, the median over all runs of its class. So the
    /// cost of two runs of a class does not depend on the clock, and that of others on the median of many runs.
    pub fn price(&mut self) {
        let mut units: BTreeMap<Class, Vec<f64>> = BTreeMap::new();
        for cell in &self.cells {
            let unit = cell.seconds().zip(cell.work()).map(|(seconds, work)| seconds / work);
            units.entry(cell.worker().class()).or_default().extend(unit);
        }
        let units: BTreeMap<Class, Option<f64>> = units.into_iter().map(|(class, all)| (class, median(&all))).collect();
        let cost = |cell: &Cell| Some(cell.work()? * units.get(&cell.worker().class()).copied().flatten()?);
        let costs: Vec<Option<f64>> = self.cells.iter().map(cost).collect();
        self.cells.iter_mut().zip(costs).for_each(|(cell, cost)| cell.cost = cost);
    }
}
