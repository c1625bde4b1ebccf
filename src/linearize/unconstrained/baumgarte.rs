//! Baumgarte's equations, linearized.

use super::{PROJECTED, build};
use crate::linearize::Response;
use crate::linearize::entry::LinearizationMethod;
use crate::method_spec::OptionDoc;

/// ```text
/// [M G^T; G 0] [dv'; dlambda] = -[K dq + C dv; (Gdd + c1 Gd + c0 G) dq + (G1 + c1 G) dv],   c1 = 2 alpha, c0 = beta^2
/// ```
///
/// Exact on the changes that the constraints allow. At an equilibrium the spurious eigenvalues are the roots of
/// s^2 + c1 s + c0, each m times; elsewhere they differ, and mix with the physical ones: use `projected=yes` there.
/// Cost: 2 n back-substitutions and the eigenvalues of a 2 n matrix.
pub const BAUMGARTE: LinearizationMethod = LinearizationMethod {
    name: "baumgarte",
    options: &[
        OptionDoc { name: "alpha", about: "damping of phi, 1/s (default 5)" },
        OptionDoc { name: "beta", about: "frequency of phi, 1/s (default alpha)" },
        PROJECTED,
    ],
    build: |variation, request| {
        let alpha = request.method.not_negative("alpha", 5.0)?;
        let beta = request.method.not_negative("beta", alpha)?;
        let held = [2.0 * alpha, beta * beta];
        build(variation, request, |variation, perturbation| Response::held(variation, perturbation, held))
    },
};
