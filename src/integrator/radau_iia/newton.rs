//! The simplified Newton iteration: one saddle-point system for each eigenvalue of A.

use super::collocation::{Collocation, Mode};
use super::stages::{Residual, Stages, Unknowns};
use crate::error::{Error, Result};
use crate::formulation::{Dynamics, Halt, Rows};
use crate::integrator::{From, NO_TANGENT, Problem, Setup};
use crate::math::kkt::{Field, Singular, Unsymmetric};
use crate::system::{Loaded, Need, Tangent};
use faer::c64;
use std::ops::{Div, Mul};

/// M, G, L, K and C at one state.
struct Linearized {
    mass: Vec<f64>,
    g: Vec<f64>,
    l: Vec<f64>,
    tangent: Tangent,
}

/// The matrices of all eigenvalues at one state and step.
pub struct Newton {
    pub rows: Rows,
    at: Linearized,
    real: Block<f64>,
    pairs: Vec<Block<c64>>,
}

impl Newton {
    pub fn new(rows: Rows, most_pairs: usize, setup: &Setup) -> Result<Self> {
        let structure = setup.system.structure();
        let pairs = (0..most_pairs).map(|_| Block::new(setup)).collect::<Result<_>>()?;
        Ok(Newton {
            rows,
            at: Linearized {
                mass: vec![0.0; structure.mass.entries.len()],
                g: vec![0.0; structure.g.entries.len()],
                l: vec![0.0; structure.g.entries.len()],
                tangent: Tangent::new(&structure.tangent),
            },
            real: Block::new(setup)?,
            pairs,
        })
    }

    /// M, G, K and C at the start of a step, whose v' and lambda are given.
    pub fn linearize(&mut self, problem: &mut Problem, from: From, lambda: &[f64]) -> Result<(), Halt> {
        let ((q, v), (_, vdot)) = (problem.split(from.y), problem.split(from.slope));
        let dynamics = &mut problem.dynamics;
        let need = if self.rows == Rows::Position { Need::DYNAMICS } else { Need::DYNAMICS | Need::L };
        dynamics.evaluate(from.t, q, v, need);
        let at = Loaded { t: from.t, q, v, vdot, lambda };
        if !dynamics.system.tangent(at, &mut self.at.tangent, &mut dynamics.scratch) {
            return Err(NO_TANGENT);
        }
        dynamics.statistics.jacobian_evaluations += 1;
        self.at.mass.copy_from_slice(&dynamics.terms.mass);
        self.at.g.copy_from_slice(&dynamics.terms.g);
        self.at.l.copy_from_slice(&dynamics.terms.l);
        self.prepare(problem, from)
    }

    /// Makes `problem` ready to solve for the shift from this state.
    pub fn prepare(&self, problem: &mut Problem, from: From) -> Result<(), Halt> {
        if self.rows != Rows::PositionAndVelocity {
            return Ok(());
        }
        let (q, v) = problem.split(from.y);
        problem.dynamics.evaluate(from.t, q, v, Need::MASS | Need::G);
        problem.dynamics.factor()
    }

    /// Factors for a step `h` of `method`.
    pub fn factor(&mut self, method: &Collocation, h: f64, dynamics: &mut Dynamics) -> Result<(), Singular> {
        let Newton { rows, at, real, pairs } = self;
        real.factor(h * method.real.value, *rows, at, dynamics)?;
        let mut modes = pairs.iter_mut().zip(&method.pairs);
        modes.try_for_each(|(block, mode)| block.factor(mode.value * h, *rows, at, dynamics))
    }

    /// Sets the multipliers that no correction reaches to zero.
    pub fn leave_out(&self, unknowns: &mut Unknowns) {
        unknowns.leave_out(self.real.matrix.left_out());
        self.pairs.iter().for_each(|block| unknowns.leave_out(block.matrix.left_out()));
    }

    /// One correction of all stages by their residuals.
    pub fn correct(
        &mut self,
        method: &Collocation,
        h: f64,
        stages: &mut Stages,
        dynamics: &mut Dynamics,
    ) -> Result<(), Halt> {
        dynamics.statistics.newton_iterations += 1;
        let Newton { rows, at, real, pairs } = self;
        real.correct(&method.real, h, (*rows, at), stages, dynamics)?;
        let mut modes = pairs.iter_mut().zip(&method.pairs);
        modes.try_for_each(|(block, mode)| block.correct(mode, h, (*rows, at), stages, dynamics))
    }

