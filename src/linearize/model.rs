//! The linear model that every method of linearization returns.

use super::{Coordinates, LinearizationPoint, Matrix, Reference, Units, Variation};
use crate::error::{Warning, clock, two_digits};
use crate::tolerances;
pub use nalgebra::Complex;
use std::f64::consts::TAU;

/// A linear model of a mechanism at a state of its motion,
///
/// ```text
/// E x' = A x + B u,   y = C x + D u        (E = I where there is none)
/// ```
///
/// with x, u and y small changes from the operating point.
#[derive(Clone, Debug)]
pub struct LinearModel {
    /// Method as on the command line: `mcs`, `rcs:form=index2`, `baumgarte:alpha=5,beta=5`.
    pub method: String,
    /// The coordinates of the perturbation, on which the spectrum depends off equilibrium: `intrinsic`,
    /// `mass_orthogonal`, `crank.angle`, `frozen`.
    pub chart: String,
    /// Names of the states x. The last ones are those of the inputs: `road` where the input is `road'`.
    pub states: Vec<String>,
    /// Names of the inputs u: an input of the system or the derivative of one, such as `shaker''`.
    pub inputs: Vec<String>,
    /// Order r of the derivative that each input is: it has r states, which integrate it.
    pub orders: Vec<usize>,
    /// Names of the outputs y.
    pub outputs: Vec<String>,
    /// A, n_x x n_x.
    pub a: Matrix,
    /// B, n_x x n_u.
    pub b: Matrix,
    /// C, n_y x n_x.
    pub c: Matrix,
    /// D, n_y x n_u.
    pub d: Matrix,
    /// E of a descriptor form, n_x x n_x, singular; none: I.
    pub e: Option<Matrix>,
    /// All eigenvalues but the zeros of the states of inputs: physical ones first, then uncertain, spurious and
    /// infinite ones; each kind from the slowest.
    pub modes: Vec<Mode>,
    /// The chart with what the outputs and rates are at the state; none of methods without minimal coordinates.
    #[doc(hidden)]
    pub frame: Option<ModelFrame>,
    /// The state that is perturbed, as the reference of a controller.
    pub state: Reference,
    /// The state that is perturbed, with its accelerations and multipliers.
    pub point: LinearizationPoint,
    /// Time, size and conditioning.
    #[doc(hidden)]
    pub cost: Cost,
    /// Condition of the reduction to the directions that the constraints allow, and the error that follows.
    #[doc(hidden)]
    pub reduction: Reduction,
}

/// The relation of a model's states and outputs to those of the mechanism: dq = R z, dv = R y + T z.
#[derive(Clone, Debug)]
pub struct ModelFrame {
    /// The chart, with R and T.
    pub coordinates: Coordinates,
    /// q' = N(q) v, n_q.
    pub qdot: Vec<f64>,
    /// Outputs at the operating point, from which y is the change.
    pub outputs: Vec<f64>,
    /// Units of x, u and y.
    pub units: Units,
}

impl ModelFrame {
    /// The frame of a chart at the state of `variation`, of a model with derivatives of inputs of these orders.
    pub(super) fn new(variation: &mut Variation, coordinates: Coordinates, orders: &[usize]) -> Self {
        let system = variation.system();
        let mut qdot = vec![0.0; variation.point.q.len()];
        system.rate(&variation.point.q, &variation.point.v, &mut qdot);
        let mut outputs = vec![0.0; system.facts().outputs.len()];
        system.outputs(variation.point.at(), &mut outputs, &mut variation.dynamics.scratch);
        let units = Units::new(system, &coordinates, orders);
        ModelFrame { coordinates, qdot, outputs, units }
    }
}

/// Class of an eigenvalue.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, serde::Serialize)]
#[serde(rename_all = "snake_case")]
pub enum Kind {
    /// A motion that the constraints allow.
    Physical,
    /// Physical or spurious: the parts of the motions off the constraints do not tell which.
    Uncertain,
    /// A motion off the constraints, which a formulation damps or lets oscillate.
    Spurious,
    /// An infinite eigenvalue, from an algebraic equation of a descriptor form.
    Infinite,
}

