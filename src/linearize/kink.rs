//! States at which the equations change their form: the linear model there is that of one side.

use super::{State, Variation};
use crate::error::{Result, Warning, clock};
use crate::math::{Piece, Rate, largest};
use crate::system::{MechanicalSystem, Need, OperatingPoint, Scratch, Tangent, Terms};
use crate::tolerances;

/// Returns a warning for each part of the equations that has a threshold at the state: see `changed_parts`.
///
/// # Errors
/// See [`Variation::new`].
pub fn kinks(system: &dyn MechanicalSystem, state: &State) -> Result<Vec<Warning>> {
    Ok(changed_parts(system, state)?.into_iter().map(|owner| warning(state.t, owner)).collect())
}

/// Returns the parts of the equations that have a threshold at the state and f, K or C that are not the same on both
/// sides of it: a law by `abs` or `if`, a point of a linear signal, a wheel that just touches.
///
/// # Errors
/// See [`Variation::new`].
pub(crate) fn changed_parts<'s>(system: &'s dyn MechanicalSystem, state: &State) -> Result<Vec<&'s str>> {
    let switches = system.switches().all;
    let mut owners = Vec::new();
    if switches.is_empty() {
        return Ok(owners);
    }
    let mut variation = Variation::new(system, state.t, &state.q, &state.v)?;
    let point = variation.point;
    let scratch = &mut variation.dynamics.scratch;
    let at = point.at();
    let mut arguments = vec![Rate::fixed(0.0); switches.len()];
    system.switching(at, &mut arguments, scratch);
    let pieces = switches.iter().zip(&arguments).map(|(switch, argument)| switch.thresholds.piece(argument.re));
    let pieces: Vec<Piece> = pieces.map(Option::unwrap_or_default).collect();
    for (number, (switch, argument)) in switches.iter().zip(&arguments).enumerate() {
        let Some((k, threshold)) = switch.thresholds.nearest(argument.re) else { continue };
        let is_near = (argument.re - threshold).abs() <= tolerances::SAME * threshold.abs().max(1.0);
        let mut side = |piece: usize| {
            scratch.pieces.clone_from(&pieces);
            scratch.pieces[number] = piece as Piece;
            terms_of(system, at, scratch)
        };
        if is_near && differ(&side(2 * k), &side(2 * k + 2)) {
            owners.push(system.switches().owner(number));
        }
    }
    owners.dedup();
    Ok(owners)
}

fn warning(t: f64, owner: &str) -> Warning {
    let text = format!("at t = {} s {owner} is where its form changes: the linear model is that of one side", clock(t));
    Warning::new(text, "choose a state beside it, or give a law that is smooth there")
}

/// f, K and C on the pieces of `scratch`.
fn terms_of(system: &dyn MechanicalSystem, at: OperatingPoint, scratch: &mut Scratch) -> [Vec<f64>; 3] {
    let mut terms = Terms::new(system);
    let mut tangent = Tangent::new(&system.structure().tangent);
    system.evaluate(at.t, at.q, at.v, Need::FORCE, &mut terms, scratch);
    system.tangent(at, &mut tangent, scratch);
    [terms.f, tangent.k, tangent.c]
}

fn differ(before: &[Vec<f64>; 3], after: &[Vec<f64>; 3]) -> bool {
    before.iter().zip(after).any(|(before, after)| {
        let reach = tolerances::SAME * largest(before).max(largest(after));
        before.iter().zip(after).any(|(a, b)| (a - b).abs() > reach)
    })
}
