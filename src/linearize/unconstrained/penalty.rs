//! Penalty methods, with and without updates of the multipliers, linearized.

use super::{PROJECTED, build};
use crate::error::{Error, Result};
use crate::formulation::{self, mean_compliance};
use crate::linearize::entry::LinearizationMethod;
use crate::linearize::variation::at_state;
use crate::linearize::{Matrix, Perturbation, Response, Variation};
use crate::method_spec::{MethodSpec, OptionDoc};
use crate::system::OperatingPoint;

const KIND: OptionDoc = OptionDoc {
    name: "kind",
    about: "inertial: on phi'' + 2 xi omega phi' + omega^2 phi (Bayo); elastic: springs and dampers on phi and phi' alone, \
            about the exact lambda (default inertial)",
};

/// Inertial (Bayo, Garcia de Jalon, Serna 1988), with s = penalty / mean of diag(G M^-1 G^T):
///
/// ```text
/// (M + s G^T G) dv' = -[K dq + C dv] - s G^T [(Gdd + c1 Gd + c0 G) dq + (G1 + c1 G) dv],   c1 = 2 xi omega, c0 = omega^2
/// ```
///
/// with K and Gdd at the v' and lambda = s (phi'' + c1 phi' + c0 phi) of the penalty itself. Elastic, about the exact
/// lambda: M dv' = -[K + s G^T (c0 G + c1 Gd)] dq - [C + s c1 G^T G] dv. Physical eigenvalues are off by O(1/penalty)
/// until rounding, of order penalty eps, takes over. Spurious ones are those of Baumgarte (inertial) or
/// +-i sqrt(s c0 eig(G M^-1 G^T)) (elastic).
pub const PENALTY: LinearizationMethod = LinearizationMethod {
    name: "penalty",
    options: &[formulation::PENALTY, formulation::OMEGA, formulation::XI, KIND, PROJECTED],
    build: |variation, request| {
        let penalty = Penalty::new(&request.method, 1, variation)?;
        match request.method.one_of("kind", &["inertial", "elastic"])? {
            "elastic" if request.method.text("projected").is_some_and(|text| text != "no") => Err(Error::input(
                "penalty: springs push only where a change leaves the constraints, so kind=elastic cannot be projected",
            )
            .hint("take mcs, or kind=inertial")),
            "elastic" => build(variation, request, |variation, perturbation| penalty.elastic(variation, perturbation)),
            _ => build(variation, request, |variation, perturbation| penalty.inertial(variation, perturbation)),
        }
    },
};

/// N iterations from lambda_0 = 0, K and Gdd at v'_i and lambda_i:
///
/// ```text
/// (M + s G^T G) dv'_i = -[K dq + C dv] - G^T dlambda_{i-1} - s G^T [(Gdd + c1 Gd + c0 G) dq + (G1 + c1 G) dv]
/// dlambda_i = dlambda_{i-1} + s [G dv'_i + (Gdd + c1 Gd + c0 G) dq + (G1 + c1 G) dv]
/// ```
///
/// Physical eigenvalues are off by O(penalty^-N).
pub const AUGMENTED_LAGRANGIAN: LinearizationMethod = LinearizationMethod {
    name: "augmented_lagrangian",
    options: &[
        formulation::PENALTY,
        OptionDoc { name: "iterations", about: "solutions with an updated lambda (default 3)" },
        formulation::OMEGA,
        formulation::XI,
        PROJECTED,
    ],
    build: |variation, request| {
        let iterations = request.method.whole("iterations", 3, 1..=100)?;
        let penalty = Penalty::new(&request.method, iterations, variation)?;
        build(variation, request, |variation, perturbation| penalty.inertial(variation, perturbation))
    },
};

struct Penalty {
    iterations: usize,
    /// Weight s of the constraints in M + s G^T G.
    weight: f64,
    /// (c1, c0) of phi'' + c1 phi' + c0 phi, 1/s and 1/s^2.
    held: [f64; 2],
}

impl Penalty {
    fn new(spec: &MethodSpec, iterations: usize, variation: &Variation) -> Result<Self> {
        let omega = spec.not_negative("omega", 10.0)?;
        let xi = spec.not_negative("xi", 1.0)?;
        let compliance = mean_compliance(&variation.dynamics.structure, &variation.dynamics.terms);
        let weight = spec.positive("penalty", 1e7)? / compliance;
        Ok(Penalty { iterations, weight, held: [2.0 * xi * omega, omega * omega] })
    }

    fn inertial(&self, variation: &mut Variation, perturbation: &Perturbation) -> Result<Response> {
        let g = variation.g();
        let point = variation.point.clone();
        let lu = (variation.mass() + g.transpose() * &g * self.weight).lu();
        let solve = |right: &Matrix| lu.solve(right).ok_or_else(singular);
        let column = |values: &[f64]| Matrix::from_column_slice(values.len(), 1, values);
        let terms = &variation.dynamics.terms;
        let (f, [c1, c0]) = (column(&terms.f), self.held);
        let wanted = column(&terms.gamma) - column(&terms.phi_dot) * c1 - column(&terms.phi) * c0;
        let mut lambda = Matrix::zeros(g.nrows(), 1);
        let none = Matrix::zeros(g.nrows(), perturbation.changes.q.ncols());
        let mut response = Response { vdot: Matrix::zeros(0, 0), lambda: none };
        for _ in 0..self.iterations {
            let vdot = solve(&(&f - g.transpose() * &lambda + g.transpose() * &wanted * self.weight))?;
            lambda += (&g * &vdot - &wanted) * self.weight;
            let at = OperatingPoint {
                t: point.t,
                q: &point.q,
                v: &point.v,
                vdot: vdot.as_slice(),
                lambda: lambda.as_slice(),
            };
            variation.load(at).map_err(|halt| at_state(point.t, &halt))?;
            let rows = perturbation.rows(variation, self.held);
            let push = perturbation.force(variation) - g.transpose() * (&response.lambda - &rows * self.weight);
            response.vdot = solve(&push)?;
            response.lambda += (&g * &response.vdot - rows) * self.weight;
        }
        variation.load_point()?;
        Ok(response)
    }

    fn elastic(&self, variation: &mut Variation, perturbation: &Perturbation) -> Result<Response> {
        let (g, [c1, c0]) = (variation.g(), self.held);
        let lu = variation.mass().lu();
        let [gap, rate] = perturbation.residuals(variation);
        let lambda = (gap * c0 + rate * c1) * self.weight;
        let vdot = lu.solve(&(perturbation.force(variation) - g.transpose() * &lambda)).ok_or_else(singular)?;
        Ok(Response { vdot, lambda })
    }
}

fn singular() -> Error {
    Error::input("a penalty method needs mass along every direction that the constraints leave free")
        .hint("take --method mcs, or give the body mass and inertia")
}
