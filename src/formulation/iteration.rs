//! The Newton matrices of implicit methods.

use super::linearized::Linearized;
use super::{Dae, DaeRow, Dynamics, Residual, StepError};
use crate::math::array::Each;
use crate::math::kkt::{Field, Pattern, Places, SaddlePoint, Singular, Unsymmetric};
use crate::system::{MechanicalSystem, Structure};
use faer::c64;
use std::ops::{Add, DivAssign};

/// Derivatives of q and v with respect to a method's unknowns: dv = v da + w dw, dq = q da + w_q dw + u du.
#[derive(Clone, Copy, Debug)]
pub struct Slopes<T> {
    /// dv/da, s.
    pub v: T,
    /// dq/da, s^2.
    pub q: T,
    /// dv/dw, s.
    pub w: T,
    /// dq/dw, s^2.
    pub w_q: T,
    /// dq/du, s.
    pub u: T,
}

impl<T: Number> Slopes<T> {
    /// Those of v = v* + h (a + w), q = q* + h N (v + u).
    pub fn implicit(h: T) -> Self {
        Slopes { v: h, q: h * h, w: h, w_q: h * h, u: h }
    }
}

/// With q and v eliminated by their slopes s, a change of the unknowns solves
///
/// ```text
/// [ M + s_v C + s_q K   G^T ] [ da      ]   [ f - M a - G^T lambda ]
/// [ G + (l/g) L         0   ] [ dlambda ] = [ -(row of lambda)/g   ]
///
/// g = c_0 s_q + c_1 s_v + c_2,   l = c_1 s_q + 2 c_2 s_v
/// ```
///
/// minus the effect of the shifts dw and du on these rows. The shifts are solved for first, from the rows of eta and mu
/// with the G da that the row of lambda prescribes:
///
/// ```text
/// [ M  G^T ] [ dw   ]   [ -M w - G^T eta                   ]
/// [ G  0   ] [ deta ] = [ -(row of eta + its g G da) / ... ]    and du likewise, with the M of [`Linearized::weigh`]
/// ```
///
/// The rows have the size of accelerations for any step h. The derivative of phi'' with respect to q by h^2 is
/// neglected. Source: Hairer, Wanner, Solving Ordinary Differential Equations II, IV.8, with the second-order structure
/// used.
pub struct Iteration<T> {
    /// The matrix above with its factors.
    pub matrix: Unsymmetric<T>,
    /// Places in it of M, and of K and C.
    places: [Places; 2],
    rows: RowSlopes<T>,
    slopes: Slopes<T>,
    /// On entry of a solution the residual, afterwards the change.
    pub change: Change<T>,
    part: [Vec<f64>; 2],
    /// G dw and G du.
    moved: [Vec<T>; 2],
}

/// Changes of the unknowns; on entry of a solution the residual.
pub struct Change<T> {
    /// Change of a, n_v.
    pub a: Vec<T>,
    /// Change of lambda, n_c.
    pub lambda: Vec<T>,
    /// Change of the velocity shift w, n_v.
    pub w: Vec<T>,
    /// Change of the position shift u, n_v.
    pub u: Vec<T>,
    /// Change of eta, the multipliers of w, n_c.
    pub eta: Vec<T>,
    /// Change of mu, the multipliers of u, n_c.
    pub mu: Vec<T>,
}

/// A real number, or a complex one that represents itself and its conjugate.
pub trait Number: Field + PartialEq + Add<Output = Self> + DivAssign {
    /// Solves [M G^T; G 0] (x, multipliers) = (x, multipliers) in place; `part` is scratch.
    ///
    /// # Errors
    /// Those of [`SaddlePoint::solve`].
    fn solve_symmetric(
        solver: &mut SaddlePoint,
        x: &mut [Self],
        multipliers: &mut [Self],
        part: &mut [Vec<f64>; 2],
    ) -> Result<(), Singular>;
    /// Sum of the number and its conjugate; a real number itself.
    fn total(self) -> f64;
}

