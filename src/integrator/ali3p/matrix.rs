//! The tangent matrix with the penalty of the constraints.

use super::super::Problem;
use crate::formulation::{NO_TANGENT, StepError, write_diagonal};
use crate::math::kkt::{Pattern, Unsymmetric};
use crate::system::{MechanicalSystem, OperatingPoint, Tangent};
use std::collections::BTreeSet;

/// M + h/2 C + h^2/4 (K + G^T alpha G), with h^2/4 alpha in `weight`.
pub(super) struct Penalized {
    penalty: f64,
    tangent: Tangent,
    matrix: Unsymmetric<f64>,
    /// An empty pattern: the constraints are in the penalty, not in rows of their own.
    none: Pattern,
    /// Places of the values of G by row.
    rows: Vec<Vec<usize>>,
    /// G at the last factorization.
    g: Vec<f64>,
    diagonal: Vec<f64>,
    weight: Vec<f64>,
    rest: Vec<f64>,
}

impl Penalized {
    /// Memory for a system; `None` if there is not enough.
    pub fn new(penalty: f64, system: &dyn MechanicalSystem) -> Option<Self> {
        let structure = system.structure();
        let g = &structure.g;
        let mut rows = vec![Vec::new(); g.rows];
        g.entries.iter().enumerate().for_each(|(entry, &(row, _))| rows[row].push(entry));
        let columns = |row: &Vec<usize>| -> Vec<usize> { row.iter().map(|&entry| g.entries[entry].1).collect() };
        let mut places: BTreeSet<(usize, usize)> = structure.tangent.entries.iter().copied().collect();
        for row in rows.iter().map(columns) {
            places.extend(row.iter().flat_map(|&i| row.iter().map(move |&j| (i, j))));
        }
        let all = Pattern { rows: g.cols, cols: g.cols, entries: places.into_iter().collect() };
        let none = Pattern { rows: 0, cols: g.cols, entries: Vec::new() };
        Some(Penalized {
            penalty,
            tangent: Tangent::new(&structure.tangent),
            matrix: Unsymmetric::new(&structure.mass, &all, &none)?,
            none,
            g: vec![0.0; g.entries.len()],
            diagonal: vec![0.0; g.cols],
            weight: vec![0.0; g.rows],
            rest: vec![0.0; g.rows],
            rows,
        })
    }

    /// Factors at a state whose terms are in the problem.
    pub fn factor(&mut self, problem: &mut Problem, at: OperatingPoint, h: f64) -> Result<(), StepError> {
        let dynamics = &mut problem.dynamics;
        if !dynamics.system.tangent(at, &mut self.tangent, &mut dynamics.scratch) {
            return Err(NO_TANGENT);
        }
        dynamics.statistics.jacobian_evaluations += 1;
        dynamics.statistics.factorizations += 1;
        self.weigh(problem);
        self.g.copy_from_slice(&problem.dynamics.terms.g);
        let structure = &problem.dynamics.structure;
        let terms = &problem.dynamics.terms;
        self.matrix.clear();
        self.matrix.add(&structure.mass, &terms.mass, 1.0, true);
        self.matrix.add(&structure.tangent, &self.tangent.c, 0.5 * h, false);
        self.matrix.add(&structure.tangent, &self.tangent.k, 0.25 * h * h, false);
        for (row, weight) in self.rows.iter().zip(&self.weight) {
            for (&a, &b) in row.iter().flat_map(|a| row.iter().map(move |b| (a, b))) {
                let i = structure.g.entries[a].1;
                let j = structure.g.entries[b].1;
                self.matrix.add_entry(i, j, weight * self.g[a] * self.g[b]);
            }
        }
        Ok(self.matrix.factor(&self.none, &[])?)
    }

    /// Sets alpha: penalty / (G diag(M)^-1 G^T)_jj, over coordinates with mass; 1 in place of a zero diagonal.
    fn weigh(&mut self, problem: &Problem) {
        let structure = &problem.dynamics.structure;
        let terms = &problem.dynamics.terms;
        write_diagonal(&structure.mass, &terms.mass, &mut self.diagonal);
        self.weight.fill(0.0);
        for (&(row, i), g) in structure.g.entries.iter().zip(&terms.g).filter(|((_, i), _)| self.diagonal[*i] > 0.0) {
            self.weight[row] += g * g / self.diagonal[i];
        }
        let penalty = self.penalty;
        self.weight.iter_mut().for_each(|size| *size = if *size > 0.0 { penalty / *size } else { penalty });
    }

    /// Solves W x = right - h^2/4 G^T alpha rows in place, and writes h^2/4 alpha (rows + G x) to `rows`. Uses the G of
    /// W: another one would add a part along the motion, which alpha makes large.
    pub fn solve(&mut self, g: &Pattern, rows: &mut [f64], right: &mut [f64]) -> Result<(), StepError> {
        self.rest.copy_from_slice(rows);
        rows.iter_mut().zip(&self.weight).for_each(|(row, weight)| *row *= -weight);
        g.multiply_transposed(&self.g, rows, right);
        self.matrix.solve(right, &mut [])?;
        g.multiply(&self.g, right, &mut self.rest);
        rows.iter_mut().zip(self.rest.iter().zip(&self.weight)).for_each(|(row, (rest, weight))| *row = weight * rest);
        Ok(())
    }
}
