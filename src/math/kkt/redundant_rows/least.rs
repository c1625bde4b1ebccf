//! Projection onto the null space of G^T: multipliers that dependent rows leave undetermined, and inconsistent right
//! sides.
//!
//! Every dropped row j gives a null vector n_j = e_j - c, where G^T c = G_j^T is solved by the solver of the system
//! without these rows. The part of N = [n_j] on the dropped rows is the identity, so that N^T N >= I is well
//! conditioned. Then P = I - N (N^T N)^-1 N^T makes right sides consistent (least squares) and multipliers least in
//! norm. A few null vectors are made orthonormal once for a factorization; for many, P is applied by conjugate
//! gradients from `Nearly`, which has it nearly right and is their preconditioner.

use super::super::Pattern;
use super::super::orthonormal::{orthonormalize, project_out};
use super::super::system::{System, add, add_scaled};
use super::nearly::Nearly;
use crate::math::{dot, norm};
use crate::tolerances::math as tolerances;

/// Solves the system without the dropped rows, whose right sides are ignored and whose multipliers are zero.
pub type Solve<'s> = &'s mut dyn FnMut(&mut [f64], &mut [f64]);

pub struct Least {
    nearly: Option<Box<Nearly>>,
    /// Orthonormal null vectors, one after the other, if they are few. `is_current`: these and `nearly` belong to the
    /// last factors.
    basis: Vec<f64>,
    is_current: bool,
    /// Scratch: n and m numbers.
    a: Vec<f64>,
    lambda: Vec<f64>,
    weights: Vec<f64>,
    residual: Vec<f64>,
    direction: Vec<f64>,
    image: Vec<f64>,
}

impl Least {
    pub fn new(g: &Pattern) -> Self {
        let zeros = || vec![0.0; g.rows];
        Least {
            nearly: None,
            basis: Vec::with_capacity(tolerances::NULL_VECTORS.min(g.rows) * g.rows),
            is_current: false,
            a: vec![0.0; g.cols],
            lambda: zeros(),
            weights: zeros(),
            residual: zeros(),
            direction: zeros(),
            image: zeros(),
        }
    }

    /// Forgets the null vectors of the last matrix.
    pub fn clear(&mut self) {
        self.is_current = false;
    }

    /// v := P v; returns the norm of the removed part. `rank_indicator`: see `Nearly`. A solution
    /// is dear where it projects itself.
    pub fn project(
        &mut self,
        system: &System,
        rows: &[usize],
        (rank_indicator, is_dear): (f64, bool),
        solve: Solve,
        v: &mut [f64],
    ) -> f64 {
        let most = if is_dear { tolerances::NULL_VECTORS_IF_DEAR } else { tolerances::NULL_VECTORS };
        match rows.len() {
            0 => 0.0,
            count if count <= most => self.project_directly(system, rows, solve, v),
            _ => self.project_by_gradients(system, rows, rank_indicator, solve, v),
        }
    }

    fn project_directly(&mut self, system: &System, rows: &[usize], solve: Solve, v: &mut [f64]) -> f64 {
        if !self.is_current {
            self.span(system, rows, solve);
        }
        project_out(&self.basis, v)
    }

    /// Makes the orthonormal basis of null vectors.
    fn span(&mut self, system: &System, rows: &[usize], solve: Solve) {
        self.basis.clear();
        for row in rows {
            self.direction.fill(0.0);
            self.direction[*row] = 1.0;
            self.null(system, solve);
            self.refine_null(system, solve);
            orthonormalize(&self.basis, &mut self.image);
            self.basis.extend_from_slice(&self.image);
        }
        self.is_current = true;
    }