impl Number for f64 {
    fn solve_symmetric(
        solver: &mut SaddlePoint,
        x: &mut [f64],
        multipliers: &mut [f64],
        _: &mut [Vec<f64>; 2],
    ) -> Result<(), Singular> {
        solver.solve(x, multipliers)
    }

    fn total(self) -> f64 {
        self
    }
}

impl Number for c64 {
    /// The real and the imaginary parts in turn.
    fn solve_symmetric(
        solver: &mut SaddlePoint,
        x: &mut [c64],
        multipliers: &mut [c64],
        part: &mut [Vec<f64>; 2],
    ) -> Result<(), Singular> {
        let [top, bottom] = part;
        let parts: [fn(&mut c64) -> &mut f64; 2] = [|x| &mut x.re, |x| &mut x.im];
        for of in parts {
            top.iter_mut().zip(&mut *x).for_each(|(part, x)| *part = *of(x));
            bottom.iter_mut().zip(&mut *multipliers).for_each(|(part, row)| *part = *of(row));
            solver.solve(top, bottom)?;
            x.iter_mut().zip(&*top).for_each(|(x, part)| *of(x) = *part);
            multipliers.iter_mut().zip(&*bottom).for_each(|(row, part)| *of(row) = *part);
        }
        Ok(())
    }

    fn total(self) -> f64 {
        2.0 * self.re
    }
}

/// Factors of G and L in the change of a row by a, w and u.
#[derive(Clone, Copy)]
struct RowSlope<T> {
    a: [T; 2],
    w: [T; 2],
    u: [T; 2],
}

impl<T: Number> RowSlope<T> {
    fn of(row: DaeRow, s: &Slopes<T>) -> Self {
        let by = |q: T, v: T, a: T| {
            let g = q * row.position + v * row.velocity + a * row.acceleration;
            [g, q * row.velocity + v * (2.0 * row.acceleration)]
        };
        let zero = T::ZERO;
        let one = T::real(1.0);
        RowSlope { a: by(s.q, s.v, one), w: by(s.w_q, s.w, zero), u: by(s.u, zero, zero) }
    }
}

/// The slopes of the rows of all multipliers, for holonomic constraints first, then for nonholonomic ones.
struct RowSlopes<T> {
    dae: Dae,
    holonomic: usize,
    lambda: [RowSlope<T>; 2],
    eta: [Option<RowSlope<T>>; 2],
    mu: [Option<RowSlope<T>>; 2],
}

impl<T: Number> RowSlopes<T> {
    fn new(dae: Dae, holonomic: usize, s: &Slopes<T>) -> Self {
        let both = [dae, dae.nonholonomic()];
        RowSlopes {
            dae,
            holonomic,
            lambda: both.each(|dae| RowSlope::of(dae.lambda, s)),
            eta: both.map(|dae| dae.eta.map(|row| RowSlope::of(row, s))),
            mu: both.map(|dae| dae.mu.map(|row| RowSlope::of(row, s))),
        }
    }

    fn kind(&self, row: usize) -> usize {
        usize::from(row >= self.holonomic)
    }
}

impl<T: Number> Iteration<T> {
    /// Memory for `dae` on a system; `None` if there is not enough.
    pub fn new(dae: Dae, system: &dyn MechanicalSystem) -> Option<Self> {
        let n = system.dimensions();
        let structure = system.structure();
        let zeros = |n: usize| vec![T::ZERO; n];
        let shift = |is_there: bool| if is_there { (zeros(n.v), zeros(n.lambda)) } else { (Vec::new(), Vec::new()) };
        let ((w, eta), (u, mu)) = (shift(dae.eta.is_some()), shift(dae.mu.is_some()));
        let none = Slopes { v: T::ZERO, q: T::ZERO, w: T::ZERO, w_q: T::ZERO, u: T::ZERO };
        let matrix = Unsymmetric::new(&structure.mass, &structure.tangent, &structure.g)?.for_corrections();
        Some(Iteration {
            places: [matrix.places(&structure.mass, true)?, matrix.places(&structure.tangent, false)?],
            matrix,
            rows: RowSlopes::new(dae, n.holonomic(), &none),
            slopes: none,
            change: Change { a: zeros(n.v), lambda: zeros(n.lambda), w, u, eta, mu },
            part: [vec![0.0; n.v], vec![0.0; n.lambda]],
            moved: [zeros(n.lambda), zeros(n.lambda)],
        })
    }

