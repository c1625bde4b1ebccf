//! The state that is perturbed.

use crate::formulation::Dynamics;
use crate::math::{largest, largest_in};
use crate::system::{OperatingPoint, Spin};
use crate::tolerances;

/// A state with its accelerations and multipliers.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct LinearizationPoint {
    /// Time, s.
    pub t: f64,
    /// Coordinates, n_q.
    pub q: Vec<f64>,
    /// Velocities, n_v.
    pub v: Vec<f64>,
    /// Number of the last of them that are states.
    pub states: usize,
    /// Accelerations v', n_v.
    pub vdot: Vec<f64>,
    /// Multipliers, n_c.
    pub lambda: Vec<f64>,
    /// Values of the inputs, n_u.
    pub u: Vec<f64>,
    /// Largest |phi|, each row over its scale.
    pub phi: f64,
    /// Largest |phi'|, each row over its scale, 1/s.
    pub phi_dot: f64,
    /// True if v = 0 and v' = 0, to rounding.
    pub is_equilibrium: bool,
    /// Rotation of the axes in which q and v are expressed; none in the inertial frame.
    #[doc(hidden)]
    pub axes: Option<Spin>,
    /// Rotation that drives prescribe, if any.
    #[doc(hidden)]
    pub driven: Option<Spin>,
}

impl LinearizationPoint {
    /// The state as systems take it.
    pub(super) fn at(&self) -> OperatingPoint<'_> {
        OperatingPoint { t: self.t, q: &self.q, v: &self.v, vdot: &self.vdot, lambda: &self.lambda }
    }

    /// The state whose terms and solution `dynamics` contains, with its K.
    pub(super) fn new(dynamics: &Dynamics, k: &[f64], t: f64, q: &[f64], v: &[f64]) -> Self {
        let terms = &dynamics.terms;
        let scales = dynamics.system.facts().scales.clone();
        LinearizationPoint {
            t,
            q: q.to_vec(),
            v: v.to_vec(),
            states: dynamics.system.dimensions().states,
            vdot: dynamics.vdot.clone(),
            lambda: dynamics.lambda.clone(),
            u: Vec::new(),
            phi: largest_in(&scales, &terms.phi),
            phi_dot: largest_in(&scales, &terms.phi_dot),
            is_equilibrium: is_at_rest(dynamics, &rounding(dynamics, k, q), v),
            axes: dynamics.system.facts().axes,
            driven: dynamics.system.prescribed_spin(t),
        }
    }
}

/// Returns the change of each force by coordinates rounded by some ulps.
pub(super) fn rounding(dynamics: &Dynamics, k: &[f64], q: &[f64]) -> Vec<f64> {
    let mut rounding = vec![0.0; dynamics.vdot.len()];
    let reach = tolerances::ROUND_OFF_OF_SUMS * largest(q).max(1.0);
    for (&(i, _), k) in dynamics.structure.tangent.entries.iter().zip(k) {
        rounding[i] += reach * k.abs();
    }
    rounding
}

/// True if nothing moves and M v' is negligible against the forces and reactions that it is the sum of, or their
/// rounding.
fn is_at_rest(dynamics: &Dynamics, rounding: &[f64], v: &[f64]) -> bool {
    let structure = &dynamics.structure;
    let terms = &dynamics.terms;
    let mut inertia = vec![0.0; v.len()];
    structure.mass.multiply_symmetric(&terms.mass, &dynamics.vdot, &mut inertia);
    let mut usual: Vec<f64> = terms.f.iter().map(|f| f.abs()).collect();
    for (&(i, j), g) in structure.g.entries.iter().zip(&terms.g) {
        usual[j] += (g * dynamics.lambda[i]).abs();
    }
    let moving = dynamics.system.dimensions().moving();
    let heaviness = structure.mass.entries.iter().zip(&terms.mass).filter(|((i, j), _)| i == j && *i < moving);
    let accelerations = heaviness.map(|((i, _), mass)| if *mass > 0.0 { usual[*i] / mass } else { 0.0 });
    let speed = (accelerations.fold(0.0, f64::max) * dynamics.system.facts().length.min(1.0)).sqrt();
    // Without loads there is only rounding: an acceleration of 1 m/s^2 or rad/s^2 is the reference then.
    let heaviest = structure.mass.entries.iter().zip(&terms.mass).filter(|((i, j), _)| i == j);
    let heaviest = heaviest.fold(0.0f64, |most, (_, mass)| most.max(*mass));
    let least = tolerances::SAME * largest(&usual).max(heaviest);
    let is_balanced = inertia.iter().zip(rounding).all(|(inertia, rounding)| inertia.abs() <= least.max(*rounding));
    largest(&v[..moving]) <= tolerances::SAME * speed && is_balanced
}
