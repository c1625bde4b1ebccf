//! Stability of an equilibrium.

use super::system::{EquilibriumPoint, EquilibriumSystem};
use crate::formulation::{free_directions, reduce};
use crate::modes::eigenvalues;
use crate::tolerances;
use nalgebra::{DMatrix, DVector, SymmetricEigen};
use serde::Serialize;

/// Stability of an equilibrium, in increasing order.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Serialize)]
#[serde(rename_all = "snake_case")]
pub enum Stability {
    /// K is negative along a direction that the constraints allow, or a small motion grows.
    Unstable,
    /// There are too many coordinates for the eigenvalues, or forces without a potential or states and motions that
    /// neither grow nor decay.
    Unknown,
    /// K is zero along a direction, and nowhere negative.
    Neutral,
    /// K is positive along all directions, or all small motions decay.
    Stable,
}

const MOST_NAMED: usize = 6;

/// Directions without stiffness among those that the constraints allow.
pub(super) struct Soft {
    pub smallest: f64,
    /// Directions along q, each of unit kinetic mass.
    pub directions: Vec<DVector<f64>>,
    is_symmetric: bool,
    /// Z^T K Z, and Z.
    k: DMatrix<f64>,
    z: DMatrix<f64>,
}

/// Zero and smallest eigenvalues of Z^T K Z at a place; `None` where it is too large or cannot be evaluated.
pub(super) fn soft(rest: &mut EquilibriumSystem, place: &EquilibriumPoint) -> Option<Soft> {
    if rest.dynamics.vdot.len() > tolerances::DENSE_EIGENVALUES {
        return None;
    }
    let balance = rest.balance(&place.q)?;
    rest.factor(&balance.place, 0.0);
    rest.dynamics.factor().ok()?;
    let z = free_directions(&mut rest.dynamics)?;
    let k = reduce(&rest.dynamics.structure.tangent, &rest.tangent.k, &z);
    let symmetric = 0.5 * (&k + k.transpose());
    let is_symmetric = (&k - &symmetric).amax() <= tolerances::SIX_DIGITS * k.amax();
    if k.is_empty() {
        return Some(Soft { smallest: f64::INFINITY, directions: Vec::new(), is_symmetric, k, z });
    }
    let least = tolerances::ROUND_OFF_OF_SUMS * k.amax() * k.nrows() as f64;
    let eigen = SymmetricEigen::new(symmetric);
    let soft = eigen.eigenvalues.iter().enumerate().filter(|(_, value)| value.abs() <= least);
    Some(Soft {
        smallest: eigen.eigenvalues.iter().copied().fold(f64::INFINITY, f64::min),
        directions: soft.map(|(i, _)| &z * eigen.eigenvectors.column(i)).collect(),
        is_symmetric,
        k,
        z,
    })
}

/// Stability of an equilibrium, and the names of the coordinates without stiffness.
pub(super) fn judge(rest: &mut EquilibriumSystem, place: &EquilibriumPoint) -> (Stability, Vec<String>) {
    let Some(soft) = soft(rest, place) else { return (Stability::Unknown, Vec::new()) };
    let free = named(rest, &soft.directions);
    let stability = if !soft.is_symmetric {
        by_modes(rest, &soft).unwrap_or(Stability::Unknown)
    } else if !soft.directions.is_empty() {
        Stability::Neutral
    } else if soft.smallest > 0.0 {
        Stability::Stable
    } else {
        Stability::Unstable
    };
    (stability, free)
}

/// Stability by the eigenvalues of small motions, at the place of the last factorization: for forces without a potential
/// and for states, whose columns of K are those of C.
fn by_modes(rest: &EquilibriumSystem, Soft { z, k, .. }: &Soft) -> Option<Stability> {
    let c = reduce(&rest.dynamics.structure.tangent, &rest.tangent.c, z);
    let moving = z.ncols() - rest.dynamics.system.dimensions().states;
    let values = eigenvalues(k, &c, moving)?;
    let size = values.iter().map(|value| value.norm()).fold(0.0, f64::max);
    let growth = values.iter().map(|value| value.re).fold(f64::NEG_INFINITY, f64::max);
    let is_sure = growth.abs() > tolerances::HALF_OF_THE_DIGITS * size;
    is_sure.then_some(if growth > 0.0 { Stability::Unstable } else { Stability::Stable })
}

/// Names of the coordinates with the largest components in the directions.
pub(super) fn named(rest: &EquilibriumSystem, directions: &[DVector<f64>]) -> Vec<String> {
    let names = rest.dynamics.system.facts().names.v.clone();
    let mut found = Vec::new();
    for direction in directions {
        // A coordinate that is named.
        let taking = |i: &usize| direction[*i].abs() >= 0.3 * direction.amax();
        found.extend((0..direction.len()).filter(taking));
    }
    found.sort_unstable();
    found.dedup();
    found.into_iter().take(MOST_NAMED).map(|i| names[i].trim_end_matches('\'').to_string()).collect()
}
