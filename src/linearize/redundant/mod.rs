//! Redundant coordinates (RCS): descriptor forms E x' = A x of the constrained equations.

mod pencil;
mod rounding;

use super::entry::{LinearMatrices, LinearizationMethod};
use crate::error::{Error, Result};
use crate::formulation::{self, Dae};
use crate::method_spec::{MethodSpec, OptionDoc};

/// The pencil (E, A) of the equations with multipliers, in all coordinates, its state frozen:
///
/// ```text
/// dq' = dv - [v, dq]                    GGL: - M^-1 G^T dmu
/// M dv' = -K dq - C dv - G^T dlambda
/// index 3: G dq = 0                     2 (n - m) finite eigenvalues, 3 m infinite
/// index 2: Gd dq + G dv = 0             2 (n - m), m zeros, 2 m infinite
/// index 1: G dv' = -Gdd dq - G1 dv      2 (n - m), 2 m zeros, m infinite
/// GGL:     rows of index 3 and 2        2 (n - m), 4 m infinite
/// ```
///
/// (counts at an equilibrium). Exact there. At a moving state the frozen pencil of index 3 has the spectrum of the
/// plain projection (`frozen`), those of index 2 and 1 others: they belong to no chart. Rows of G that depend on others
/// are dropped first, since they make the pencil singular: their multipliers stay as they are. Source: Masarati,
/// "Direct eigenanalysis of constrained system dynamics", Proc. Inst. Mech. Eng. K 223 (2009) 335-342.
pub const RCS: LinearizationMethod = LinearizationMethod {
    name: "rcs",
    options: &[
        OptionDoc {
            name: "form",
            about: "a formulation with multipliers: index3, index2, index1, ggl, baumgarte (default index3)",
        },
        OptionDoc {
            name: "solver",
            about: "null_space: deflation by null spaces; gsvd: deflation by generalized singular values; qz: generalized \
                    Schur form of the whole pencil (default null_space)",
        },
    ],
    build: |variation, request| {
        request.method.one_of("solver", &["null_space", "gsvd", "qz"])?;
        pencil::build(&dae(&request.method)?, variation)
    },
};

/// Returns the equations of the formulation that the option `form` names, index 3 by default.
fn dae(method: &MethodSpec) -> Result<Dae> {
    let others = formulation::registry().iter().filter(|entry| entry.dae.is_some()).map(|entry| entry.name);
    let known: Vec<&str> = std::iter::once("index3").chain(others.filter(|name| *name != "index3")).collect();
    let form = MethodSpec::named(method.one_of("form", &known)?);
    formulation::dae(&form)?.ok_or_else(|| Error::input(format!("{form} has no rows")))
}
