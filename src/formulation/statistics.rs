//! Counted work.

use serde::{Deserialize, Serialize};
use std::ops::Add;

/// Work done in a run.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
pub struct Statistics {
    pub steps: u64,
    pub rejected: u64,
    /// Solutions of the equations of motion.
    pub rhs_evaluations: u64,
    pub jacobian_evaluations: u64,
    /// Factorizations of the saddle-point matrix.
    pub factorizations: u64,
    pub newton_iterations: u64,
    /// Sets of equations that Newton's method solved as far as round-off let it, and not to the tolerance.
    pub stagnated: u64,
    /// Sweeps of the projection.
    pub projections: u64,
    /// Accepted states at which G was rank deficient.
    pub rank_deficient: u64,
    /// Work beside that of the steps: a look at the start, output rows, and the search for thresholds within steps.
    pub rows: Work,
}

impl Statistics {
    /// Work of the steps alone.
    pub fn of_steps(&self) -> Work {
        let Statistics {
            rhs_evaluations, jacobian_evaluations, factorizations, newton_iterations, projections, ..
        } = *self;
        Work { rhs_evaluations, jacobian_evaluations, factorizations, newton_iterations, projections }
    }

    /// Work of steps and rows.
    pub fn whole(&self) -> Work {
        self.of_steps() + self.rows
    }
}

impl Add for Statistics {
    type Output = Self;
    fn add(self, other: Self) -> Self {
        Statistics {
            steps: self.steps + other.steps,
            rejected: self.rejected + other.rejected,
            stagnated: self.stagnated + other.stagnated,
            rank_deficient: self.rank_deficient + other.rank_deficient,
            rows: self.rows + other.rows,
            ..Statistics::from(self.of_steps() + other.of_steps())
        }
    }
}

/// Counts of what takes time, as in [`Statistics`].
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
pub struct Work {
    pub rhs_evaluations: u64,
    pub jacobian_evaluations: u64,
    pub factorizations: u64,
    pub newton_iterations: u64,
    pub projections: u64,
}

impl From<Work> for Statistics {
    /// As that of steps.
    fn from(work: Work) -> Self {
        let Work { rhs_evaluations, jacobian_evaluations, factorizations, newton_iterations, projections } = work;
        let none = Statistics::default();
        Statistics { rhs_evaluations, jacobian_evaluations, factorizations, newton_iterations, projections, ..none }
    }
}

impl Add for Work {
    type Output = Self;
    fn add(self, other: Self) -> Self {
        Work {
            rhs_evaluations: self.rhs_evaluations + other.rhs_evaluations,
            jacobian_evaluations: self.jacobian_evaluations + other.jacobian_evaluations,
            factorizations: self.factorizations + other.factorizations,
            newton_iterations: self.newton_iterations + other.newton_iterations,
            projections: self.projections + other.projections,
        }
    }
}
