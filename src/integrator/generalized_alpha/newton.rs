//! Newton's method for the end of a step.

use super::super::{From, NO_TANGENT, Problem, collapsed};
use super::motion::Motion;
use crate::formulation::Halt;
use crate::math::kkt::Unsymmetric;
use crate::math::largest;
use crate::system::{Loaded, MechanicalSystem, Need, Tangent};

/// Iterations, and the ratio of two changes from which the matrix is renewed, as far predictions and kinks of forces want.
const MOST: usize = 25;
const SLOW: f64 = 0.3;
/// Relative change of v' that is round-off, and below which it may stop falling; and change of q, beside 1 m or rad or the
/// largest q, below which it may: near rest, and far from the origin, v' is round-off itself.
const ROUND_OFF: f64 = 1e-15;
const SMALL: f64 = 1e-8;
const STILL: f64 = 1e-14;
/// Solves M v'_1 + G^T lambda_1 = f with phi = 0 for v'_1 and lambda_1; with G v + phi_t = 0 too also for the shift of q.
pub(super) struct Newton {
    holds_velocity: bool,
    tangent: Tangent,
    matrix: Unsymmetric<f64>,
    top: Vec<f64>,
    bottom: Vec<f64>,
    shift: Vec<f64>,
}

/// How q_1 and v_1 change with v'_1.
#[derive(Clone, Copy)]
struct Slopes {
    /// beta' h^2
    q: f64,
    /// gamma' h
    v: f64,
}

impl Newton {
    /// None where there is not enough memory.
    pub fn new(system: &dyn MechanicalSystem, holds_velocity: bool) -> Option<Self> {
        let (n, structure) = (system.dimensions(), system.structure());
        Some(Newton {
            holds_velocity,
            tangent: Tangent::new(&structure.tangent),
            matrix: Unsymmetric::new(&structure.mass, &structure.tangent, &structure.g)?,
            top: vec![0.0; n.v],
            bottom: vec![0.0; n.lambda],
            shift: vec![0.0; n.v],
        })
    }

    /// Leaves q_1 and v_1 in `to`, and v'_1 and lambda_1 at the end of `motion`.
    pub fn converge(
        &mut self,
        problem: &mut Problem,
        motion: &mut Motion,
        from: From,
        h: f64,
        to: &mut [f64],
    ) -> Result<(), Halt> {
        let t = from.t + h;
        let slope = motion.scheme.slope();
        let slopes = Slopes { q: h * h * motion.scheme.beta * slope, v: h * motion.scheme.gamma * slope };
        let (mut last, mut is_slow) = (f64::INFINITY, true);
        for iteration in 0..MOST {
            motion.advance(problem, from, h, to);
            let (q, v) = problem.split(to);
            problem.dynamics.evaluate(t, q, v, Need::DYNAMICS);
            if is_slow {
                self.factor(problem, motion, (from, h), slopes, to)?;
            }
            let change = self.iterate(problem, motion, slopes)?;
            if !change.is_finite() {
                return Err(Halt::NotFinite);
            }
            let still = STILL * largest(problem.split(to).0).max(1.0);
            let small = (SMALL * size(problem, motion, h, to)).max(still / slopes.q);
            let ratio = if iteration == 0 { 1.0 } else { change / last };
            // The next iteration would change that by the ratio.
            if change * ratio.min(1.0) <= ROUND_OFF / SMALL * small || change < small && ratio > 0.5 {
                motion.advance(problem, from, h, to);
                return Ok(());
            }
            is_slow = iteration > 0 && ratio > SLOW && change > small;
            last = change;
        }
        Err(Halt::NotConverged)
    }

