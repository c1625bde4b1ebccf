//! Acceptance of a result of Newton's method as an equilibrium.

use super::descent::gone;
use super::system::{EquilibriumPoint, EquilibriumSystem};
use crate::math::largest;
use crate::system::{Limited, Theory};
use crate::tolerances;

/// Reference values of forces and stiffness from the start.
pub(super) struct Judge {
    q: Vec<f64>,
    loads: f64,
    stiffness: Vec<f64>,
}

impl Judge {
    /// Evaluates and factors at the start.
    pub fn at(rest: &mut EquilibriumSystem, start: &EquilibriumPoint) -> Self {
        rest.evaluate(&start.q);
        rest.factor(start, 0.0);
        Judge { q: start.q.clone(), loads: largest(&rest.sizes(start)), stiffness: rest.stiffness() }
    }

    /// True if the forces balance there: an unbounded matrix makes any step small, and any force round-off.
    pub fn accepts(&self, rest: &mut EquilibriumSystem, place: &EquilibriumPoint) -> bool {
        if gone(&place.q, &self.q).is_some() {
            return false;
        }
        let Some(balance) = rest.balance(&place.q) else { return false };
        let rounding = tolerances::ROUND_OFF_OF_FACTORS * largest(&place.q).max(1.0);
        // Without loads, rounded springs are the loads of parts that have no spring.
        let rounded = rounding * largest(&self.stiffness);
        let loads = self.loads.max(largest(&rest.sizes(&balance.place))).max(rounded);
        let allowed = self.stiffness.iter().map(|k| tolerances::SIX_DIGITS * loads + rounding * k);
        balance.force.iter().zip(allowed).all(|(force, allowed)| force.abs() <= allowed)
    }

    /// The beam with an element that rotates beyond its theory, and the rotation, rad.
    pub fn bent(rest: &EquilibriumSystem, q: &[f64]) -> Option<(Limited, f64)> {
        let system = rest.dynamics.system;
        let facts = system.facts();
        let mut deformations = vec![0.0; facts.limited.len()];
        system.deformations(&q[..rest.coordinates], &mut deformations);
        let mut parts = facts.limited.iter().cloned().zip(deformations);
        let is_bent = |(limited, turn): &(Limited, f64)| match limited.theory {
            // 0.95 of what an element can turn at all, over what is warned of.
            Theory::Helix { .. } => *turn > 0.95 / 0.75 * limited.theory.most(),
            _ => false,
        };
        parts.find(is_bent)
    }
}
