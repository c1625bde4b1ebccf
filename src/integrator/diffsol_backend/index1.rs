//! Index 1 for implicit integrators: lambda eliminated.

use super::super::{From, Problem, Setup};
use super::form::{Dense, Form};
use super::kinematics::Kinematics;
use crate::error::Result;
use crate::formulation::{self, Dynamics, Halt, Statistics};
use crate::integrator::NO_TANGENT;
use crate::system::{Loaded, Need, Tangent};

/// ```text
/// q' = N v,   [M G^T; G 0] [v'; lambda] = [f; gamma],   w' = power
/// [M G^T; G 0] [dv'; dlambda] = [-K dq - C dv; -2 L dv]
/// ```
///
/// The second line is the Jacobian, which leaves out how phi'' changes with q: no stiffness comes from there, so that
/// Newton's method hardly slows down.
pub struct Index1<'s> {
    problem: Problem<'s>,
    tangent: Tangent,
    kinematics: Kinematics,
    slope: Vec<f64>,
    /// Right sides, and then (dv', dlambda), for each direction of q and then of v.
    columns: Vec<f64>,
}

impl<'s> Index1<'s> {
    pub fn new(setup: &Setup<'_, 's>) -> Result<Self> {
        let (system, n) = (setup.system, setup.system.dimensions());
        let formulation = formulation::make(setup.formulation, system)?;
        Ok(Index1 {
            problem: Problem::new(Dynamics::new(system), formulation),
            tangent: Tangent::new(&system.structure().tangent),
            kinematics: Kinematics::new(system),
            slope: vec![0.0; setup.len()],
            columns: vec![0.0; 2 * n.v * (n.v + n.lambda)],
        })
    }

    /// The right sides at the state of the last evaluation.
    fn right_sides(&mut self, t: f64, x: &[f64]) -> Result<(), Halt> {
        let (q, v) = self.problem.split(x);
        let dynamics = &mut self.problem.dynamics;
        let at = Loaded { t, q, v, vdot: &dynamics.vdot, lambda: &dynamics.lambda };
        if !dynamics.system.tangent(at, &mut self.tangent, &mut dynamics.scratch) {
            return Err(NO_TANGENT);
        }
        dynamics.evaluate(t, q, v, Need::L);
        let (n, height, structure) = (v.len(), v.len() + dynamics.lambda.len(), &dynamics.structure);
        self.columns.fill(0.0);
        for (at, &(i, j)) in structure.tangent.entries.iter().enumerate() {
            self.columns[j * height + i] -= self.tangent.k[at];
            self.columns[(n + j) * height + i] -= self.tangent.c[at];
        }
        for (&(i, j), l) in structure.g.entries.iter().zip(&dynamics.terms.l) {
            self.columns[(n + j) * height + n + i] -= 2.0 * l;
        }
        Ok(())
    }
}

impl Form for Index1<'_> {
    fn len(&self) -> usize {
        self.slope.len()
    }

    fn start(&mut self, from: From, x: &mut [f64], rate: &mut [f64]) -> Result<(), Halt> {
        x.copy_from_slice(from.y);
        rate.copy_from_slice(from.slope);
        Ok(())
    }

    fn evaluate(&mut self, t: f64, x: &[f64], out: &mut [f64]) -> Result<(), Halt> {
        self.problem.derivative(t, x, out)
    }

    fn jacobian(&mut self, t: f64, x: &[f64], out: &mut Dense) -> Result<(), Halt> {
        self.problem.derivative(t, x, &mut self.slope)?;
        self.right_sides(t, x)?;
        let (q, v) = self.problem.split(x);
        let dynamics = &mut self.problem.dynamics;
        dynamics.statistics.jacobian_evaluations += 1;
        self.kinematics.update(dynamics.system, q);
        self.kinematics.by_q(dynamics.system, q, v, out);
        self.kinematics.by_v((0, q.len()), out);
        let (n, height) = (v.len(), v.len() + dynamics.lambda.len());
        for (j, column) in self.columns.chunks_exact_mut(height.max(1)).enumerate() {
            let (vdot, lambda) = column.split_at_mut(n);
            dynamics.kkt.solve(vdot, lambda)?;
            for (i, &vdot) in vdot.iter().enumerate() {
                match j < n {
                    true => self.kinematics.add_along(q.len() + i, j, vdot, out),
                    false => out.add(q.len() + i, q.len() + j - n, vdot),
                }
            }
        }
        Ok(())
    }

    fn follow(&mut self, run: &Dynamics) {
        self.problem.dynamics.follow(run);
    }

    fn statistics(&mut self) -> &mut Statistics {
        &mut self.problem.dynamics.statistics
    }
}