    /// Factors the matrix for these slopes. One factorization.
    ///
    /// # Errors
    /// A singular matrix.
    pub fn factor(&mut self, slopes: Slopes<T>, at: &Linearized, dynamics: &mut Dynamics) -> Result<(), Singular> {
        dynamics.statistics.factorizations += 1;
        let structure = &dynamics.structure;
        self.rescale(slopes);
        self.matrix.drop_rows(&dynamics.dropped);
        self.matrix.clear();
        let [of_mass, of_tangent] = &self.places;
        self.matrix.see_mass(&structure.mass, &at.mass);
        self.matrix.add_at(of_mass, &at.mass, T::real(1.0));
        self.matrix.add_at(of_tangent, &at.tangent.c, slopes.v);
        self.matrix.add_at(of_tangent, &at.tangent.k, slopes.q);
        if at.dae.needs_l() {
            let rows = &self.rows;
            let ratio = rows.lambda.each(|RowSlope { a: [g, l], .. }| l / g);
            self.matrix.couple(&at.l, |row| ratio[rows.kind(row)]);
        }
        self.matrix.factor(&structure.g, &at.g)
    }

    /// Uses these slopes for the rows, and the present factors for the matrix, whose slopes should be near.
    pub fn rescale(&mut self, slopes: Slopes<T>) {
        self.rows = RowSlopes::new(self.rows.dae, self.rows.holonomic, &slopes);
        self.slopes = slopes;
    }

    /// Sets the right side of the next [`solve`](Self::solve) to a weighted sum of residuals.
    pub fn load<'r>(&mut self, residuals: impl Iterator<Item = (T, &'r Residual)>) {
        let Change { a, lambda, w, eta, u, mu } = &mut self.change;
        for (k, (weight, residual)) in residuals.enumerate() {
            let Residual { motion, lambda: rows, w: of_w, eta: of_eta, u: of_u, mu: of_mu, .. } = residual;
            let pairs = [(&mut *a, motion), (&mut *lambda, rows), (w, of_w), (eta, of_eta), (u, of_u), (mu, of_mu)];
            for (sum, values) in pairs {
                let terms = sum.iter_mut().zip(values);
                match k {
                    0 => terms.for_each(|(sum, &value)| *sum = weight * value),
                    _ => terms.for_each(|(sum, &value)| *sum += weight * value),
                }
            }
        }
    }

    /// Solves for the changes of the unknowns, in `change`, which contains the residual on entry. One
    /// back-substitution, and for each shift one of its own matrix (two for complex numbers).
    pub fn solve(&mut self, at: &mut Linearized, structure: &Structure) -> Result<(), StepError> {
        let Iteration { matrix, rows, slopes, change, part, moved: [gw, gu], .. } = self;
        let Change { a, lambda, w, u, eta, mu } = change;
        for (i, row) in lambda.iter_mut().enumerate() {
            *row /= rows.lambda[rows.kind(i)].a[0];
        }
        if !eta.is_empty() {
            for (i, row) in eta.iter_mut().enumerate() {
                *row = rows.eta[rows.kind(i)].map_or(T::ZERO, |slope| (*row - slope.a[0] * lambda[i]) / slope.w[0]);
            }
            gw.copy_from_slice(eta);
            if let Some(solver) = &mut at.shifts {
                T::solve_symmetric(solver, w, eta, part)?;
            }
            subtract(&structure.tangent, &at.tangent.c, slopes.w, w, a);
            subtract(&structure.tangent, &at.tangent.k, slopes.w_q, w, a);
            rows.subtract(&structure.g, &at.l, |slope| slope.w, w, gw, lambda);
        }
        if !mu.is_empty() {
            for (i, row) in mu.iter_mut().enumerate() {
                let moved = |slope: RowSlope<T>| (*row - slope.a[0] * lambda[i] - slope.w[0] * gw[i]) / slope.u[0];
                *row = rows.mu[rows.kind(i)].map_or(T::ZERO, moved);
            }
            gu.copy_from_slice(mu);
            if let Some(solver) = &mut at.shifts {
                T::solve_symmetric(solver, u, mu, part)?;
            }
            subtract(&structure.tangent, &at.tangent.k, slopes.u, u, a);
            rows.subtract(&structure.g, &at.l, |slope| slope.u, u, gu, lambda);
        }
        Ok(matrix.solve(a, lambda)?)
    }
}

