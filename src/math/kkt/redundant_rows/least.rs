//! Projection onto the range of G: it makes right sides consistent (least squares) and multipliers least in norm.
//!
//! Every dropped row j gives a null vector of G^T, e_j - c, where G^T c = G_j^T is solved by the solver of the system
//! without these rows. Every other row i gives G x in the range, where x moves row i by one and no other of the solver.
//! With an orthonormal basis Q of these, whichever are fewer, P = I - Q Q^T or P = Q Q^T. Where both are very many, right
//! sides of dropped rows are not read, and their multipliers stay zero.

use super::super::Pattern;
use super::super::orthonormal::{orthogonalize, orthonormalize, project_out};
use super::super::system::System;
use crate::math::{add, add_scaled, norm};
use crate::tolerances;

/// Solves the system without the dropped rows, whose right sides are ignored and whose multipliers are zero.
pub type Solve<'s> = &'s mut dyn FnMut(&mut [f64], &mut [f64]);

pub struct Least {
    /// Orthonormal vectors, one after the other, of the range of G if `is_range`, else of the null space of G^T.
    basis: Vec<f64>,
    is_range: bool,
    /// True if the basis belongs to the last factors.
    is_current: bool,
    /// Scratch: n and m numbers.
    a: Vec<f64>,
    vector: Vec<f64>,
    correction: Vec<f64>,
}

/// True if so many dependent rows of all get multipliers of least norm; beyond, those that are dropped carry no force.
pub fn has_least_norm(dependent: usize, rows: usize) -> bool {
    let vectors = dependent.min(rows - dependent);
    // Four times as many operations take 0.1 s: 260 of 1500 rows, 70 of 20,000.
    vectors.saturating_mul(vectors).saturating_mul(rows) <= 100_000_000
}

impl Least {
    pub fn new(g: &Pattern) -> Self {
        let zeros = || vec![0.0; g.rows];
        Least {
            basis: Vec::new(),
            is_range: false,
            is_current: false,
            a: vec![0.0; g.cols],
            vector: zeros(),
            correction: zeros(),
        }
    }

    /// Forgets the basis of the last matrix.
    pub fn clear(&mut self) {
        self.is_current = false;
    }

    /// v := P v with these rows dropped; returns the norm of the removed part. Very many rows leave v as it is, and the
    /// norm is that of what the dropped ones miss of it where the others are met: zero for the same v, else larger.
    pub fn project(&mut self, system: &System, rows: &[usize], solve: Solve, v: &mut [f64]) -> f64 {
        if rows.is_empty() {
            return 0.0;
        }
        if !has_least_norm(rows.len(), system.g.rows) {
            self.correction.copy_from_slice(v);
            self.image(system, solve);
            return rows.iter().map(|&row| (v[row] - self.vector[row]).powi(2)).sum::<f64>().sqrt();
        }
        if !self.is_current {
            self.span(system, rows, solve);
        }
        if !self.is_range {
            return project_out(&self.basis, v);
        }
        self.vector.copy_from_slice(v);
        project_out(&self.basis, &mut self.vector);
        add_scaled(-1.0, &self.vector, v);
        norm(&self.vector)
    }

    fn span(&mut self, system: &System, rows: &[usize], solve: Solve) {
        self.basis.clear();
        self.is_current = true;
        self.is_range = 2 * rows.len() > system.g.rows;
        if !self.is_range {
            for &row in rows {
                self.null(system, |vector| vector[row] = 1.0, solve);
                orthonormalize(&self.basis, &mut self.vector);
                self.basis.extend_from_slice(&self.vector);
            }
            return;
        }
        for row in (0..system.g.rows).filter(|row| !rows.contains(row)) {
            self.correction.fill(0.0);
            self.correction[row] = 1.0;
            self.image(system, solve);
            let length = norm(&self.vector);
            let left = orthogonalize(&self.basis, &mut self.vector);
            // The solver may have further dependent rows.
            if left > tolerances::RANK * length {
                self.basis.extend(self.vector.iter().map(|x| x / left));
            }
        }
    }

    /// The null vector of G^T with what `direction` writes on the dropped rows: e_j - c for e_j.
    pub fn null(&mut self, system: &System, direction: impl Fn(&mut [f64]), solve: Solve) -> &[f64] {
        self.vector.fill(0.0);
        direction(&mut self.vector);
        // Corrected once, since multipliers of rows in small units multiply the errors of a solution.
        for _ in 0..2 {
            self.a.fill(0.0);
            system.g.subtract_transposed(&system.g_values, &self.vector, &mut self.a);
            self.correction.fill(0.0);
            solve(&mut self.a, &mut self.correction);
            add(&self.correction, &mut self.vector);
        }
        &self.vector
    }

    /// vector := G x, where x moves the rows that are not dropped by `correction`.
    fn image(&mut self, system: &System, solve: Solve) {
        self.a.fill(0.0);
        solve(&mut self.a, &mut self.correction);
        self.vector.fill(0.0);
        system.g.multiply(&system.g_values, &self.a, &mut self.vector);
    }
}
