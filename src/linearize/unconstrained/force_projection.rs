//! Force projection, linearized.

use super::{PROJECTED, build};
use crate::error::{Error, Result};
use crate::linearize::entry::LinearizationMethod;
use crate::linearize::{Matrix, Perturbation, Response, Variation};
use crate::method_spec::OptionDoc;

/// With P = I - G^+ G, which projects forces on the directions that are free,
///
/// ```text
/// (P M + mu G^+ G) dv' = -P [K dq + C dv] - mu G^+ [(Gdd + c1 Gd + c0 G) dq + (G1 + c1 G) dv],   c1 = 2 alpha, c0 = beta^2
/// ```
///
/// the underlying ODE of Baumgarte's equations with a mass matrix that is well conditioned, also with redundant rows.
/// mu is the mean of diag(M). Without gains the spurious eigenvalues are 2 m zeros. Source: Masarati, Proc. Inst. Mech.
/// Eng. K 225 (2011) 12-33. Cost: a QR of G^T, an LU of size n and the eigenvalues of a 2 n matrix.
pub const FORCE_PROJECTION: LinearizationMethod = LinearizationMethod {
    name: "force_projection",
    options: &[
        OptionDoc { name: "alpha", about: "damping of phi, 1/s (default 0)" },
        OptionDoc { name: "beta", about: "frequency of phi, 1/s (default alpha)" },
        PROJECTED,
    ],
    build: |variation, request| {
        let alpha = request.method.not_negative("alpha", 0.0)?;
        let beta = request.method.not_negative("beta", alpha)?;
        let held = [2.0 * alpha, beta * beta];
        build(variation, request, |variation, perturbation| response(variation, perturbation, held))
    },
};

fn response(variation: &mut Variation, perturbation: &Perturbation, held: [f64; 2]) -> Result<Response> {
    let mass = variation.mass();
    let all = variation.g();
    // Close to the constraints, at a distance of 1e-9 say, dependent rows are not exactly dependent: they would raise
    // the rank.
    let kept = variation.independent_rows();
    let g = all.select_rows(&kept);
    let rows = perturbation.rows(variation, held).select_rows(&kept);
    // G^T = Q R: G^+ G = Q Q^T and G^+ = Q R^-T.
    let (q, r) = g.transpose().qr().unpack();
    let along = &q * q.transpose();
    let project = Matrix::identity(g.ncols(), g.ncols()) - &along;
    let mu = mass.trace() / (g.ncols().max(1) as f64);
    let lu = (&project * &mass + along * mu).lu();
    let error =
        || Error::input("the motion is not determined: a free direction has no mass").hint("give the body mass");
    let force = perturbation.force(variation);
    let held = &q * solve_transposed(&r, &rows)?;
    let vdot = lu.solve(&(&project * &force + held * mu)).ok_or_else(error)?;
    // Multipliers of least norm, over all rows: G Q = Q_2 R_2, lambda = Q_2 R_2^-T Q^T (f - M v').
    let (basis, r) = (all * &q).qr().unpack();
    let lambda = basis * solve_transposed(&r, &(q.transpose() * (force - mass * &vdot)))?;
    Ok(Response { lambda, vdot })
}

/// R^-T x.
fn solve_transposed(r: &Matrix, x: &Matrix) -> Result<Matrix> {
    r.transpose().solve_lower_triangular(x).ok_or_else(|| Error::input("the constraints depend on each other"))
}
