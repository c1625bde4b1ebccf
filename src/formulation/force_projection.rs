//! Force projection.

use super::invariant_manifold::InvariantManifold;
use super::{FormulationEntry, Stabilizer, StabilizingField};
use crate::method_spec::OptionDoc;

/// ```text
/// q' = N (v - p M^-1 G^T (G M^-1 G^T)^-1 phi)
/// M v' = P f + G^T (G M^-1 G^T)^-1 (gamma - r (G v + phi_t)),   P = I - G^T (G M^-1 G^T)^-1 G M^-1
/// ```
///
/// The forces are projected on the motions that the constraints allow, and the state is pulled back on both levels:
/// with y = G v + phi_t, phi' = y - p phi and y' = -r y - p L d, where L = dy/dq and d, the correction of phi, is of
/// the order of phi. The same field as `invariant_manifold` with F = S-both, with a rate for each level. Source:
/// Masarati, Proc. Inst. Mech. Eng. K 225 (2011) 12-33. Order in q, v, lambda: that of the integrator; an explicit one
/// needs p h and r h of order one. lambda is that of index 1. Cost: that of index 1 and two back-substitutions per
/// stage.
pub const ENTRY: FormulationEntry = FormulationEntry {
    name: "force_projection",
    about: "forces projected by P, phi and phi' pulled back at rates of their own",
    options: &[
        OptionDoc { name: "position", about: "rate p at which phi decays, 1/s (default 10)" },
        OptionDoc { name: "velocity", about: "rate r at which phi' decays, 1/s (default position)" },
    ],
    dae: None,
    field: Some(|spec, system| {
        let position = spec.not_negative("position", 10.0)?;
        let gains = [position, spec.not_negative("velocity", position)?];
        Ok(Box::new(InvariantManifold::new(gains, Stabilizer::new(StabilizingField::Both, system), system)))
    }),
};
