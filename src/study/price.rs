//! Price of work: the same on a busy machine and on an idle one.

use crate::formulation::{Statistics, Work};
use crate::simulate::Method;
use std::collections::BTreeMap;

/// Work in solutions of the equations of motion. Over 1672 runs on nine scenes the times of a class are proportional to
/// this within 30 %, which is as much as one run's time varies on a busy machine. Rows are counted in: over 204 runs of
/// Andrews' mechanism with 200 rows the spread of a class is 5 to 17 %, without them 10 to 30 %.
const STEP: f64 = 0.3;
const SWEEP: f64 = 0.9;
const JACOBIAN: f64 = 2.0;
const FACTORIZATION: f64 = 2.0;
const ITERATION: f64 = 1.0;
/// Formulations that solve the matrix of `index1`, with their cost relative to it.
const LIKE_INDEX1: [(&str, f64); 3] = [("baumgarte", 1.0), ("force_projection", 1.2), ("invariant_manifold", 1.2)];

/// Formulation, and integrator if that is implicit: a unit of work takes the same time in all runs of a class.
pub type Class = (String, String);

/// A method and whether stability limits its steps.
#[derive(Clone, Copy)]
pub struct Worker<'c> {
    /// The method.
    pub method: &'c Method,
    /// True if stability limits its steps.
    pub is_explicit: bool,
}

impl Worker<'_> {
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
    pub fn class(self) -> Class {
        let formulation = if self.like_index1().is_some() { "index1" } else { &self.method.formulation.name };
        let integrator = if self.is_explicit { "" } else { &self.method.integrator.name };
        (formulation.to_string(), integrator.to_string())
    }

    /// Returns the price of its evaluations over those of `index1`, where it is known.
    fn like_index1(self) -> Option<f64> {
        let like = LIKE_INDEX1.iter().find(|(name, _)| self.is_explicit && *name == self.method.formulation.name);
        like.map(|(_, price)| *price)
    }
}

/// CPU times of a unit of work that were measured, by kinds of work, sorted.
pub(crate) struct Prices<Kind>(BTreeMap<Kind, Vec<f64>>);

impl<Kind: Ord> Prices<Kind> {
    /// No prices.
    pub fn new() -> Self {
        Prices(BTreeMap::new())
    }

    /// Enters a run of this work that took `seconds`.
    pub fn enter(&mut self, kind: Kind, seconds: f64, work: f64) {
        if work > 0.0 {
            let known = self.0.entry(kind).or_default();
            let price = seconds / work;
            known.insert(known.partition_point(|other| other.total_cmp(&price).is_lt()), price);
        }
    }

    /// Returns the cost of work, s: that times the median price of its kind. So the costs of two runs of a kind do not
    /// depend on the clock, and those of others depend on the median of many runs.
    pub fn cost(&self, kind: &Kind, work: f64) -> Option<f64> {
        Some(work * middle(self.0.get(kind)?)?)
    }
}

/// Returns the median.
pub fn median(values: &[f64]) -> Option<f64> {
    let mut sorted = values.to_vec();
    sorted.sort_by(f64::total_cmp);
    middle(&sorted)
}

fn middle(sorted: &[f64]) -> Option<f64> {
    let low = sorted.get((sorted.len().max(1) - 1) / 2)?;
    let high = sorted.get(sorted.len() / 2)?;
    Some(0.5 * (low + high))
}