impl Kind {
    /// Name in files and text.
    pub fn name(self) -> &'static str {
        match self {
            Kind::Physical => "physical",
            Kind::Uncertain => "uncertain",
            Kind::Spurious => "spurious",
            Kind::Infinite => "infinite",
        }
    }
}

impl LinearModel {
    /// Returns the names of the inputs of the system, of which the inputs of the model are derivatives.
    pub fn input_names(&self) -> Vec<String> {
        let name =
            |(name, order): (&String, &usize)| name.strip_suffix(&"'".repeat(*order)).unwrap_or(name).to_string();
        self.inputs.iter().zip(&self.orders).map(name).collect()
    }

    /// False off equilibrium for a method that stays off the constraints: its frozen eigenvalues belong to no motion on
    /// them, and agree with those of no chart.
    pub fn is_comparable(&self) -> bool {
        let strays = ["penalty", "augmented_lagrangian"].iter().any(|name| self.method.starts_with(name));
        self.point.is_equilibrium || !strays || self.chart != REDUNDANT
    }

    /// Warning of a state so near to a singular one that rounding changes the model.
    pub fn doubt(&self) -> Option<Warning> {
        let Reduction { condition, error } = self.reduction;
        if error.is_nan() || error <= tolerances::SIX_DIGITS {
            return None;
        }
        let text = format!(
            "at t = {} s the constraints are nearly dependent (condition {condition:.1e}), so rounding changes the linear \
             model by {} of its size",
            clock(self.point.t),
            two_digits(error)
        );
        Some(Warning::new(text, "choose another time, or state the start in coordinates that are farther off"))
    }

    /// True if some eigenvalues are [`Kind::Uncertain`].
    pub fn has_uncertain_kinds(&self) -> bool {
        self.modes.iter().any(|mode| mode.kind == Kind::Uncertain)
    }
}

/// An eigenvalue with its motion exp(value t) shape.
#[derive(Clone, Debug, PartialEq)]
pub struct Mode {
    /// Eigenvalue, 1/s; infinite (with imaginary part 0) for [`Kind::Infinite`].
    pub value: Complex<f64>,
    /// Physical, uncertain, spurious or infinite.
    pub kind: Kind,
    /// Change of q along the velocity directions of the whole mechanism, largest component 1; empty for infinite ones.
    pub shape: Vec<Complex<f64>>,
    /// Participation |y_i x_i| of each state, by the left and right eigenvectors, sum 1; empty where it is not known.
    pub participation: Vec<f64>,
    /// Part of each velocity direction in the kinetic energy of the mode, sum 1; empty for infinite ones.
    pub energy: Vec<f64>,
    /// Modal mass x^H M x of the shape x, kg m^2 or kg as its largest component is an angle or a length.
    pub mass: f64,
    /// Change of each output with the shape; empty for infinite ones.
    pub outputs: Vec<Complex<f64>>,
    /// |lambda| that rounding leaves of a zero eigenvalue, 1/s. Of K: with lambda^2 x^H M x = -x^H K x for the shape x,
    /// the root of that of the terms of x^H K x. Of the solver: [`errors`](crate::math::eigen::Eigen::errors).
    pub rounding: f64,
    /// 1/|y^H x| of the left and right vectors of norm 1 in the balanced states: how much more than rounding the
    /// eigenvalue changes by rounding. Infinite for a defective one; NaN where it is not known.
    pub condition: f64,
    /// |error| of the eigenvalue, 1/s, to first order: of the solver, of the entries of K, and of the reduction.
    pub error: f64,
}

/// Chart of the methods in all coordinates.
pub(super) const REDUNDANT: &str = "redundant";

impl Mode {
    /// |lambda| / 2 pi, Hz.
    pub fn frequency(&self) -> f64 {
        frequency(self.value)
    }

    /// Damping ratio -Re(lambda) / |lambda|; 0 for lambda = 0.
    pub fn damping(&self) -> f64 {
        damping(self.value)
    }

    /// True if the eigenvalue is zero but for rounding: it has no frequency and no damping.
    pub fn is_zero(&self) -> bool {
        self.value.norm() <= self.rounding
    }