    /// [A G^T; G 0] at the predicted state, whose terms are there.
    fn factor(
        &mut self,
        problem: &mut Problem,
        motion: &Motion,
        (from, h): (From, f64),
        slopes: Slopes,
        to: &[f64],
    ) -> Result<(), Halt> {
        let (q, v) = problem.split(to);
        let dynamics = &mut problem.dynamics;
        let at = Loaded { t: from.t + h, q, v, vdot: &motion.end.vdot, lambda: &motion.end.lambda };
        if !dynamics.system.tangent(at, &mut self.tangent, &mut dynamics.scratch) {
            return Err(NO_TANGENT);
        }
        dynamics.statistics.jacobian_evaluations += 1;
        dynamics.statistics.factorizations += 1;
        let (structure, terms) = (&dynamics.structure, &dynamics.terms);
        self.matrix.hold(&dynamics.held);
        self.matrix.clear();
        self.matrix.add_mass(&structure.mass, &terms.mass);
        self.matrix.add(&structure.tangent, &self.tangent.c, slopes.v, false);
        self.matrix.add(&structure.tangent, &self.tangent.k, slopes.q, false);
        self.matrix.factor(&structure.g, &terms.g).map_err(|singular| collapsed(singular, problem, from, h))
    }

    /// One iteration from the terms at q_1, v_1; the largest change of v'_1, or of the shift as such.
    fn iterate(&mut self, problem: &mut Problem, motion: &mut Motion, slopes: Slopes) -> Result<f64, Halt> {
        let dynamics = &mut problem.dynamics;
        dynamics.statistics.newton_iterations += 1;
        let (terms, structure) = (&dynamics.terms, &dynamics.structure);
        // top = f - M v' - G^T lambda
        self.top.fill(0.0);
        structure.mass.multiply_symmetric(&terms.mass, &motion.end.vdot, &mut self.top);
        structure.g.multiply_transposed(&terms.g, &motion.end.lambda, &mut self.top);
        self.top.iter_mut().zip(&terms.f).for_each(|(top, f)| *top = f - *top);
        let (rows, slope) = match self.holds_velocity {
            true => (&terms.phi_dot, slopes.v),
            false => (&terms.phi, slopes.q),
        };
        let mut moved = 0.0;
        if self.holds_velocity {
            self.move_q(&terms.phi, &terms.phi_dot, slopes)?;
            // Forces change with the shift: K times it.
            self.bottom.fill(0.0);
            let shift = &mut self.shift;
            motion.shift.iter_mut().zip(&*shift).for_each(|(sum, shift)| *sum += shift);
            moved = largest(shift) / slopes.q;
            shift.iter_mut().for_each(|shift| *shift = -*shift);
            structure.tangent.multiply(&self.tangent.k, shift, &mut self.top);
        }
        self.bottom.iter_mut().zip(rows).for_each(|(row, residual)| *row = -residual / slope);
        self.matrix.solve(&mut self.top, &mut self.bottom)?;
        motion.end.vdot.iter_mut().zip(&self.top).for_each(|(vdot, change)| *vdot += change);
        motion.end.lambda.iter_mut().zip(&self.bottom).for_each(|(lambda, change)| *lambda += change);
        Ok(largest(&self.top).max(moved))
    }

    /// The shift that is missing: v'_1 meets the rows of G v + phi_t, which moves q, and the shift meets what then is left
    /// of phi.
    fn move_q(&mut self, phi: &[f64], phi_dot: &[f64], slopes: Slopes) -> Result<(), Halt> {
        self.shift.fill(0.0);
        for (row, (phi, phi_dot)) in self.bottom.iter_mut().zip(phi.iter().zip(phi_dot)) {
            *row = slopes.q / slopes.v * phi_dot - phi;
        }
        Ok(self.matrix.solve(&mut self.shift, &mut self.bottom)?)
    }
}

/// What changes of v'_1 are measured against: the largest a_1 and v_1/h.
fn size(problem: &Problem, motion: &Motion, h: f64, to: &[f64]) -> f64 {
    let (_, v) = problem.split(to);
    largest(&motion.end.a).max(largest(v) / h)
}
