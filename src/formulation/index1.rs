//! Index 1: the constraints differentiated twice, lambda eliminated.

use super::{Dynamics, Entry, Formulation, Halt, Rows};
use crate::error::Result;

/// ```text
/// q' = N v,   [M G^T; G 0] [v'; lambda] = [f; gamma]
/// ```
///
/// The underlying ODE. phi'' = 0 is kept, so an error eps of phi grows like eps (1 + t): use it with a projection.
/// Order in q, v and lambda: that of the integrator. One evaluation, factorization and solution a stage.
pub const ENTRY: Entry = Entry {
    name: "index1",
    about: "phi'' = 0, lambda eliminated; drifts unless projected",
    options: &[],
    rows: Some(Rows::Acceleration),
    make: |_, _| Ok(Box::new(Index1)),
};

pub(super) struct Index1;

impl Formulation for Index1 {
    fn derivative(
        &mut self,
        t: f64,
        q: &[f64],
        v: &[f64],
        dynamics: &mut Dynamics,
        qdot: &mut [f64],
        vdot: &mut [f64],
    ) -> Result<(), Halt> {
        dynamics.solve(t, q, v, |_, _| 0.0)?;
        dynamics.system.rate(q, v, qdot);
        vdot.copy_from_slice(&dynamics.vdot);
        Ok(())
    }
}