impl<T: Number> RowSlopes<T> {
    /// lambda -= (g G x + l L x)/g_a, with G x in `gx`: the effect of a shift x on the rows of lambda.
    fn subtract(
        &self,
        pattern: &Pattern,
        l: &[f64],
        by: impl Fn(&RowSlope<T>) -> [T; 2],
        x: &[T],
        gx: &[T],
        lambda: &mut [T],
    ) {
        let factors = self.lambda.each(|slope| by(&slope).each(|factor| factor / slope.a[0]));
        for (i, gx) in gx.iter().enumerate() {
            lambda[i] -= factors[self.kind(i)][0] * *gx;
        }
        if self.dae.needs_l() && factors.iter().any(|[_, l]| *l != T::ZERO) {
            for (&(i, j), &l) in pattern.entries.iter().zip(l) {
                lambda[i] -= factors[self.kind(i)][1] * x[j] * l;
            }
        }
    }
}

/// out -= factor (K or C) x
fn subtract<T: Number>(pattern: &Pattern, values: &[f64], factor: T, x: &[T], out: &mut [T]) {
    if factor != T::ZERO {
        for (&(i, j), &value) in pattern.entries.iter().zip(values) {
            out[i] -= factor * x[j] * value;
        }
    }
}

impl Iteration<f64> {
    /// Damps raw errors of q (along the directions of v) and v along the stiff directions, in place, by the matrix for
    /// the slopes tau and tau^2:
    ///
    /// ```text
    /// (M + tau C + tau^2 K) e_v + tau G^T e_lambda = M raw_v - tau K raw_x,   e_x = raw_x + tau e_v
    /// 0 = c_0 G e_x + c_1 (L e_x + G e_v) + c_2 (2 L e_v + G (e_v - raw_v)/tau)
    /// ```
    ///
    /// Source: Hairer, Wanner II, (8.20), with the row of lambda. The part of v that phi = 0 alone determines has index
    /// 2, and its error is weighted by the step `h`.
    pub fn damp(
        &mut self,
        at: &Linearized,
        h: f64,
        x: &mut [f64],
        v: &mut [f64],
        dynamics: &Dynamics,
    ) -> Result<(), StepError> {
        let structure = &dynamics.structure;
        let tau = self.slopes.v;
        let row = self.rows.dae.lambda;
        let [free, rows] = &mut self.part;
        let Change { a: top, lambda: bottom, .. } = &mut self.change;
        free.fill(0.0);
        structure.tangent.multiply(&at.tangent.k, x, free);
        free.iter_mut().for_each(|free| *free *= -tau);
        structure.mass.multiply_symmetric(&at.mass, v, free);
        top.copy_from_slice(free);
        bottom.fill(0.0);
        for ((&(i, j), g), l) in structure.g.entries.iter().zip(&at.g).zip(&at.l) {
            bottom[i] += row.acceleration * g * v[j] - tau * (row.position * g + row.velocity * l) * x[j];
        }
        for (i, bottom) in bottom.iter_mut().enumerate() {
            *bottom /= self.rows.lambda[self.rows.kind(i)].a[0];
        }
        self.matrix.solve(top, bottom)?;
        x.iter_mut().zip(&*top).for_each(|(x, v)| *x += tau * v);
        v.copy_from_slice(top);
        if self.rows.dae.velocity_index() == 2 {
            rows.fill(0.0);
            self.matrix.solve(free, rows)?;
            v.iter_mut().zip(free).for_each(|(v, free)| *v = *free + h * (*v - *free));
        }
        Ok(())
    }
}