    /// v := P v by conjugate gradients with residual N^T (v - N w), from w of `nearly`.
    fn project_by_gradients(
        &mut self,
        system: &System,
        rows: &[usize],
        rank_indicator: f64,
        solve: Solve,
        v: &mut [f64],
    ) -> f64 {
        let nearly = self.nearly.get_or_insert_with(|| Box::new(Nearly::new(system)));
        if !self.is_current {
            nearly.factor(system, rank_indicator);
            self.is_current = true;
        }
        self.residual.copy_from_slice(v);
        nearly.null_part(&mut self.residual);
        keep(rows, &self.residual, &mut self.direction);
        self.null(system, solve);
        self.weights.copy_from_slice(&self.image);
        let tolerance = tolerances::ROUND_OFF_OF_SUMS * dot(v, v).max(dot(&self.weights, &self.weights)).sqrt();
        self.residual.copy_from_slice(v);
        add_scaled(-1.0, &self.weights, &mut self.residual);
        self.null_transposed(system, rows, solve);
        let mut product = 0.0;
        let mut least = f64::INFINITY;
        let mut waited = 0;
        self.direction.fill(0.0);
        for _ in 0..tolerances::GRADIENTS {
            let size = norm(&self.residual);
            (least, waited) = if size < 0.5 * least { (size, 0) } else { (least, waited + 1) };
            if waited > tolerances::GRADIENTS_WITHOUT_GAIN || size <= tolerance || size.is_nan() {
                break;
            }
            let next = self.turn(rows, product);
            // image = N p, and p^T N^T N p = |N p|^2.
            self.null(system, solve);
            let step = next / dot(&self.image, &self.image);
            add_scaled(step, &self.image, &mut self.weights);
            // Computing r = N^T (v - N w) anew would cost as much as this update.
            std::mem::swap(&mut self.residual, &mut self.image);
            self.null_transposed(system, rows, solve);
            std::mem::swap(&mut self.residual, &mut self.image);
            add_scaled(-step, &self.image, &mut self.residual);
            product = next;
        }
        add_scaled(-1.0, &self.weights, v);
        norm(&self.weights)
    }

    /// Sets the next direction; returns r^T z with the preconditioned residual z. `last` is that of the last step.
    fn turn(&mut self, rows: &[usize], last: f64) -> f64 {
        self.image.copy_from_slice(&self.residual);
        self.nearly.iter_mut().for_each(|nearly| nearly.null_part(&mut self.image));
        let next = dot(&self.residual, &self.image);
        let ratio = if last > 0.0 { next / last } else { 0.0 };
        keep(rows, &self.image, &mut self.lambda);
        self.direction.iter_mut().zip(&self.lambda).for_each(|(p, z)| *p = z + ratio * *p);
        next
    }

    /// image = N direction, where `direction` is zero except on the dropped rows.
    fn null(&mut self, system: &System, solve: Solve) {
        self.a.fill(0.0);
        system.g.subtract_transposed(&system.g_values, &self.direction, &mut self.a);
        self.image.fill(0.0);
        solve(&mut self.a, &mut self.image);
        add(&self.direction, &mut self.image);
    }

    /// Corrects `image` by what is left of G^T image, since multipliers of rows in small units multiply its errors.
    fn refine_null(&mut self, system: &System, solve: Solve) {
        self.a.fill(0.0);
        system.g.subtract_transposed(&system.g_values, &self.image, &mut self.a);
        self.lambda.fill(0.0);
        solve(&mut self.a, &mut self.lambda);
        add(&self.lambda, &mut self.image);
    }

    /// residual := N^T residual, stored on the dropped rows.
    fn null_transposed(&mut self, system: &System, rows: &[usize], solve: Solve) {
        self.a.fill(0.0);
        self.lambda.copy_from_slice(&self.residual);
        solve(&mut self.a, &mut self.lambda);
        self.lambda.copy_from_slice(&self.residual);
        system.g.subtract(&system.g_values, &self.a, &mut self.lambda);
        keep(rows, &self.lambda, &mut self.residual);
    }
}

/// `to` := `from` on these rows, zero on the others.
fn keep(rows: &[usize], from: &[f64], to: &mut [f64]) {
    to.fill(0.0);
    rows.iter().for_each(|row| to[*row] = from[*row]);
}
