//! One method at one tolerance or step.

use crate::analysis::Drift;
use crate::error::Failure;
use crate::formulation::Statistics;
use crate::simulate::Method;
use serde::{Deserialize, Serialize};

/// A run of the grid, with its repeats.
#[derive(Clone, Debug, Serialize, Deserialize)]
pub struct Cell {
    pub method: Method,
    /// The term of the sequence: rtol = 10^-decades, or the step that asks for as much.
    pub decades: u32,
    /// Whether stability limits its steps.
    pub is_explicit: bool,
    /// CPU time by counted work, s: see [`WorkPrecision::price`](super::WorkPrecision::price).
    pub cost: Option<f64>,
    #[serde(flatten)]
    pub outcome: Outcome,
}

/// What became of it.
#[derive(Clone, Debug, Serialize, Deserialize)]
#[serde(tag = "status", rename_all = "snake_case")]
pub enum Outcome {
    Completed {
        /// Largest difference from the reference over the times compared, relative to the size of each quantity, and what the
        /// reference itself may be off.
        error: f64,
        /// The quantity that is farthest off.
        worst: String,
        drift: Held,
        /// CPU time of each repeat, s; the fastest counts.
        cpu_seconds: Vec<f64>,
        statistics: Statistics,
    },
    Failed {
        failure: Failure,
        cpu_seconds: f64,
    },
    /// Stopped at `t`, since it took longer than it may.
    TooSlow {
        /// s
        t: f64,
        cpu_seconds: f64,
        reason: String,
    },
    /// Not tried, and why.
    Skipped {
        reason: String,
    },
}

/// Largest drift over the steps, relative to the scene's scale.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct Held {
    pub position: f64,
    pub velocity: f64,
}

impl From<&Drift> for Held {
    fn from(drift: &Drift) -> Held {
        Held { position: drift.position.relative_max, velocity: drift.velocity.relative_max }
    }
}

impl Held {
    /// Of both levels.
    pub fn largest(self) -> f64 {
        self.position.max(self.velocity)
    }
}

impl Cell {
    /// CPU time measured of a completed run, s.
    pub fn seconds(&self) -> Option<f64> {
        let Outcome::Completed { cpu_seconds, .. } = &self.outcome else { return None };
        cpu_seconds.iter().copied().reduce(f64::min)
    }

    pub fn error(&self) -> Option<f64> {
        match self.outcome {
            Outcome::Completed { error, .. } => Some(error),
            _ => None,
        }
    }

    /// Correct digits: -log10 of the error, sixteen at most.
    pub fn digits(&self) -> Option<f64> {
        self.error().map(digits)
    }

    pub fn drift(&self) -> Option<Held> {
        match self.outcome {
            Outcome::Completed { drift, .. } => Some(drift),
            _ => None,
        }
    }

    pub fn statistics(&self) -> Option<Statistics> {
        match self.outcome {
            Outcome::Completed { statistics, .. } => Some(statistics),
            _ => None,
        }
    }

    /// Why there is no result.
    pub fn reason(&self) -> Option<&str> {
        match &self.outcome {
            Outcome::Completed { .. } => None,
            Outcome::Failed { failure, .. } => Some(&failure.reason),
            Outcome::TooSlow { reason, .. } | Outcome::Skipped { reason } => Some(reason),
        }
    }

    /// Whether both are of one formulation, integrator and projection.
    pub fn is_of(&self, other: &Method) -> bool {
        let Method { formulation, integrator, projection, .. } = &self.method;
        (formulation, integrator, projection) == (&other.formulation, &other.integrator, &other.projection)
    }
}

/// Correct digits of a relative error; those of a double number at most.
pub(super) fn digits(error: f64) -> f64 {
    -error.max(1e-16).log10()
}

/// The middle one, or the mean of the middle two.
pub(super) fn median(values: &[f64]) -> Option<f64> {
    let mut sorted = values.to_vec();
    sorted.sort_by(f64::total_cmp);
    let (low, high) = (sorted.get((sorted.len().max(1) - 1) / 2)?, sorted.get(sorted.len() / 2)?);
    Some(0.5 * (low + high))
}