    /// True for a motion without frequency and damping, in which bodies move.
    pub fn is_rigid_body(&self) -> bool {
        self.kind == Kind::Physical && self.is_zero() && self.mass > 0.0
    }

    /// The eigenvalue, 1/s, zero where it is rounding, and so its real part.
    pub fn clean_value(&self) -> Complex<f64> {
        if self.is_zero() {
            Complex::ZERO
        } else {
            Complex::new(if self.clean_damping() == 0.0 { 0.0 } else { self.value.re }, self.value.im)
        }
    }

    /// The damping ratio, 0 where it is rounding.
    pub fn clean_damping(&self) -> f64 {
        Some(self.damping()).filter(|ratio| ratio.abs() > tolerances::SAME && !self.is_zero()).unwrap_or(0.0)
    }
}

/// |lambda| / 2 pi, Hz.
pub fn frequency(value: Complex<f64>) -> f64 {
    value.norm() / TAU
}

/// Damping ratio -Re(lambda) / |lambda|; 0 for lambda = 0 and for infinite lambda.
pub fn damping(value: Complex<f64>) -> f64 {
    let size = value.norm();
    if size > 0.0 && size.is_finite() { 0.0 - value.re / size } else { 0.0 }
}

/// A real eigenvalue, or the one with the positive imaginary part of a conjugate pair.
#[derive(Clone, Copy, Debug)]
pub struct ModePair<'a> {
    /// The mode.
    pub mode: &'a Mode,
    /// True for a conjugate pair.
    pub is_pair: bool,
}

/// Returns the finite eigenvalues of a kind in their order, each pair once.
pub fn pairs(model: &LinearModel, kind: Kind) -> Vec<ModePair<'_>> {
    let modes: Vec<&Mode> = model.modes.iter().filter(|mode| mode.kind == kind).collect();
    let mut is_taken = vec![false; modes.len()];
    let mut found = Vec::new();
    for i in 0..modes.len() {
        if std::mem::replace(&mut is_taken[i], true) {
            continue;
        }
        let partner = (i + 1..modes.len()).find(|&j| !is_taken[j] && are_conjugate(modes[i].value, modes[j].value));
        if let Some(j) = partner {
            is_taken[j] = true;
        }
        let upper = partner.filter(|&j| modes[j].value.im > modes[i].value.im).unwrap_or(i);
        found.push(ModePair { mode: modes[upper], is_pair: partner.is_some() });
    }
    found
}

/// True if two values are not real and conjugate to each other.
pub fn are_conjugate(a: Complex<f64>, b: Complex<f64>) -> bool {
    let near = tolerances::EIGENVALUES_AGREE * a.norm();
    a.im != 0.0 && a.im * b.im < 0.0 && (a - b.conj()).norm() <= near
}

/// How well a state determines its linear model.
#[derive(Clone, Copy, Debug, Default, PartialEq, serde::Serialize)]
pub struct Reduction {
    /// Inverse of about the smallest sine of the angle between an independent row of G and those before it, in the metric
    /// of M^-1. It grows without bound towards a singular state.
    pub condition: f64,
    /// Error of the model, as a part of the size of A, by rounding of the state. Beside a fold it grows with the fourth
    /// power of the condition: accelerations have its square, and their gradients that of these.
    pub error: f64,
}

/// Cost and conditioning of a model.
#[derive(Clone, Copy, Debug, Default, PartialEq, serde::Serialize)]
pub struct Cost {
    /// Time to assemble the matrices, s.
    pub assembly_seconds: f64,
    /// Time to compute the eigenvalues, s.
    pub eigen_seconds: f64,
    /// Condition number of the eigenvector matrix (columns of length 1) in the states as they are, not scaled.
    pub conditioning: f64,
    /// Rows and columns of A.
    pub size: usize,
    /// Part of the motion off the directions that the constraints allow, in \[0, 1\] in the metric of the kinetic
    /// energy: the largest of the physical modes and the least of the spurious ones. None without spurious ones.
    pub off_constraints: Option<[f64; 2]>,
}
