//! Right-hand side of the equations of a bundle.

use super::bundle::{Bundle, Pulse, Shape};
use crate::error::Result;
use crate::formulation::{Dynamics, Formulation, StepError};
use crate::linearize::{Changes, Matrix, Variation};
use crate::system::MechanicalSystem;

/// The equations of index 1 for the motion and its members, the variational equations for the columns.
pub struct VariationalField<'a> {
    shape: Shape,
    variation: Variation<'a>,
    /// Equations of the members.
    plain: Dynamics<'a>,
    pulse: Option<Pulse>,
    driven: Vec<f64>,
    pushes: Vec<f64>,
    changes: Changes,
    force: Matrix,
}

impl<'a> VariationalField<'a> {
    /// The equations without the rows `dependent`, which depend on others everywhere.
    pub fn new(system: &'a dyn MechanicalSystem, shape: &Shape, bundle: &Bundle, dependent: &[usize]) -> Result<Self> {
        let start = &bundle.start;
        let zeros = Matrix::zeros(shape.v, shape.columns);
        let mut variation = Variation::new(system, start.t, &start.q, &start.v)?;
        let mut plain = Dynamics::new(system);
        [&mut plain, &mut variation.dynamics].into_iter().for_each(|dynamics| dynamics.drop_rows(dependent));
        Ok(VariationalField {
            shape: *shape,
            variation,
            plain,
            pulse: bundle.pulse,
            driven: bundle.driven.clone(),
            pushes: bundle.pushes.clone(),
            changes: Changes { q: zeros.clone(), v: zeros },
            force: Matrix::zeros(shape.v, system.inputs().len()),
        })
    }

    /// Returns the force of a unit of the pulse at a state; none where it is zero.
    fn push(&mut self, t: f64, q: &[f64], v: &[f64]) -> Option<Vec<f64>> {
        let pulse = self.pulse?;
        let u = pulse.at(t);
        if u == 0.0 {
            return None;
        }
        self.force.fill(0.0);
        self.plain.system.input_forces(t, q, v, &mut self.force, &mut self.plain.scratch);
        Some(self.force.column(pulse.input).iter().map(|f| u * f).collect())
    }

    fn motion(
        &mut self,
        t: f64,
        (q, v): (&[f64], &[f64]),
        qdot: &mut [f64],
        vdot: &mut [f64],
    ) -> Result<(), StepError> {
        if self.shape.columns > 0 {
            self.variation.move_to(t, q, v)?;
        } else {
            self.variation.dynamics.solve(t, q, v, |_, _| 0.0)?;
        }
        self.plain.system.rate(q, v, qdot);
        vdot.copy_from_slice(&self.variation.dynamics.vdot);
        Ok(())
    }

    /// Rates of the columns, at the state of the last `motion`.
    fn columns(
        &mut self,
        push: Option<Vec<f64>>,
        (dq, dv): (&[f64], &[f64]),
        dq_dot: &mut [f64],
        dv_dot: &mut [f64],
    ) -> Result<(), StepError> {
        self.changes.q.copy_from_slice(dq);
        self.changes.v.copy_from_slice(dv);
        let turned = self.variation.bracket_with(&self.changes.q);
        dq_dot.iter_mut().zip(dv.iter().zip(&turned)).for_each(|(rate, (dv, turned))| *rate = dv - turned);
        let (n, moving) = (self.shape.v.max(1), self.plain.system.dimensions().moving());
        dq_dot.chunks_exact_mut(n).for_each(|rates| rates[moving..].fill(0.0));
        let mut force = self.variation.force(&self.changes);
        if let Some(push) = push {
            for (mut column, amplitude) in force.column_iter_mut().zip(&self.driven) {
                column.iter_mut().zip(&push).for_each(|(f, push)| *f += amplitude * push);
            }
        }
        let mut rows = self.variation.rows(&self.changes, [0.0; 2]);
        self.variation.push_all(&mut force, &mut rows)?;
        dv_dot.copy_from_slice(force.as_slice());
        Ok(())
    }

    fn member(
        &mut self,
        t: f64,
        (q, v, amplitude): (&[f64], &[f64], f64),
        qdot: &mut [f64],
        vdot: &mut [f64],
    ) -> Result<(), StepError> {
        let push = if amplitude == 0.0 { None } else { self.push(t, q, v) };
        let plain = &mut self.plain;
        plain.system.rate(q, v, qdot);
        plain.right_sides(t, q, v, |_, _| 0.0);
        if let Some(push) = push {
            plain.vdot.iter_mut().zip(&push).for_each(|(f, push)| *f += amplitude * push);
        }
        plain.factor_truncated()?;
        plain.kkt.solve(&mut plain.vdot, &mut plain.lambda)?;
        vdot.copy_from_slice(&plain.vdot);
        plain.finite()
    }
}

impl Formulation for VariationalField<'_> {
    fn begin_step(&mut self, _: f64, _: &[f64], _: &[f64], carrier: &mut Dynamics) -> Result<(), StepError> {
        self.plain.kkt.rank_reference = carrier.kkt.rank_reference;
        self.variation.dynamics.kkt.rank_reference = carrier.kkt.rank_reference;
        Ok(())
    }

    fn derivative(
        &mut self,
        t: f64,
        q: &[f64],
        v: &[f64],
        carrier: &mut Dynamics,
        qdot: &mut [f64],
        vdot: &mut [f64],
    ) -> Result<(), StepError> {
        let Shape { q: nq, v: nv, columns, members } = self.shape;
        let ([q0, dq, qs], [v0, dv, vs]) = (self.shape.parts(q), self.shape.rates(v));
        let (qdot0, qdot) = qdot.split_at_mut(nq);
        let (vdot0, vdot) = vdot.split_at_mut(nv);
        self.motion(t, (q0, v0), qdot0, vdot0)?;
        let mut rank_indicator = self.variation.dynamics.kkt.rank_indicator();
        let (dq_dot, qdot) = qdot.split_at_mut(nv * columns);
        let (dv_dot, vdot) = vdot.split_at_mut(nv * columns);
        if columns > 0 {
            let push = if self.driven.is_empty() { None } else { self.push(t, q0, v0) };
            self.columns(push, (dq, dv), dq_dot, dv_dot)?;
        }
        for i in 0..members {
            let amplitude = self.pushes.get(i).copied().unwrap_or(0.0);
            let (own_q, own_v) = (i * nq..(i + 1) * nq, i * nv..(i + 1) * nv);
            let state = (&qs[own_q.clone()], &vs[own_v.clone()], amplitude);
            self.member(t, state, &mut qdot[own_q], &mut vdot[own_v])?;
            rank_indicator = rank_indicator.min(self.plain.kkt.rank_indicator());
        }
        carrier.rank_indicator = (!self.variation.dynamics.lambda.is_empty()).then_some(rank_indicator);
        Ok(())
    }
}
