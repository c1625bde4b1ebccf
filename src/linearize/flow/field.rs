//! Right-hand side of the equations of a bundle.

use super::bundle::{Bundle, FlowSizes, Pulse};
use crate::error::Result;
use crate::formulation::{Dynamics, Formulation, StepError};
use crate::linearize::{Changes, Matrix, Variation};
use crate::system::{Excitation, LeviCivita, MechanicalSystem, OperatingPoint};

/// The equations of index 1 for the motion and its members, the variational equations for the columns.
pub struct VariationalField<'a> {
    shape: FlowSizes,
    variation: Variation<'a>,
    /// Equations of the members, or of all of them.
    plain: Vec<Dynamics<'a>>,
    excitations: Vec<Excitation>,
    pulse: Option<Pulse>,
    driven: Vec<f64>,
    changes: Changes,
    force: Matrix,
    /// The connection that transports the basis; none: it moves as little as it can.
    connection: Option<LeviCivita>,
}

impl<'a> VariationalField<'a> {
    /// The equations without the rows `dependent`, which depend on others everywhere. `members` are the systems of the
    /// members, or one for all.
    pub fn new(
        system: &'a dyn MechanicalSystem,
        members: &[&'a dyn MechanicalSystem],
        shape: &FlowSizes,
        bundle: &Bundle,
        dependent: &[usize],
    ) -> Result<Self> {
        let start = &bundle.start;
        let zeros = Matrix::zeros(shape.v, shape.columns);
        let mut variation = Variation::new(system, start.t, &start.q, &start.v)?;
        let mut plain: Vec<Dynamics> = members.iter().map(|member| Dynamics::new(*member)).collect();
        let bundled = plain.iter_mut().chain([&mut variation.dynamics]);
        bundled.for_each(|dynamics| dynamics.drop_rows(dependent));
        variation.dynamics.scratch.pieces.clone_from(&bundle.pieces);
        Ok(VariationalField {
            shape: *shape,
            variation,
            plain,
            excitations: system.facts().excitations(),
            pulse: bundle.pulse,
            driven: bundle.driven.clone(),
            changes: Changes { q: zeros.clone(), v: zeros },
            force: Matrix::zeros(shape.v, system.facts().excitations().len()),
            connection: (shape.basis > 0 && bundle.is_parallel).then(|| LeviCivita::new(shape.v)),
        })
    }

    /// Adds the pulse to the forces and rows of the columns.
    fn push(&mut self, t: f64, q: &[f64], v: &[f64], force: &mut Matrix, rows: &mut Matrix) {
        let Some(pulse) = self.pulse.filter(|_| !self.driven.is_empty()) else { return };
        let [u, rate, second] = pulse.jet(t);
        if u == 0.0 {
            return;
        }
        if let Excitation::Constraint(row) = self.excitations[pulse.input] {
            rows.row_mut(row).iter_mut().zip(&self.driven).for_each(|(row, amplitude)| *row += amplitude * second);
            return;
        }
        let Dynamics { system, scratch, .. } = &mut self.variation.dynamics;
        let mut add = |u: f64, forces: &Matrix| {
            for (mut column, amplitude) in force.column_iter_mut().zip(&self.driven) {
                column.axpy(amplitude * u, &forces.column(pulse.input), 1.0);
            }
        };
        system.input_forces(t, q, v, &mut self.force, scratch);
        add(u, &self.force);
        if self.excitations[pulse.input] == Excitation::Displacement {
            system.input_rate_forces(t, q, v, &mut self.force, scratch);
            add(rate, &self.force);
        }
    }

    fn motion(&mut self, t: f64, q: &[f64], v: &[f64], qdot: &mut [f64], vdot: &mut [f64]) -> Result<(), StepError> {
        if self.shape.columns + self.shape.basis > 0 {
            self.variation.move_to(t, q, v)?;
        } else {
            self.variation.dynamics.solve(t, q, v, |_, _| 0.0)?;
        }
        self.variation.system().rate(q, v, qdot);
        vdot.copy_from_slice(&self.variation.dynamics.vdot);
        Ok(())
    }

    /// Rates of the columns `changes`, at the state of the last `motion`.
    fn columns(
        &mut self,
        t: f64,
        q: &[f64],
        v: &[f64],
        dq_dot: &mut [f64],
        dv_dot: &mut [f64],
    ) -> Result<(), StepError> {
        let turned = self.variation.bracket_with(&self.changes.q);
        dq_dot.iter_mut().zip(self.changes.v.iter().zip(&turned)).for_each(|(rate, (dv, turned))| *rate = dv - turned);
        let n = self.shape.v.max(1);
        let moving = self.variation.system().dimensions().moving();
        dq_dot.chunks_exact_mut(n).for_each(|rates| rates[moving..].fill(0.0));
        let mut force = self.variation.force(&self.changes);
        let mut rows = self.variation.rows(&self.changes, [0.0; 2]);
        self.push(t, q, v, &mut force, &mut rows);
        self.variation.push_all(&mut force, &mut rows)?;
        dv_dot.copy_from_slice(force.as_slice());
        Ok(())
    }

    /// Rates of the basis, at the state of the last `motion`: M N' + G^T l = -W N, G N' = -(Gd N + G [v, N]).
    fn basis(&mut self, t: f64, q: &[f64], v: &[f64], n: &[f64], rate: &mut [f64]) -> Result<(), StepError> {
        let n = Matrix::from_column_slice(self.shape.v, self.shape.basis, n);
        let mut force = Matrix::zeros(n.nrows(), n.ncols());
        if let Some(connection) = &mut self.connection {
            let Dynamics { system, vdot, lambda, scratch, .. } = &mut self.variation.dynamics;
            system.levi_civita(OperatingPoint { t, q, v, vdot, lambda }, connection, scratch);
            force = -(&connection.w * &n);
        }
        let turned = self.variation.bracket_with(&n);
        let mut rows = -(self.variation.gd_times(&n) + self.variation.g_times(&turned));
        self.variation.push_all(&mut force, &mut rows)?;
        rate.copy_from_slice(force.as_slice());
        Ok(())
    }

    /// Rates of member `i`. Returns its rank indicator.
    fn member(
        &mut self,
        i: usize,
        t: f64,
        q: &[f64],
        v: &[f64],
        qdot: &mut [f64],
        vdot: &mut [f64],
    ) -> Result<f64, StepError> {
        let last = self.plain.len() - 1;
        let plain = &mut self.plain[i.min(last)];
        plain.system.rate(q, v, qdot);
        plain.right_sides(t, q, v, |_, _| 0.0);
        plain.factor_truncated()?;
        plain.kkt.solve(&mut plain.vdot, &mut plain.lambda)?;
        vdot.copy_from_slice(&plain.vdot);
        plain.finite()?;
        Ok(plain.kkt.rank_indicator())
    }
}

impl Formulation for VariationalField<'_> {
    fn begin_step(&mut self, _: f64, _: &[f64], _: &[f64], carrier: &mut Dynamics) -> Result<(), StepError> {
        self.plain.iter_mut().for_each(|plain| plain.kkt.rank_reference = carrier.kkt.rank_reference);
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
        let FlowSizes { q: nq, v: nv, columns, basis, members } = self.shape;
        let [q0, dq, n, qs] = self.shape.parts(q);
        let [v0, dv, vs] = self.shape.rates(v);
        let (qdot0, qdot) = qdot.split_at_mut(nq);
        let (vdot0, vdot) = vdot.split_at_mut(nv);
        self.motion(t, q0, v0, qdot0, vdot0)?;
        let mut rank_indicator = self.variation.dynamics.kkt.rank_indicator();
        let (dq_dot, qdot) = qdot.split_at_mut(nv * columns);
        let (n_dot, qdot) = qdot.split_at_mut(nv * basis);
        let (dv_dot, vdot) = vdot.split_at_mut(nv * columns);
        if columns > 0 {
            self.changes.q.copy_from_slice(dq);
            self.changes.v.copy_from_slice(dv);
            self.columns(t, q0, v0, dq_dot, dv_dot)?;
        }
        if basis > 0 {
            self.basis(t, q0, v0, n, n_dot)?;
        }
        for i in 0..members {
            let at_q = i * nq..(i + 1) * nq;
            let at_v = i * nv..(i + 1) * nv;
            let q = &qs[at_q.clone()];
            let v = &vs[at_v.clone()];
            let member_indicator = self.member(i, t, q, v, &mut qdot[at_q], &mut vdot[at_v])?;
            rank_indicator = rank_indicator.min(member_indicator);
        }
        carrier.rank_indicator = (!self.variation.dynamics.lambda.is_empty()).then_some(rank_indicator);
        Ok(())
    }
}
