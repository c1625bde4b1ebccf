//! The equations of Udwadia and Kalaba.

use super::dense::Dense;
use super::{Entry, SPARSE};
use crate::error::Error;
use crate::math::kkt::PseudoInverse;
use crate::math::memory::refuse_dense;
use crate::method_spec::OptionDoc;

/// ```text
/// v' = a + M^-1/2 (G M^-1/2)^+ (gamma - G a),   a = M^-1 f
/// ```
///
/// The accelerations nearest to the free ones in the mass metric, after Gauss; lambda is the one of least norm. Source:
/// Udwadia, Kalaba, Proc. R. Soc. Lond. A 439 (1992) 407-410. The same field as index 1, so it drifts as that does: use
/// it with a projection. G may be rank deficient. M may not be singular: a coordinate without mass ends the run.
/// Singular values up to `tolerance` times the largest are dropped, and near a singular position those below 1e-4 of
/// the largest value that the smallest one has had; rows are not scaled first, so units count. Order in q, v, lambda:
/// that of the integrator. Dense Cholesky and singular-value decomposition per stage, n^3/3 + 12 n m^2 operations:
/// meant for small systems.
pub const ENTRY: Entry = Entry {
    name: "udwadia_kalaba",
    about: "v' by the pseudo-inverse of G M^-1/2, dense; drifts as index1 does",
    options: &[OptionDoc {
        name: "tolerance",
        about: "singular values up to this part of the largest count as zero (default 1e-10)",
    }],
    dae: None,
    field: Some(|spec, system| {
        let (structure, tolerance) = (system.structure(), spec.not_negative("tolerance", 1e-10)?);
        let n = system.dimensions();
        refuse_dense("udwadia_kalaba", [n.v, n.v.max(n.lambda)], COPIES).map_err(|error| error.hint(SPARSE))?;
        let inverse = PseudoInverse::new(&structure.mass, &structure.g, tolerance);
        let inverse = inverse.ok_or_else(|| Error::input("udwadia_kalaba: the system is too large for dense matrices"));
        Ok(Box::new(Dense(inverse?)))
    }),
};

/// Number of matrices: M, G and the decomposition with its scratch, for the steps and again for output rows.
const COPIES: f64 = 14.0;
