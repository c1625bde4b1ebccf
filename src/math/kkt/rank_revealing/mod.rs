//! The rank-revealing solve, dense: coordinates split by a pivoted QR of G^T into range and null space.

mod chart;
mod pivoted;
mod reduced;

pub use chart::CorrectionChart;
pub use reduced::Reduced;

use super::orthonormal::{normalize, orthonormalize, project_out};
use super::system::System;
use super::{Pattern, Singular};
use crate::math::{add, index_of_largest, norm};
use crate::tolerances;
use pivoted::{PivotedCholesky, PivotedQr};

/// With S = diag(M)^-1/2 (massless coordinates: the largest of the others) and rows of G S scaled by D^-1 to unit norm:
///
/// ```text
/// (D^-1 G S)^T Pi = [Y Z] [R11 R12; 0 0],   a = S (Y y + Z z),   R11^T y = (D^-1 r2)_1,
/// (Z^T S M S Z) z = Z^T S (r1 - M S Y y),   R11 (D lambda)_1 = Y^T S (r1 - M a).
/// ```
///
/// The null space of G^T is N = D^-1 Pi [-R11^-1 R12; I], made orthonormal; I - N N^T projects r2 before (least
/// squares) and lambda after (least norm), both in the units of the given rows.
/// Costs 3 n m^2 + 4 n^2 (n - r) to factor, about 8 n m to solve.
pub(super) struct NullSpace {
    qr: PivotedQr,
    reduced: PivotedCholesky,
    scale: Vec<f64>,
    norms: Vec<f64>,
    /// N by columns, m x (m - r). Grows when the rank falls below any before.
    null: Vec<f64>,
    inconsistency: f64,
    /// Scratch: n numbers (`a`, `w`, `top`) and m numbers.
    a: Vec<f64>,
    w: Vec<f64>,
    top: Vec<f64>,
    lambda: Vec<f64>,
    bottom: Vec<f64>,
}

impl NullSpace {
    pub fn new(mass: &Pattern, g: &Pattern) -> Self {
        let n = mass.rows;
        let m = g.rows;
        NullSpace {
            qr: PivotedQr::new(n, m),
            reduced: PivotedCholesky::new(n),
            scale: vec![1.0; n],
            norms: vec![1.0; m],
            null: Vec::new(),
            inconsistency: 0.0,
            a: vec![0.0; n],
            w: vec![0.0; n],
            top: vec![0.0; n],
            lambda: vec![0.0; m],
            bottom: vec![0.0; m],
        }
    }

    pub fn is_deficient(&self, tolerance: f64) -> bool {
        self.qr.is_deficient(tolerance)
    }

    /// Drops these rows, and those that depend on the others, from now on; right sides of these rows are not read.
    pub fn drop_rows(&mut self, rows: &[usize]) {
        self.qr.bars.fill(false);
        rows.iter().filter(|row| **row < self.norms.len()).for_each(|row| self.qr.bars[*row] = true);
    }

    /// Dependent rows, which are dropped.
    pub fn left_out(&self) -> &[usize] {
        &self.qr.permutation[self.qr.rank..]
    }

    /// Norm of the inconsistent part of the last right side r2.
    pub fn inconsistency(&self) -> f64 {
        self.inconsistency
    }

    /// (R_rr / R_00)^2, comparable with ratios of pivots.
    pub fn smallest_ratio(&self) -> f64 {
        self.qr.smallest_ratio().powi(2)
    }

    /// Factors; rows count as dependent below `tolerance` of the largest pivot.
    pub fn factor(&mut self, system: &System, tolerance: f64) -> Result<(), Singular> {
        coordinate_scale(&system.mass, &system.mass_values, &mut self.scale);
        scaled_rows(&system.g, &system.g_values, &self.scale, &mut self.norms, &mut self.qr.values);
        self.qr.factor(tolerance);
        self.factor_reduced(system)?;
        self.span_null();
        Ok(())
    }

    /// Factors Z^T S M S Z, made by columns: the lower part of Q^T S M S Q e_k.
    fn factor_reduced(&mut self, system: &System) -> Result<(), Singular> {
        let n = self.scale.len();
        let r = self.qr.rank;
        let size = n - r;
        self.reduced.size = size;
        for k in 0..size {
            self.a.fill(0.0);
            self.a[r + k] = 1.0;
            self.qr.apply(&mut self.a);
            scale_by(&self.scale, &mut self.a);
            self.w.fill(0.0);
            system.mass.multiply_symmetric(&system.mass_values, &self.a, &mut self.w);
            scale_by(&self.scale, &mut self.w);
            self.qr.apply_transposed(&mut self.w);
            self.reduced.values[k * size..(k + 1) * size].copy_from_slice(&self.w[r..]);
        }
        if self.reduced.factor(tolerances::COLLAPSED_FAST, &mut self.a[r..]).is_err() {
            self.a[..r].fill(0.0);
            self.qr.apply(&mut self.a);
            scale_by(&self.scale, &mut self.a);
            return Err(Singular::Undetermined { coordinate: index_of_largest(&self.a) });
        }
        Ok(())
    }

