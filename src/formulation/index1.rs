//! Index 1: the constraints differentiated twice, lambda eliminated.

use super::{Dae, DaeRow, Dynamics, Formulation, FormulationEntry, StepError};
use crate::error::Result;
use crate::method_spec::{MethodSpec, OptionDoc};
use crate::tolerances::TRUNCATED_RANK;

/// ```text
/// q' = N v,   [M G^T; G 0] [v'; lambda] = [f; gamma]
/// ```
///
/// The underlying ODE. It preserves phi'' = 0 only, so an error eps of phi grows like eps (1 + t): use it with a
/// projection. Order in q, v and lambda: that of the integrator. One evaluation, factorization and solution per stage.
pub const ENTRY: FormulationEntry = FormulationEntry {
    name: "index1",
    about: "phi'' = 0, lambda eliminated; drifts unless projected",
    options: &[RANK],
    dae: Some(|_| Ok(Dae::with(DaeRow::ACCELERATION))),
    field: Some(|spec, _| Ok(Box::new(Index1 { row: DaeRow::ACCELERATION, rank_tolerance: rank_tolerance(spec)? }))),
};

/// Option of the rank indicator below which constraints are dropped as dependent when v' and lambda are solved for.
pub(super) const RANK: OptionDoc = OptionDoc {
    name: "rank_tolerance",
    about: "part of the reference value of the rank indicator below which constraints count as dependent (default 1e-4; 0 for the plain equations)",
};

pub(super) fn rank_tolerance(spec: &MethodSpec) -> Result<f64> {
    spec.not_negative(RANK.name, TRUNCATED_RANK)
}

/// The vector field of a row of phi'', with or without feedback of phi and phi'.
pub(super) struct Index1 {
    pub row: DaeRow,
    pub rank_tolerance: f64,
}

impl Default for Index1 {
    fn default() -> Self {
        Index1 { row: DaeRow::ACCELERATION, rank_tolerance: TRUNCATED_RANK }
    }
}

impl Formulation for Index1 {
    fn derivative(
        &mut self,
        t: f64,
        q: &[f64],
        v: &[f64],
        dynamics: &mut Dynamics,
        qdot: &mut [f64],
        vdot: &mut [f64],
    ) -> Result<(), StepError> {
        dynamics.rank_tolerance = self.rank_tolerance;
        let DaeRow { position, velocity, .. } = self.row;
        dynamics.solve(t, q, v, |phi, phi_dot| -velocity * phi_dot - position * phi)?;
        dynamics.system.rate(q, v, qdot);
        vdot.copy_from_slice(&dynamics.vdot);
        Ok(())
    }
}
