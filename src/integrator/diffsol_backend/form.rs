//! Equations as implicit integrators take them.

use super::super::From;
use crate::formulation::{Dynamics, Halt, Statistics};
use crate::math::kkt::Pattern;

/// x' = F(t, x) in the first unknowns, which are q, v and the work, and 0 = F(t, x) in the rest, the algebraic ones.
pub trait Form {
    /// How many unknowns x has.
    fn len(&self) -> usize;

    /// x and x' where a run starts, from q, v and the work with their rates.
    fn start(&mut self, from: From, x: &mut [f64], rate: &mut [f64]) -> Result<(), Halt>;

    fn evaluate(&mut self, t: f64, x: &[f64], out: &mut [f64]) -> Result<(), Halt>;

    /// Adds dF/dx, or what is close enough to it for Newton's method, to a matrix of zeros.
    fn jacobian(&mut self, t: f64, x: &[f64], out: &mut Dense) -> Result<(), Halt>;

    /// Leaves out the rows of constraints, and takes the pieces of functions, that the run does.
    fn follow(&mut self, run: &Dynamics);

    /// The work done here.
    fn statistics(&mut self) -> &mut Statistics;
}

/// A square matrix, column by column.
pub struct Dense<'m> {
    pub n: usize,
    pub values: &'m mut [f64],
}

impl Dense<'_> {
    pub fn add(&mut self, row: usize, column: usize, value: f64) {
        self.values[column * self.n + row] += value;
    }

    /// Adds a matrix with its first entry at `at`.
    pub fn block(&mut self, at: (usize, usize), pattern: &Pattern, values: &[f64]) {
        pattern.entries.iter().zip(values).for_each(|(&(i, j), value)| self.add(at.0 + i, at.1 + j, *value));
    }

    /// Adds the transposed matrix.
    pub fn transposed(&mut self, at: (usize, usize), pattern: &Pattern, values: &[f64]) {
        pattern.entries.iter().zip(values).for_each(|(&(i, j), value)| self.add(at.0 + j, at.1 + i, *value));
    }

    /// Adds `factor` times a symmetric matrix of which the entries give one triangle.
    pub fn symmetric(&mut self, at: (usize, usize), pattern: &Pattern, values: &[f64], factor: f64) {
        for (&(i, j), value) in pattern.entries.iter().zip(values) {
            self.add(at.0 + i, at.1 + j, factor * value);
            if i != j {
                self.add(at.0 + j, at.1 + i, factor * value);
            }
        }
    }
}
