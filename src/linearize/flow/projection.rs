//! Projection of a bundle after each step.

use super::bundle::{Bundle, FlowSizes, Pulse};
use crate::error::Result;
use crate::formulation::{Dynamics, StepError};
use crate::method_spec::MethodSpec;
use crate::projection::{self, Projection};
use crate::system::{Excitation, MechanicalSystem, Need};

/// Projects the motion and its members onto the constraints, and the columns onto their tangent space there.
pub struct Straightening<'a> {
    shape: FlowSizes,
    /// Of the motion, then of the members, or of all of them.
    closers: Vec<Closer<'a>>,
    /// The pulse with the row that it moves and the amplitude of each column.
    pulse: Option<(Pulse, usize, Vec<f64>)>,
    correction: Vec<f64>,
    rows: Vec<f64>,
}

/// Closes the constraints of a system.
struct Closer<'a> {
    dynamics: Dynamics<'a>,
    manifold: Option<Box<dyn Projection>>,
}

impl<'a> Closer<'a> {
    fn new(system: &'a dyn MechanicalSystem, dependent: &[usize]) -> Result<Self> {
        let mut dynamics = Dynamics::new(system);
        dynamics.drop_rows(dependent);
        Ok(Closer { dynamics, manifold: projection::make(&MethodSpec::named("manifold"), system)? })
    }

    fn close(&mut self, t: f64, q: &mut [f64], v: &mut [f64]) -> Result<(), StepError> {
        self.dynamics.system.normalize(q);
        match &mut self.manifold {
            Some(manifold) => manifold.project(t, q, v, &mut self.dynamics),
            None => Ok(()),
        }
    }
}

impl<'a> Straightening<'a> {
    pub fn new(
        system: &'a dyn MechanicalSystem,
        members: &[&'a dyn MechanicalSystem],
        shape: &FlowSizes,
        bundle: &Bundle,
        dependent: &[usize],
    ) -> Result<Self> {
        let n = system.dimensions();
        let systems = std::iter::once(&system).chain(members);
        let closers = systems.map(|system| Closer::new(*system, dependent)).collect::<Result<_>>()?;
        let pulse = bundle.pulse.and_then(|pulse| match system.facts().excitations().get(pulse.input)? {
            Excitation::Constraint(row) if !bundle.driven.is_empty() => Some((pulse, *row, bundle.driven.clone())),
            _ => None,
        });
        Ok(Straightening { shape: *shape, closers, pulse, correction: vec![0.0; n.v], rows: vec![0.0; n.lambda] })
    }

    /// Removes from each column the part off the constraints at the state (q, v), so that G dq = du and G dv + Gd dq =
    /// du' in the row that a pulse moves, and zero in all others; from the basis, so that G N = 0.
    fn straighten(
        &mut self,
        t: f64,
        q: &[f64],
        v: &[f64],
        dq: &mut [f64],
        dv: &mut [f64],
        basis: &mut [f64],
    ) -> Result<(), StepError> {
        let Straightening { shape, closers, pulse, correction, rows } = self;
        let dynamics = &mut closers[0].dynamics;
        dynamics.evaluate(t, q, v, Need::MASS | Need::CONSTRAINTS | Need::G | Need::L);
        dynamics.factor_truncated()?;
        let columns = dq.chunks_exact_mut(shape.v).zip(dv.chunks_exact_mut(shape.v));
        for (column, (dq, dv)) in columns.enumerate() {
            let Dynamics { structure, terms, kkt, .. } = dynamics;
            let open = |rows: &mut [f64], derivative: usize| {
                rows.fill(0.0);
                if let Some((pulse, row, driven)) = &*pulse {
                    rows[*row] = -driven[column] * pulse.jet(t)[derivative];
                }
            };
            open(rows, 0);
            structure.g.multiply(&terms.g, dq, rows);
            kkt.solve_projection(rows, correction)?;
            dq.iter_mut().zip(correction.iter()).for_each(|(dq, c)| *dq -= c);
            open(rows, 1);
            structure.g.multiply(&terms.g, dv, rows);
            structure.g.multiply(&terms.l, dq, rows);
            kkt.solve_projection(rows, correction)?;
            dv.iter_mut().zip(correction.iter()).for_each(|(dv, c)| *dv -= c);
        }
        for direction in basis.chunks_exact_mut(shape.v) {
            let Dynamics { structure, terms, kkt, .. } = dynamics;
            rows.fill(0.0);
            structure.g.multiply(&terms.g, direction, rows);
            kkt.solve_projection(rows, correction)?;
            direction.iter_mut().zip(correction.iter()).for_each(|(n, c)| *n -= c);
        }
        Ok(())
    }
}

impl Projection for Straightening<'_> {
    fn project(&mut self, t: f64, q: &mut [f64], v: &mut [f64], carrier: &mut Dynamics) -> Result<(), StepError> {
        self.closers.iter_mut().for_each(|closer| closer.dynamics.kkt.rank_reference = carrier.kkt.rank_reference);
        let FlowSizes { q: nq, v: nv, columns, basis, members } = self.shape;
        let (q0, q) = q.split_at_mut(nq);
        let (v0, v) = v.split_at_mut(nv);
        self.closers[0].close(t, q0, v0)?;
        let (dq, q) = q.split_at_mut(nv * columns);
        let (n, qs) = q.split_at_mut(nv * basis);
        let (dv, vs) = v.split_at_mut(nv * columns);
        if columns + basis > 0 {
            self.straighten(t, q0, v0, dq, dv, n)?;
        }
        let last = self.closers.len() - 1;
        (0..members).try_for_each(|i| {
            let q = &mut qs[i * nq..(i + 1) * nq];
            let v = &mut vs[i * nv..(i + 1) * nv];
            self.closers[(i + 1).min(last)].close(t, q, v)
        })
    }
}
