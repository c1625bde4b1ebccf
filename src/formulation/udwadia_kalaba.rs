//! The equations of Udwadia and Kalaba.

use super::dense::Dense;
use super::{FormulationEntry, SPARSE};
use crate::error::Error;
use crate::math::kkt::Reduced;
use crate::math::memory::refuse_dense;
use crate::method_spec::OptionDoc;

/// ```text
/// v' = a + M^-1/2 (G M^-1/2)^+ (gamma - G a),   a = M^-1 f
/// ```
///
/// The accelerations nearest to the free ones in the mass metric, after Gauss; lambda is the one of least norm. Source:
/// Udwadia, Kalaba, Proc. R. Soc. Lond. A 439 (1992) 407-410. The same field as index 1, so it drifts as that does: use
/// it with a projection.
///
/// The pseudo-inverse is not formed: (G M^-1/2)^+ b is the shortest of all x with G M^-1/2 x = b, so v' that with the
/// least Gaussian constraint, which a pivoted QR of G^T gives in the directions that G determines and those that it
/// leaves. So G may be rank deficient, and M singular along directions that G prevents (Udwadia, Phohomsiri, Proc. R.
/// Soc. A 462 (2006) 2097-2117). Pivots up to `tolerance` times the largest, of rows of unit length, are dropped, and
/// near a singular position those below 1e-4 of the largest value that the smallest one has had. Order in q, v, lambda:
/// that of the integrator. Dense, 3 n m^2 + 4 n^2 (n - m) operations per stage: meant for small systems.
pub const ENTRY: FormulationEntry = FormulationEntry {
    name: "udwadia_kalaba",
    about: "v' by the pseudo-inverse of G M^-1/2, dense; drifts as index1 does",
    options: &[OptionDoc {
        name: "tolerance",
        about: "pivots of G M^-1/2 up to this part of the largest count as zero (default 1e-10)",
    }],
    dae: None,
    field: Some(|spec, system| {
        let structure = system.structure();
        let tolerance = spec.not_negative("tolerance", 1e-10)?;
        let n = system.dimensions();
        refuse_dense("udwadia_kalaba", n.v, n.v.max(n.lambda), COPIES).map_err(|error| error.hint(SPARSE))?;
        let solver = Reduced::new(&structure.mass, &structure.g, tolerance);
        Ok(Box::new(Dense(solver.ok_or_else(|| Error::input("udwadia_kalaba: M and G do not fit each other"))?)))
    }),
};

/// Number of matrices: G^T and Z^T M Z, for the steps and again for output rows.
const COPIES: f64 = 4.0;
