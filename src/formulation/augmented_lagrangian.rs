//! Index-1 augmented Lagrangian.

use super::FormulationEntry;
use super::penalty::{OMEGA, PENALTY, Penalty, XI};
use crate::method_spec::OptionDoc;

/// ```text
/// (M + G^T a G) v'_{i+1} = M v'_i + G^T a c,   M v'_0 = f,   lambda_{i+1} = lambda_i + a (G v'_{i+1} - c)
/// ```
///
/// with a and c of `penalty`, which is the first iteration. Source: Bayo, Garcia de Jalon, Serna, Comput. Methods Appl.
/// Mech. Eng. 71 (1988) 183-195. After N iterations v' and lambda differ from `baumgarte:alpha=xi omega,beta=omega` by
/// O(penalty^-N). G may be rank deficient, by redundant rows or at a singular position; what the redundant rows
/// contradict each other by is multiplied by N a in lambda. Order in q, v, lambda: that of the integrator, down to that
/// difference. Cost of index 1 and N back-substitutions: one factorization serves all. The rank of G is not reported.
pub const ENTRY: FormulationEntry = FormulationEntry {
    name: "augmented_lagrangian",
    about: "penalty with updates of lambda: error O(penalty^-iterations), redundant and singular G allowed",
    options: &[
        PENALTY,
        OptionDoc { name: "iterations", about: "solutions with an updated lambda (default 3)" },
        OMEGA,
        XI,
    ],
    dae: None,
    field: Some(|spec, system| Ok(Box::new(Penalty::new(spec.whole("iterations", 3, 1..=100)?, spec, system)?))),
};