    /// Damps raw errors of x and v along the stiff directions, in place:
    ///
    /// ```text
    /// (M + tau C + tau^2 K) e_v + tau G^T e_lambda = M raw_v - tau K raw_x,   e_x = raw_x + tau e_v
    /// ```
    ///
    /// with tau = h gamma_0 and G e_x = 0, L e_x + G e_v = 0 or 2 L e_v + G (e_v - raw_v) / tau = 0 for rows of positions,
    /// velocities, accelerations. Source: Hairer, Wanner II, (8.20). Where phi = 0 determines v, that part of e_v is of
    /// index 2 and weighted by `h`; the rest is of index 1.
    pub fn filter(
        &mut self,
        (tau, h): (f64, f64),
        x: &mut [f64],
        v: &mut [f64],
        dynamics: &Dynamics,
    ) -> Result<(), Halt> {
        let structure = &dynamics.structure;
        let Block { matrix, top, bottom, part_top: free, part_bottom, .. } = &mut self.real;
        free.fill(0.0);
        structure.tangent.multiply(&self.at.tangent.k, x, free);
        free.iter_mut().for_each(|free| *free *= -tau);
        structure.mass.multiply_symmetric(&self.at.mass, v, free);
        top.copy_from_slice(free);
        bottom.fill(0.0);
        match self.rows {
            Rows::Position => structure.g.multiply(&self.at.g, x, bottom),
            Rows::Velocity | Rows::PositionAndVelocity => structure.g.multiply(&self.at.l, x, bottom),
            Rows::Acceleration => structure.g.multiply(&self.at.g, v, bottom),
        }
        let factor = match self.rows {
            Rows::Position => -1.0 / tau,
            Rows::Velocity | Rows::PositionAndVelocity => -1.0,
            Rows::Acceleration => 1.0,
        };
        bottom.iter_mut().for_each(|row| *row *= factor);
        matrix.solve(top, bottom)?;
        x.iter_mut().zip(&*top).for_each(|(x, v)| *x += tau * v);
        v.copy_from_slice(top);
        if self.rows == Rows::Position {
            part_bottom.fill(0.0);
            matrix.solve(free, part_bottom)?;
            v.iter_mut().zip(free).for_each(|(v, free)| *v = *free + h * (*v - *free));
        }
        Ok(())
    }
}

/// With W the part of a change of (V', lambda) along an eigenvector of A, whose eigenvalue is a:
///
/// ```text
/// [ M + h a C + (h a)^2 K   G^T ] [ W_V' ]   [ f - M V' - G^T lambda ]
/// [ G + b L                 0   ] [ W_l  ] = [ -phi / (h a)^2  or  -phi' / (h a)  or  gamma - G V' ]
/// ```
///
/// with b = 0, h a, 2 h a for rows of positions, velocities, accelerations; of the last, h^2 phi'' d/dq is left out.
/// V changes by h a W_V' and Q by (h a)^2 W_V', by which both are eliminated; the rows are of the size of accelerations
/// whatever h is. Source: Hairer, Wanner II, IV.8, with the second-order structure used.
struct Block<T> {
    matrix: Unsymmetric<T>,
    top: Vec<T>,
    bottom: Vec<T>,
    shift_top: Vec<T>,
    shift_bottom: Vec<T>,
    part_top: Vec<f64>,
    part_bottom: Vec<f64>,
}

/// A real number, or a complex one that stands for itself and its conjugate.
trait Number:
    Field + Mul<Output = Self> + Mul<f64, Output = Self> + Div<Output = Self> + std::ops::Sub<Output = Self>
{
    const PARTS: usize;
    fn part(self, k: usize) -> f64;
    fn set_part(&mut self, part: f64, k: usize);
    /// Sum with its conjugate.
    fn total(self) -> f64;
}

impl Number for f64 {
    const PARTS: usize = 1;
    fn part(self, _: usize) -> f64 {
        self
    }
    fn set_part(&mut self, part: f64, _: usize) {
        *self = part;
    }
    fn total(self) -> f64 {
        self
    }
}

impl Number for c64 {
    const PARTS: usize = 2;
    fn part(self, k: usize) -> f64 {
        if k == 0 { self.re } else { self.im }
    }
    fn set_part(&mut self, part: f64, k: usize) {
        if k == 0 { self.re = part } else { self.im = part }
    }
    fn total(self) -> f64 {
        2.0 * self.re
    }
}

impl<T: Number> Block<T> {
    fn new(setup: &Setup) -> Result<Self> {
        let (n, structure) = (setup.system.dimensions(), setup.system.structure());
        let matrix = Unsymmetric::new(&structure.mass, &structure.tangent, &structure.g)
            .ok_or_else(|| Error::input("there is not enough memory for the matrices of this size"))?;
        let (top, bottom) = (vec![T::ZERO; n.v], vec![T::ZERO; n.lambda]);
        Ok(Block {
            matrix,
            shift_top: top.clone(),
            shift_bottom: bottom.clone(),
            top,
            bottom,
            part_top: vec![0.0; n.v],
            part_bottom: vec![0.0; n.lambda],
        })
    }

