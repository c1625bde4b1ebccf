//! One method at one tolerance or step.

use super::WorkPrecision;
use crate::analysis::Drift;
use crate::error::Failure;
use crate::formulation::Statistics;
use crate::simulate::Method;
use crate::study::price::{Class, Prices, Worker};
use serde::{Deserialize, Serialize};

/// A run of the grid, with its repetitions.
#[derive(Clone, Debug, Serialize, Deserialize)]
pub struct Cell {
    /// Method with its tolerances or step.
    pub method: Method,
    /// Term of the sequence: rtol = 10^-decades, or the fixed step expected to give that error.
    pub decades: u32,
    /// True if stability limits its steps.
    pub is_explicit: bool,
    /// CPU time by counted work, s, where it was stopped up to there: see
    /// [`WorkPrecision::price`].
    pub cost: Option<f64>,
    /// Result.
    #[serde(flatten)]
    pub outcome: Outcome,
}

/// Result of a run.
#[derive(Clone, Debug, Serialize, Deserialize)]
#[serde(tag = "status", rename_all = "snake_case")]
pub enum Outcome {
    /// It reached the end.
    Completed {
        /// Largest difference from the reference over the times compared, relative to the size of each quantity, plus
        /// the error of the reference itself.
        error: f64,
        /// The quantity with the largest difference.
        worst: String,
        /// Largest relative constraint drift.
        drift: Held,
        /// CPU time of each repetition, s; the least counts.
        cpu_seconds: Vec<f64>,
        /// Counted work.
        statistics: Statistics,
    },
    /// It stopped with an error.
    Failed {
        /// The error.
        failure: Failure,
        /// CPU time, s.
        cpu_seconds: f64,
    },
    /// It was stopped at `t`, since it exceeded its time limit.
    TooSlow {
        /// Time reached, s.
        t: f64,
        /// CPU time, s.
        cpu_seconds: f64,
        /// Counted work up to there.
        #[serde(default)]
        statistics: Statistics,
        /// The limit.
        reason: String,
    },
    /// It was not run.
    Skipped {
        /// The reason.
        reason: String,
    },
}

/// Largest constraint drift over the steps, relative to the scene's scale.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct Held {
    /// Relative drift of phi.
    pub position: f64,
    /// Relative drift of phi'.
    pub velocity: f64,
}

impl From<&Drift> for Held {
    fn from(drift: &Drift) -> Held {
        Held { position: drift.position.relative_max, velocity: drift.velocity.relative_max }
    }
}

impl Held {
    /// Returns the larger of both.
    pub fn largest(self) -> f64 {
        self.position.max(self.velocity)
    }
}

impl Cell {
    /// Returns the CPU time of a completed run, s: the least of its repetitions.
    pub fn seconds(&self) -> Option<f64> {
        let Outcome::Completed { cpu_seconds, .. } = &self.outcome else { return None };
        cpu_seconds.iter().copied().reduce(f64::min)
    }

    /// Returns the relative error of a completed run.
    pub fn error(&self) -> Option<f64> {
        let Outcome::Completed { error, .. } = self.outcome else { return None };
        Some(error)
    }

    /// Returns the correct digits, -log10 of the error, sixteen at most.
    pub fn digits(&self) -> Option<f64> {
        self.error().map(digits)
    }

    /// Returns the drift of a completed run.
    #[doc(hidden)]
    pub fn drift(&self) -> Option<Held> {
        let Outcome::Completed { drift, .. } = self.outcome else { return None };
        Some(drift)
    }

    /// Returns the counted work of a run that completed or was stopped.
    pub fn statistics(&self) -> Option<Statistics> {
        match self.outcome {
            Outcome::Completed { statistics, .. } | Outcome::TooSlow { statistics, .. } => Some(statistics),
            _ => None,
        }
    }

    /// Returns the kind of its work, and its units; none where the run neither completed nor was stopped.
    fn work(&self) -> Option<(Class, f64)> {
        let worker = Worker { method: &self.method, is_explicit: self.is_explicit };
        Some((worker.class(), worker.work(self.statistics()?)))
    }

    /// Returns the reason why there is no result.
    pub fn reason(&self) -> Option<&str> {
        match &self.outcome {
            Outcome::Completed { .. } => None,
            Outcome::Failed { failure, .. } => Some(&failure.reason),
            Outcome::TooSlow { reason, .. } | Outcome::Skipped { reason } => Some(reason),
        }
    }

    /// True if both have the same formulation, integrator and projection.
    pub fn is_of(&self, other: &Method) -> bool {
        let Method { formulation, integrator, projection, .. } = &self.method;
        (formulation, integrator, projection) == (&other.formulation, &other.integrator, &other.projection)
    }
}

/// Returns the correct digits of a relative error, sixteen at most.
pub(super) fn digits(error: f64) -> f64 {
    -error.max(1e-16).log10()
}

impl WorkPrecision {
    /// Sets the cost of every run by its counted work.
    pub fn price(&mut self) {
        let mut prices = Prices::new();
        for cell in &self.cells {
            if let Some((seconds, (class, work))) = cell.seconds().zip(cell.work()) {
                prices.enter(class, seconds, work);
            }
        }
        for cell in &mut self.cells {
            cell.cost = cell.work().and_then(|(class, work)| prices.cost(&class, work));
        }
    }
}
