//! Sizes and rates of perturbations, and perturbed states.

use super::probe::pieces;
use super::{Decay, decay};
use crate::error::Result;
use crate::initial::assemble;
use crate::linearize::flow::Snapshot;
use crate::linearize::{Changes, Coordinates, Matrix, Minimal, State, directions_of};
use crate::math::eigen::eigen;
use crate::system::{MechanicalSystem, Scratch};
use crate::tolerances::{ROOT_OF_ROUND_OFF, ROUNDED_ZERO};

/// Sizes of the perturbation, of (dq, dv/rate) in m or rad; that of the last one is [rounding](tolerances::ROOT_OF_ROUND_OFF).
pub const EPSILONS: [f64; 8] = [1e-1, 3e-2, 1e-2, 1e-3, 1e-4, 1e-5, 1e-6, 1e-9];

/// Returns `start` perturbed by eps x0 and projected onto the constraints of position and velocity; none where that
/// fails.
pub fn moved(
    system: &dyn MechanicalSystem,
    start: &State,
    coordinates: &Coordinates,
    x0: &Matrix,
    eps: f64,
) -> Option<State> {
    let Changes { q: dq, v: dv } = coordinates.changes_of(&(x0 * eps));
    let mut q = start.q.clone();
    crate::formulation::ExponentialMap::new(system).apply(system, &start.q, dq.as_slice(), &mut q);
    let v: Vec<f64> = start.v.iter().zip(&dv).map(|(v, dv)| v + dv).collect();
    let closed = assemble(system, start.t, (&q, &v), &[]).ok()?;
    Some(State { t: start.t, q: closed.q, v: closed.v })
}

/// Returns (dq, dv) from one state to another. For quaternions dq is right to first order, which changes errors of second
/// order by terms of second order.
pub fn difference(system: &dyn MechanicalSystem, from: &State, to: &State) -> [Vec<f64>; 2] {
    let change: Vec<f64> = to.q.iter().zip(&from.q).map(|(to, from)| to - from).collect();
    let dv = to.v.iter().zip(&from.v).map(|(to, from)| to - from).collect();
    if from.q.len() == from.v.len() {
        return [change, dv];
    }
    let dq = directions_of(system, &from.q) * nalgebra::DVector::from_vec(change);
    [dq.as_slice().to_vec(), dv]
}

/// True if no function that changes its form is on another piece in one state than in the other.
pub fn are_alike(system: &dyn MechanicalSystem, one: &State, other: &State) -> bool {
    let mut scratch = Scratch::default();
    system.switches().all.is_empty() || pieces(system, one, &mut scratch) == pieces(system, other, &mut scratch)
}

/// Typical and fastest rate of a model, 1/s.
pub struct Speed {
    pub usual: f64,
    pub fastest: f64,
}

impl Speed {
    pub fn of(model: &Minimal) -> Result<Self> {
        let values = eigen(&model.built.a)?.values;
        let rates: Vec<f64> = values.iter().map(|value| value.norm()).filter(|rate| *rate > 1e-6).collect();
        let fastest = rates.iter().copied().fold(1.0, f64::max);
        let mean = rates.iter().map(|rate| rate.ln()).sum::<f64>() / rates.len().max(1) as f64;
        Ok(Speed {
            usual: if rates.is_empty() { 1.0 } else { mean.exp() },
            fastest: if rates.is_empty() { 1.0 } else { fastest },
        })
    }

    /// Returns the period of a typical mode, s, limited to a number of periods of the fastest.
    pub fn period(&self) -> f64 {
        // Longer runs would cost more than they tell.
        std::f64::consts::TAU * (1.0 / self.usual).min(8.0 / self.fastest)
    }
}

/// Norm of changes (dq, dv) in which velocities are divided by `rate`, 1/s.
pub struct Norm {
    pub rate: f64,
}

impl Norm {
    pub fn size(&self, dq: &[f64], dv: &[f64]) -> f64 {
        let square = |x: &[f64]| x.iter().map(|x| x * x).sum::<f64>();
        (square(dq) + square(dv) / self.rate.powi(2)).sqrt()
    }

    /// Returns |(dq, dv) - eps column|.
    fn off(&self, dq: &[f64], dv: &[f64], column: &Changes, eps: f64) -> f64 {
        let rest = |x: &[f64], c: &Matrix| x.iter().zip(c).map(|(x, c)| x - eps * c).collect::<Vec<f64>>();
        self.size(&rest(dq, &column.q), &rest(dv, &column.v))
    }

    /// Returns the norm of states (z, y), of which the first are displacements.
    pub fn states(&self, freedom: usize, x: &Matrix) -> f64 {
        let (z, y) = x.as_slice().split_at(freedom);
        self.size(z, y)
    }

    /// Returns |difference of the motions - eps changes| of each perturbed motion.
    pub fn errors(
        &self,
        system: &dyn MechanicalSystem,
        end: &Snapshot,
        changes: &Changes,
        epsilons: &[f64],
    ) -> Vec<f64> {
        let error = |(member, eps): (&State, &f64)| {
            let [dq, dv] = difference(system, &end.motion, member);
            self.off(&dq, &dv, changes, *eps)
        };
        end.members.iter().zip(epsilons).map(error).collect()
    }

    /// Returns the order of such errors in eps, without those of motions that ended on other pieces of the equations.
    /// The largest of those below the square root of round-off is taken for rounding.
    pub fn order(&self, system: &dyn MechanicalSystem, end: &Snapshot, epsilons: &[f64], errors: &[f64]) -> Decay {
        let comparable = |(error, member): (&f64, &State)| {
            if are_alike(system, &end.motion, member) { *error } else { f64::NAN }
        };
        let errors: &[f64] = &errors.iter().zip(&end.members).map(comparable).collect::<Vec<f64>>();
        let size = self.size(end.columns.q.as_slice(), end.columns.v.as_slice());
        let rounding =
            errors.iter().zip(epsilons).filter(|(error, eps)| error.is_finite() && **eps < ROOT_OF_ROUND_OFF);
        let floor = rounding.map(|(error, _)| *error).fold(ROUNDED_ZERO, f64::max);
        decay(epsilons, errors, |eps| 0.1 * eps * size, floor)
    }
}