    fn factor(&mut self, ha: T, rows: Rows, at: &Linearized, dynamics: &mut Dynamics) -> Result<(), Singular> {
        dynamics.statistics.factorizations += 1;
        let structure = &dynamics.structure;
        self.matrix.hold(&dynamics.held);
        self.matrix.clear();
        self.matrix.add_mass(&structure.mass, &at.mass);
        self.matrix.add(&structure.tangent, &at.tangent.c, ha, false);
        self.matrix.add(&structure.tangent, &at.tangent.k, ha * ha, false);
        match rows {
            Rows::Position => {}
            Rows::Velocity | Rows::PositionAndVelocity => self.matrix.couple(&at.l, ha),
            Rows::Acceleration => self.matrix.couple(&at.l, ha * 2.0),
        }
        self.matrix.factor(&structure.g, &at.g)
    }

    /// The part of all stages along the mode.
    fn project(mode: &Mode<T>, residuals: &[Residual], of: impl Fn(&Residual) -> &[f64], out: &mut [T]) {
        out.fill(T::ZERO);
        for (&left, residual) in mode.left.iter().zip(residuals) {
            out.iter_mut().zip(of(residual)).for_each(|(out, &value)| *out += left * value);
        }
    }

    fn correct(
        &mut self,
        mode: &Mode<T>,
        h: f64,
        (rows, at): (Rows, &Linearized),
        stages: &mut Stages,
        dynamics: &mut Dynamics,
    ) -> Result<(), Halt> {
        let ha = mode.value * h;
        let factor = match rows {
            Rows::Position => T::real(1.0) / (ha * ha),
            Rows::Velocity | Rows::PositionAndVelocity => T::real(1.0) / ha,
            Rows::Acceleration => T::real(1.0),
        };
        Self::project(mode, &stages.residuals, |left| &left.motion, &mut self.top);
        Self::project(mode, &stages.residuals, |left| &left.rows, &mut self.bottom);
        if rows == Rows::PositionAndVelocity {
            self.shift(mode, ha, at, stages, dynamics)?;
        }
        self.bottom.iter_mut().for_each(|row| *row = factor * *row);
        self.matrix.solve(&mut self.top, &mut self.bottom)?;
        spread(mode, &self.top, &mut stages.unknowns.vdot);
        spread(mode, &self.bottom, &mut stages.unknowns.lambda);
        Ok(())
    }

    /// M W_U + G^T W_mu = -M U - G^T mu,  G W_U = -phi / (h a) + phi',  by which Q moves by h a W_U: that goes over to
    /// the right sides of W_V'.
    fn shift(
        &mut self,
        mode: &Mode<T>,
        ha: T,
        at: &Linearized,
        stages: &mut Stages,
        dynamics: &mut Dynamics,
    ) -> Result<(), Halt> {
        Self::project(mode, &stages.residuals, |left| &left.shift, &mut self.shift_top);
        Self::project(mode, &stages.residuals, |left| &left.position, &mut self.shift_bottom);
        self.shift_bottom.iter_mut().zip(&self.bottom).for_each(|(row, phi_dot)| *row = *row / ha - *phi_dot);
        for k in 0..T::PARTS {
            self.part_top.iter_mut().zip(&self.shift_top).for_each(|(part, x)| *part = x.part(k));
            self.part_bottom.iter_mut().zip(&self.shift_bottom).for_each(|(part, x)| *part = x.part(k));
            dynamics.kkt.solve(&mut self.part_top, &mut self.part_bottom)?;
            self.shift_top.iter_mut().zip(&self.part_top).for_each(|(x, &part)| x.set_part(part, k));
            self.shift_bottom.iter_mut().zip(&self.part_bottom).for_each(|(x, &part)| x.set_part(part, k));
        }
        spread(mode, &self.shift_top, &mut stages.unknowns.shift);
        spread(mode, &self.shift_bottom, &mut stages.unknowns.mu);
        let structure = &dynamics.structure;
        for (&(i, j), &k) in structure.tangent.entries.iter().zip(&at.tangent.k) {
            self.top[i] = self.top[i] - ha * self.shift_top[j] * k;
        }
        for (&(i, j), &l) in structure.g.entries.iter().zip(&at.l) {
            self.bottom[i] = self.bottom[i] - ha * self.shift_top[j] * l;
        }
        Ok(())
    }
}

/// Adds a part along a mode, and along its conjugate, to the stages.
fn spread<T: Number>(mode: &Mode<T>, change: &[T], out: &mut [Vec<f64>]) {
    for (&right, out) in mode.right.iter().zip(out) {
        out.iter_mut().zip(change).for_each(|(out, &change)| *out += (right * change).total());
    }
}