    /// Makes N orthonormal.
    fn span_null(&mut self) {
        let m = self.norms.len();
        let r = self.qr.rank;
        self.null.resize(m * (m - r), 0.0);
        for k in r..m {
            self.bottom.fill(0.0);
            let column = self.qr.r(k);
            self.bottom[..column.len()].iter_mut().zip(column).for_each(|(b, c)| *b = -c);
            self.qr.solve(&mut self.bottom);
            self.bottom[k] = 1.0;
            let (done, rest) = self.null.split_at_mut((k - r) * m);
            let own = &mut rest[..m];
            for (&b, &p) in self.bottom.iter().zip(&self.qr.permutation) {
                own[p] = b / self.norms[p];
            }
            normalize(own);
            orthonormalize(done, own);
        }
    }

    /// Solves in place, with one refinement.
    pub fn solve(&mut self, system: &System, top: &mut [f64], bottom: &mut [f64]) {
        self.inconsistency = if self.qr.bars.contains(&true) { 0.0 } else { project_out(&self.null, bottom) };
        let mut t = std::mem::take(&mut self.top);
        let mut b = std::mem::take(&mut self.bottom);
        t.copy_from_slice(top);
        b.copy_from_slice(bottom);
        self.solve_once(system, &mut t, &mut b);
        system.residual(&t, &b, top, bottom);
        self.solve_once(system, top, bottom);
        add(&t, top);
        add(&b, bottom);
        project_out(&self.null, bottom);
        (self.top, self.bottom) = (t, b);
    }

    fn solve_once(&mut self, system: &System, top: &mut [f64], bottom: &mut [f64]) {
        let r = self.qr.rank;
        for (x, &p) in self.lambda.iter_mut().zip(&self.qr.permutation) {
            *x = bottom[p] / self.norms[p];
        }
        self.qr.solve_transposed(&mut self.lambda);
        // a = S Y y, then w = Q^T S (r1 - M a) gives z.
        self.a.fill(0.0);
        self.a[..r].copy_from_slice(&self.lambda[..r]);
        self.rotated_residual(system, top);
        self.reduced.solve(&mut self.w[r..]);
        self.a[..r].copy_from_slice(&self.lambda[..r]);
        self.a[r..].copy_from_slice(&self.w[r..]);
        self.rotated_residual(system, top);
        self.qr.solve(&mut self.w);
        bottom.fill(0.0);
        for (&w, &p) in self.w[..r].iter().zip(&self.qr.permutation) {
            bottom[p] = w / self.norms[p];
        }
        top.copy_from_slice(&self.a);
    }

    /// a := S Q a, w := Q^T S (top - M a).
    fn rotated_residual(&mut self, system: &System, top: &[f64]) {
        self.qr.apply(&mut self.a);
        scale_by(&self.scale, &mut self.a);
        self.w.copy_from_slice(top);
        system.mass.subtract_symmetric(&system.mass_values, &self.a, &mut self.w);
        scale_by(&self.scale, &mut self.w);
        self.qr.apply_transposed(&mut self.w);
    }
}

/// The tolerance of a QR below which rows also count as dependent near singular states, where the smallest ratio of
/// pivots at regular ones is `reference`: see `tolerances::TRUNCATED_RANK`.
fn truncated(tolerance: f64, reference: f64) -> f64 {
    tolerance.max(tolerances::TRUNCATED_RANK * reference)
}

/// S: the inverse roots of the masses, for coordinates without mass the largest of them.
fn coordinate_scale(mass: &Pattern, mass_values: &[f64], scale: &mut [f64]) {
    scale.fill(0.0);
    mass.add_diagonal(mass_values, scale);
    scale.iter_mut().for_each(|s| *s = if *s > 0.0 { s.sqrt().recip() } else { 0.0 });
    let largest = scale.iter().fold(0.0, |a: f64, &b| a.max(b));
    let massless = if largest > 0.0 { largest } else { 1.0 };
    scale.iter_mut().filter(|s| **s == 0.0).for_each(|s| *s = massless);
}

/// The sizes of the rows of G S, and (D^-1 G S)^T by columns.
fn scaled_rows(g: &Pattern, g_values: &[f64], scale: &[f64], norms: &mut [f64], columns: &mut [f64]) {
    let n = scale.len();
    columns.fill(0.0);
    for (&(j, i), value) in g.entries.iter().zip(g_values) {
        columns[j * n + i] += value * scale[i];
    }
    for (column, length) in columns.chunks_exact_mut(n.max(1)).zip(norms) {
        *length = Some(norm(column)).filter(|length| *length > 0.0).unwrap_or(1.0);
        column.iter_mut().for_each(|v| *v /= *length);
    }
}

fn scale_by(scale: &[f64], x: &mut [f64]) {
    for (x, s) in x.iter_mut().zip(scale) {
        *x *= s;
    }
}
