//! The distance of a state from an earlier one, up to what the equations do not depend on.

use super::{State, Variation};
use crate::error::Result;
use crate::math::{dot, largest};
use crate::tolerances;
use std::f64::consts::TAU;

/// Parts of a displacement after which the equations are compared: no symmetry of single positions passes for one of
/// all.
const ON_THE_WAY: [f64; 2] = [0.371, 1.0];

/// Returns the largest difference of (q, v) between `end` and `start`, the operating point of `variation`. Whole turns and
/// displacements are no difference where all terms of the equations with their derivatives are the same with them: M,
/// G, Gd, v', K and C. A displacement that is no whole turn has to leave them the same on its way, too. The sign of a
/// quaternion is none.
///
/// # Errors
/// A state that has no variational equations.
pub(super) fn gap(variation: &mut Variation, start: &State, end: &State) -> Result<f64> {
    let system = variation.system();
    let mut last = end.q.clone();
    for rotation in system.facts().rotations.clone() {
        let quaternion = rotation.q..rotation.q + 4;
        if dot(&last[quaternion.clone()], &start.q[quaternion.clone()]) < 0.0 {
            last[quaternion].iter_mut().for_each(|x| *x = -*x);
        }
    }
    let velocities: Vec<f64> = end.v.iter().zip(&start.v).map(|(a, b)| a - b).collect();
    let shift: Vec<f64> = last.iter().zip(&start.q).map(|(a, b)| a - b).collect();
    let plain = largest(&shift).max(largest(&velocities));
    let tolerance = tolerances::PERIODIC * largest(&start.q).max(largest(&start.v)).max(1.0);
    if plain <= tolerance {
        return Ok(plain);
    }
    let turns: Vec<f64> = shift.iter().map(|x| whole_turns(*x, tolerance)).collect();
    let rest: Vec<f64> = shift.iter().zip(&turns).map(|(shift, turn)| shift - turn).collect();
    let displacement: Vec<f64> = rest.iter().map(|x| if x.abs() > tolerance { *x } else { 0.0 }).collect();
    let is_same = is_same(variation, start, end.t, &turns, &displacement)?;
    let left: Vec<f64> = rest.iter().zip(&displacement).map(|(rest, moved)| rest - moved).collect();
    Ok(if is_same { largest(&left).max(largest(&velocities)) } else { plain })
}

/// The multiple of 2 pi near a difference; 0 where there is none.
fn whole_turns(shift: f64, tolerance: f64) -> f64 {
    let turns = (shift / TAU).round() * TAU;
    if (shift - turns).abs() <= tolerance { turns } else { 0.0 }
}

/// True if the equations are the same at the start and at the states that are shifted by whole turns and by parts of the
/// displacement.
fn is_same(variation: &mut Variation, start: &State, end: f64, turns: &[f64], displacement: &[f64]) -> Result<bool> {
    let here = terms(variation);
    let fractions: &[f64] = if largest(displacement) > 0.0 { &ON_THE_WAY } else { &[1.0] };
    let mut is_same = true;
    for fraction in fractions {
        let shifts = turns.iter().zip(displacement).map(|(turn, moved)| turn + fraction * moved);
        let q: Vec<f64> = start.q.iter().zip(shifts).map(|(q, shift)| q + shift).collect();
        variation.operate_at(end, &q, &start.v)?;
        let there = terms(variation);
        is_same &= here.iter().zip(&there).all(|(a, b)| agree(a, b));
    }
    variation.operate_at(start.t, &start.q, &start.v)?;
    Ok(is_same)
}

/// M, G, Gd, v', K and C.
fn terms(variation: &Variation) -> [Vec<f64>; 6] {
    let terms = &variation.dynamics.terms;
    let tangent = &variation.tangent;
    let vdot = variation.point.vdot.clone();
    [terms.mass.clone(), terms.g.clone(), terms.l.clone(), vdot, tangent.k.clone(), tangent.c.clone()]
}

fn agree(a: &[f64], b: &[f64]) -> bool {
    let size = largest(a).max(largest(b)).max(1.0);
    a.iter().zip(b).all(|(a, b)| (a - b).abs() <= tolerances::ROOT_OF_ROUND_OFF * size)
}
