//! The problem of an integrator: a formulation of a system, as y' = F(t, y).

use crate::formulation::{Dynamics, Formulation, StepError};
use crate::math::all_finite;
use crate::system::Dimensions;

/// y = (q, v, w) with w the work of forces without a potential and of moving constraints, J, which is integrated, too,
/// so that the energy balance has the accuracy of the method, and then that of the forces whose work is watched. States
/// xi are the last of v.
pub struct Problem<'a> {
    /// The equations with their memory.
    pub dynamics: Dynamics<'a>,
    /// The vector field.
    pub formulation: Box<dyn Formulation + 'a>,
    dimensions: Dimensions,
    works: usize,
}

impl<'a> Problem<'a> {
    /// A formulation on its equations.
    pub fn new(dynamics: Dynamics<'a>, formulation: Box<dyn Formulation + 'a>) -> Self {
        Problem { dimensions: dynamics.system.dimensions(), works: dynamics.terms.powers.len(), dynamics, formulation }
    }

    /// Length of y.
    pub fn len(&self) -> usize {
        self.dimensions.q + self.dimensions.v + 1 + self.works
    }

    /// True for a system without velocities.
    pub fn is_empty(&self) -> bool {
        self.dimensions.v == 0
    }

    /// (q, v) of a flat state.
    pub fn split<'y>(&self, y: &'y [f64]) -> (&'y [f64], &'y [f64]) {
        let (q, rest) = y.split_at(self.dimensions.q);
        (q, &rest[..self.dimensions.v])
    }

    /// (q, v) of y, mutable.
    pub fn split_mut<'y>(&self, y: &'y mut [f64]) -> (&'y mut [f64], &'y mut [f64]) {
        let (q, rest) = y.split_at_mut(self.dimensions.q);
        (q, &mut rest[..self.dimensions.v])
    }

    /// y' at (t, y).
    pub fn derivative(&mut self, t: f64, y: &[f64], slope: &mut [f64]) -> Result<(), StepError> {
        if !all_finite(y) {
            return Err(StepError::NotFinite);
        }
        let (q, v) = self.split(y);
        let (qdot, rest) = slope.split_at_mut(self.dimensions.q);
        let (vdot, work) = rest.split_at_mut(self.dimensions.v);
        self.formulation.derivative(t, q, v, &mut self.dynamics, qdot, vdot)?;
        self.write_powers(work);
        Ok(())
    }

    /// y' of the plain equations at another velocity of the state whose matrix is factored.
    pub(super) fn derivative_at_velocity(&mut self, t: f64, y: &[f64], slope: &mut [f64]) -> Result<(), StepError> {
        let (q, v) = self.split(y);
        self.dynamics.solve_at_velocity(t, q, v)?;
        let (qdot, rest) = slope.split_at_mut(q.len());
        let (vdot, work) = rest.split_at_mut(v.len());
        self.dynamics.system.rate(q, v, qdot);
        vdot.copy_from_slice(&self.dynamics.vdot);
        self.write_powers(work);
        Ok(())
    }

    /// The rates of the works at the last solution.
    fn write_powers(&self, work: &mut [f64]) {
        let powers = self.dynamics.powers(&self.dynamics.lambda);
        work.iter_mut().zip(powers).for_each(|(rate, power)| *rate = power);
    }

    /// Announces a step that begins at (t, y).
    pub fn begin_step(&mut self, t: f64, y: &[f64]) -> Result<(), StepError> {
        let (q, v) = self.split(y);
        self.formulation.begin_step(t, q, v, &mut self.dynamics)
    }

    /// Ends a step at (t, y), which becomes a state of the motion.
    pub fn end_step(&mut self, t: f64, y: &mut [f64]) -> Result<(), StepError> {
        let (q, rest) = y.split_at_mut(self.dimensions.q);
        self.formulation.end_step(t, q, &mut rest[..self.dimensions.v], &mut self.dynamics)
    }
}
