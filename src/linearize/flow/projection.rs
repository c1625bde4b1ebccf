//! Projection of a bundle after each step.

use super::bundle::Shape;
use crate::error::Result;
use crate::formulation::{Dynamics, StepError};
use crate::method_spec::MethodSpec;
use crate::projection::{self, Projection};
use crate::system::{MechanicalSystem, Need};

/// Projects the motion and its members onto the constraints, and the columns onto their tangent space there.
pub struct Straightening<'a> {
    shape: Shape,
    dynamics: Dynamics<'a>,
    manifold: Option<Box<dyn Projection>>,
    correction: Vec<f64>,
    rows: Vec<f64>,
}

impl<'a> Straightening<'a> {
    pub fn new(system: &'a dyn MechanicalSystem, shape: &Shape, dependent: &[usize]) -> Result<Self> {
        let (n, mut dynamics) = (system.dimensions(), Dynamics::new(system));
        dynamics.drop_rows(dependent);
        let manifold = projection::make(&MethodSpec::named("manifold"), system)?;
        Ok(Straightening { shape: *shape, dynamics, manifold, correction: vec![0.0; n.v], rows: vec![0.0; n.lambda] })
    }

    fn close(&mut self, t: f64, q: &mut [f64], v: &mut [f64]) -> Result<(), StepError> {
        self.dynamics.system.normalize(q);
        match &mut self.manifold {
            Some(manifold) => manifold.project(t, q, v, &mut self.dynamics),
            None => Ok(()),
        }
    }

    /// Removes from each column the part off the constraints at the state (q, v), so that G dq = 0 and G dv + Gd dq =
    /// 0.
    fn straighten(
        &mut self,
        t: f64,
        (q, v): (&[f64], &[f64]),
        dq: &mut [f64],
        dv: &mut [f64],
    ) -> Result<(), StepError> {
        let Straightening { shape, dynamics, correction, rows, .. } = self;
        dynamics.evaluate(t, q, v, Need::MASS | Need::CONSTRAINTS | Need::G | Need::L);
        dynamics.factor_truncated()?;
        for (dq, dv) in dq.chunks_exact_mut(shape.v).zip(dv.chunks_exact_mut(shape.v)) {
            let Dynamics { structure, terms, kkt, .. } = dynamics;
            rows.fill(0.0);
            structure.g.multiply(&terms.g, dq, rows);
            kkt.solve_projection(rows, correction)?;
            dq.iter_mut().zip(correction.iter()).for_each(|(dq, c)| *dq -= c);
            rows.fill(0.0);
            structure.g.multiply(&terms.g, dv, rows);
            structure.g.multiply(&terms.l, dq, rows);
            kkt.solve_projection(rows, correction)?;
            dv.iter_mut().zip(correction.iter()).for_each(|(dv, c)| *dv -= c);
        }
        Ok(())
    }
}

impl Projection for Straightening<'_> {
    fn project(&mut self, t: f64, q: &mut [f64], v: &mut [f64], carrier: &mut Dynamics) -> Result<(), StepError> {
        self.dynamics.kkt.rank_reference = carrier.kkt.rank_reference;
        let Shape { q: nq, v: nv, columns, members } = self.shape;
        let (q0, q) = q.split_at_mut(nq);
        let (v0, v) = v.split_at_mut(nv);
        self.close(t, q0, v0)?;
        let (dq, qs) = q.split_at_mut(nv * columns);
        let (dv, vs) = v.split_at_mut(nv * columns);
        if columns > 0 {
            self.straighten(t, (q0, v0), dq, dv)?;
        }
        (0..members).try_for_each(|i| self.close(t, &mut qs[i * nq..(i + 1) * nq], &mut vs[i * nv..(i + 1) * nv]))
    }
}
