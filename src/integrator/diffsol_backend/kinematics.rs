//! q' = N(q) v and its derivatives.

use crate::math::kkt::Pattern;
use crate::system::MechanicalSystem;

/// N and N^+ column by column of N, places and values. A derivative along the directions of v, as K, G and L are,
/// becomes one with respect to q by N^+ = (N^T N)^-1 N^T from the right; N^T N is diagonal for unit quaternions. The
/// angles that count full turns are omitted: no force depends on them.
pub struct Kinematics {
    columns: Vec<Vec<(usize, f64)>>,
    inverse: Vec<Vec<(usize, f64)>>,
    is_identity: bool,
    rest: [Vec<f64>; 3],
}

impl Kinematics {
    pub fn new(system: &dyn MechanicalSystem) -> Self {
        let n = system.dimensions();
        let identity: Vec<_> = (0..n.v).map(|j| Vec::from_iter((j < n.moving()).then_some((j, 1.0)))).collect();
        let zeros = || vec![0.0; n.q];
        Kinematics {
            columns: identity.clone(),
            inverse: identity,
            is_identity: n.q == n.moving(),
            rest: [zeros(), zeros(), zeros()],
        }
    }

    /// N and N^+ at q.
    pub fn update(&mut self, system: &dyn MechanicalSystem, q: &[f64]) {
        if self.is_identity {
            return;
        }
        let mut unit = vec![0.0; self.columns.len()];
        let rate = &mut self.rest[0];
        let own = rate.len() - system.turning_angles();
        for j in 0..unit.len() {
            unit[j] = 1.0;
            system.rate(q, &unit, rate);
            unit[j] = 0.0;
            let square: f64 = rate[..own].iter().map(|x| x * x).sum();
            let places = || rate.iter().enumerate().filter(|(_, x)| **x != 0.0);
            self.columns[j] = places().map(|(i, x)| (i, *x)).collect();
            self.inverse[j] = places().filter(|(i, _)| *i < own).map(|(i, x)| (i, x / square)).collect();
        }
    }

    /// Adds N, its first entry at `at`.
    pub fn by_v(&self, at: (usize, usize), out: &mut Dense) {
        for (j, column) in self.columns.iter().enumerate() {
            column.iter().for_each(|&(i, value)| out.add(at.0 + i, at.1 + j, value));
        }
    }

    /// Adds d(N v)/dq: exact where N is affine in q, as with quaternions; without the rows of the angles that count
    /// full turns, on which nothing else depends.
    pub fn by_q(&mut self, system: &dyn MechanicalSystem, q: &[f64], v: &[f64], out: &mut Dense) {
        if self.is_identity {
            return;
        }
        let [rate, moved, varied] = &mut self.rest;
        let own = rate.len() - system.turning_angles();
        system.rate(q, v, rate);
        moved.copy_from_slice(q);
        for j in 0..own {
            moved[j] = q[j] + 1.0;
            system.rate(moved, v, varied);
            moved[j] = q[j];
            for (i, (varied, rate)) in varied.iter().zip(rate.iter()).enumerate().take(own) {
                out.add(i, j, varied - rate);
            }
        }
    }

    /// Adds a derivative along the directions of v as one with respect to q, its first entry in row `row`.
    pub fn along(&self, row: usize, pattern: &Pattern, values: &[f64], out: &mut Dense) {
        pattern.entries.iter().zip(values).for_each(|(&(i, j), value)| self.add_along(row + i, j, *value, out));
    }

    /// Adds one entry in column `j` of such a derivative.
    pub fn add_along(&self, row: usize, j: usize, value: f64, out: &mut Dense) {
        self.inverse[j].iter().for_each(|&(k, weight)| out.add(row, k, value * weight));
    }
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

    /// Adds a matrix, its first entry at `at`.
    pub fn block(&mut self, at: (usize, usize), pattern: &Pattern, values: &[f64]) {
        pattern.entries.iter().zip(values).for_each(|(&(i, j), value)| self.add(at.0 + i, at.1 + j, *value));
    }

    /// Adds the transpose of a matrix, its first entry at `at`.
    pub fn transposed(&mut self, at: (usize, usize), pattern: &Pattern, values: &[f64]) {
        pattern.entries.iter().zip(values).for_each(|(&(i, j), value)| self.add(at.0 + j, at.1 + i, *value));
    }

    /// Adds `factor` times a symmetric matrix given by one triangle.
    pub fn symmetric(&mut self, at: (usize, usize), pattern: &Pattern, values: &[f64], factor: f64) {
        for (&(i, j), value) in pattern.entries.iter().zip(values) {
            self.add(at.0 + i, at.1 + j, factor * value);
            if i != j {
                self.add(at.0 + j, at.1 + i, factor * value);
            }
        }
    }
}
