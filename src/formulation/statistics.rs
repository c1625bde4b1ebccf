//! Counters of work.

use serde::{Deserialize, Serialize};
use std::ops::Add;

/// Work done in a run.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
pub struct Statistics {
    /// Accepted steps.
    pub steps: u64,
    /// Rejected steps.
    pub rejected: u64,
    /// Evaluations of the equations of motion.
    pub rhs_evaluations: u64,
    /// Evaluations of the Jacobian K, C of implicit methods.
    pub jacobian_evaluations: u64,
    /// Factorizations of the saddle-point matrix.
    pub factorizations: u64,
    /// Iterations of Newton's method.
    pub newton_iterations: u64,
    /// Newton solutions that ended at the round-off floor instead of the tolerance, and steps of `bdf` whose error is
    /// above the tolerance, but no more than round-off.
    pub stagnated: u64,
    /// Sweeps of the projection.
    pub projections: u64,
    /// Accepted states at which G was rank deficient.
    pub rank_deficient: u64,
    /// Work outside the steps: a first look at the start, output rows, and the search for thresholds within steps.
    #[doc(hidden)]
    pub rows: Work,
}

impl Statistics {
    /// Work of the steps alone, without `rows`.
    #[doc(hidden)]
    pub fn of_steps(&self) -> Work {
        let Statistics {
            rhs_evaluations, jacobian_evaluations, factorizations, newton_iterations, projections, ..
        } = *self;
        Work { rhs_evaluations, jacobian_evaluations, factorizations, newton_iterations, projections }
    }

    /// True if no counter is beyond what a run could count: sums of two do not overflow.
    pub fn is_possible(&self) -> bool {
        let Statistics { steps, rejected, stagnated, rank_deficient, .. } = *self;
        let of = |work: Work| {
            let Work { rhs_evaluations, jacobian_evaluations, factorizations, newton_iterations, projections } = work;
            [rhs_evaluations, jacobian_evaluations, factorizations, newton_iterations, projections]
        };
        let works = of(self.of_steps()).into_iter().chain(of(self.rows));
        works.chain([steps, rejected, stagnated, rank_deficient]).all(|count| count <= u64::MAX / 4)
    }

    /// Work of steps and `rows`.
    #[doc(hidden)]
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

/// Counters of the operations that take time, as in [`Statistics`].
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
pub struct Work {
    /// Evaluations of the equations of motion.
    pub rhs_evaluations: u64,
    /// Evaluations of the Jacobian K, C of implicit methods.
    pub jacobian_evaluations: u64,
    /// Factorizations of the saddle-point matrix.
    pub factorizations: u64,
    /// Iterations of Newton's method.
    pub newton_iterations: u64,
    /// Sweeps of the projection.
    pub projections: u64,
}

impl From<Work> for Statistics {
    /// Counts the work as that of the steps.
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
