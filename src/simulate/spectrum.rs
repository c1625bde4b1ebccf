//! The modes of a mechanism at one state of its motion.

use crate::formulation::{Dynamics, free_directions, reduce};
use crate::math::kkt::Pattern;
use crate::modes::{self, Sparse, SpectralMode, rate_bound};
use crate::system::{MechanicalSystem, Need, OperatingPoint, Scratch, Tangent, Terms};
use crate::tolerances::DENSE_EIGENVALUES;

/// Modes of small perturbations of the motion with its coefficients frozen at one state:
///
/// ```text
/// Z^T M Z z'' + Z^T C Z z' + Z^T K Z z = 0,   G Z = 0
/// ```
///
/// with K and C at the v' and lambda of the state. At an equilibrium these are the modes; elsewhere they depend on the
/// coordinates, and tell the time scales but not the stability.
#[derive(Clone, Debug, PartialEq)]
pub struct Spectrum {
    /// The modes, from the slowest to the fastest.
    pub modes: Vec<SpectralMode>,
    /// True if there are too many coordinates for all modes: then only the fastest are known, approximately.
    pub is_estimate: bool,
}

impl Spectrum {
    /// Modes at a state with the v' and lambda of the equations. `None` without K and C, or where they are not finite.
    pub fn at(system: &dyn MechanicalSystem, state: OperatingPoint) -> Option<Self> {
        let mut frozen = Frozen::new(system, state)?;
        if system.dimensions().v > DENSE_EIGENVALUES {
            return Some(Spectrum { modes: frozen.fastest()?, is_estimate: true });
        }
        let z = free_directions(&mut frozen.dynamics)?;
        let k = reduce(frozen.places(), &frozen.tangent.k, &z);
        let c = reduce(frozen.places(), &frozen.tangent.c, &z);
        Some(Spectrum { modes: modes::all(&k, &c)?, is_estimate: false })
    }
}

/// The fastest mode alone, by an approximation that is cheap at any size; `None` as for [`Spectrum::at`].
pub fn fastest(system: &dyn MechanicalSystem, state: OperatingPoint) -> Option<SpectralMode> {
    Frozen::new(system, state)?.fastest()?.last().copied()
}

/// A rate that no mode exceeds, 1/s, from sums over rows of K, C and M alone; `None` as for [`Spectrum::at`], and where
/// M has no dominant diagonal.
pub fn bound(system: &dyn MechanicalSystem, state: OperatingPoint) -> Option<f64> {
    let structure = system.structure();
    let mut scratch = Scratch::default();
    let mut terms = Terms::new(system);
    let mut tangent = Tangent::new(&structure.tangent);
    system.evaluate(state.t, state.q, state.v, Need::MASS, &mut terms, &mut scratch);
    if !system.tangent(state, &mut tangent, &mut scratch) {
        return None;
    }
    rate_bound(&structure.mass, &terms.mass, &structure.tangent, &tangent.k, &tangent.c)
}

/// The equations of motion at a state, factored, with K and C.
struct Frozen<'a> {
    dynamics: Dynamics<'a>,
    tangent: Tangent,
}

impl<'a> Frozen<'a> {
    fn new(system: &'a dyn MechanicalSystem, state: OperatingPoint) -> Option<Self> {
        let mut dynamics = Dynamics::new(system);
        dynamics.solve(state.t, state.q, state.v, |_, _| 0.0).ok()?;
        let mut tangent = Tangent::new(&dynamics.structure.tangent);
        let is_known = system.tangent(state, &mut tangent, &mut dynamics.scratch);
        let is_finite = tangent.k.iter().chain(&tangent.c).all(|x| x.is_finite());
        (is_known && is_finite).then_some(Frozen { dynamics, tangent })
    }

    fn places(&self) -> &Pattern {
        &self.dynamics.structure.tangent
    }

    fn fastest(&mut self) -> Option<Vec<SpectralMode>> {
        let k = Sparse::without_zeros(self.places(), &self.tangent.k);
        let c = Sparse::without_zeros(self.places(), &self.tangent.c);
        let mut rows = vec![0.0; self.dynamics.lambda.len()];
        modes::fastest(&k, &c, |mut force| {
            rows.fill(0.0);
            self.dynamics.kkt.solve_motion(&mut force, &mut rows).ok()?;
            force.iter().all(|x| x.is_finite()).then_some(force)
        })
    }
}
