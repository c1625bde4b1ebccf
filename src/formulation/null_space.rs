//! The equations on the null space of G.

use super::Entry;
use super::dense::Dense;
use crate::error::Error;
use crate::math::kkt::Reduced;

/// ```text
/// v' = Y y + Z z,   G Z = 0,   G Y y = gamma,   Z^T M Z z = Z^T (f - M Y y),   Y^T G^T lambda = Y^T (f - M v')
/// ```
///
/// with [Y Z] from a pivoted QR of G^T at every state. Source: Kim, Vanderploeg, J. Mech. Transm. Autom. Des. 108
/// (1986) 176-182. The same field as index 1 without the saddle-point matrix, so it drifts as that does: use it with a
/// projection. All n velocities are integrated; minimal coordinates along Z, with a change of basis now and then, would
/// be another formulation. G may be rank deficient: lambda is then the one of least norm. Order in q, v, lambda: that of
/// the integrator. Dense, about 3 n m^2 + 4 n^2 (n - m) operations a stage: meant for small systems.
pub const ENTRY: Entry = Entry {
    name: "null_space",
    about: "Z^T M Z z = Z^T (f - M Y y) with G Z = 0, dense; drifts as index1 does",
    options: &[],
    rows: None,
    make: |_, system| {
        let structure = system.structure();
        let reduced = Reduced::new(&structure.mass, &structure.g);
        Ok(Box::new(Dense(reduced.ok_or_else(|| Error::input("null_space: M and G do not fit each other"))?)))
    },
};
