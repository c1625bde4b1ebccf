//! Messages for a search without an equilibrium.

use super::stability::{named, soft};
use super::system::{EquilibriumPoint, EquilibriumSystem};
use crate::error::{Error, Failure, short};
use crate::math::largest;
use crate::system::{Limited, MechanicalSystem};
use crate::tolerances;

pub(super) fn no_tangent() -> Error {
    Error::input("static equilibrium needs K, which these equations do not give")
        .hint("implement MechanicalSystem::tangent")
}

pub(super) fn no_memory() -> Error {
    Error::input("there is not enough memory for the matrix of the equilibrium")
}

pub(super) fn not_finite() -> Error {
    Error::input("at the start, the forces or their balance are not finite").under("forces")
}

pub(super) fn contradiction(t: f64) -> Error {
    let reason = "the state where all forces balance breaks constraints that depend on others at the start".to_string();
    let hint = "begin beside the singular state, or take away the redundant joints that `holonom check` names";
    Failure { t, reason, hint: hint.to_string() }.into()
}

/// Error of a beam that needs more elements.
pub(super) fn too_bent(t: f64, beam: &Limited, turn: f64) -> Error {
    let reason =
        format!("the ends of an element of the beam `{}` would turn against each other by {turn:.2} rad", beam.part);
    let hint = match beam.theory.elements_for(turn) {
        0 => "divide it, so that each part turns by a quarter turn at most".to_string(),
        count => format!("give it {count} elements or more, so that each turns by a quarter turn at most"),
    };
    Failure { t, reason, hint }.into()
}

const INTEGRATOR: &str = "look whether what it commands saturates, or does not act on what it integrates";
const HOLD: &str = "hold it by a joint or a spring, or take the force away";
const BEGIN_NEARER: &str = "begin nearer to it, or look at the motion with `holonom simulate`: with some damping it comes to \
                            rest where there is an equilibrium";

/// Name of an entry of a place.
fn name_of(system: &dyn MechanicalSystem, entry: usize) -> Option<String> {
    let names = system.facts().names.clone();
    let n = system.dimensions();
    names.q.into_iter().chain(names.v.into_iter().skip(n.moving())).nth(entry)
}

/// Error that names what keeps the mechanism moving from the start; `away` is the coordinate of an unbounded descent.
pub(super) fn none_found(rest: &mut EquilibriumSystem, start: &EquilibriumPoint, away: Option<usize>) -> Error {
    let t = rest.t;
    let failure = |reason: String, hint: &str| Failure { t, reason, hint: hint.to_string() }.into();
    let Some(balance) = rest.balance(&start.q) else { return not_finite() };
    let all = largest(&balance.force);
    if let Some(soft) = soft(rest, start) {
        let along = |d: &nalgebra::DVector<f64>| d.iter().zip(&balance.force).map(|(d, f)| d * f).sum::<f64>().abs();
        let loaded: Vec<_> =
            soft.directions.into_iter().filter(|d| along(d) > tolerances::SIX_DIGITS * all * d.amax()).collect();
        if !loaded.is_empty() {
            let names = named(rest, &loaded).join("`, `");
            let moving = rest.dynamics.system.dimensions().moving();
            if loaded.iter().all(|d| d.rows(0, moving).amax() < 0.5 * d.amax()) {
                return failure(
                    format!("there is no static equilibrium: the rate of the state `{names}` does not come to zero"),
                    INTEGRATOR,
                );
            }
            let holds = format!("nothing holds `{names}` against the forces that move it");
            // A coordinate without stiffness at the start may have some elsewhere, as in a pendulum that starts level.
            return match away {
                Some(_) => failure(format!("there is no static equilibrium: {holds}"), HOLD),
                None => failure(format!("no static equilibrium was found; at the start {holds}"), BEGIN_NEARER),
            };
        }
    }
    if let Some(name) =
        away.filter(|entry| *entry >= rest.coordinates).and_then(|entry| name_of(rest.dynamics.system, entry))
    {
        return failure(format!("there is no static equilibrium: the state `{name}` grows on and on"), INTEGRATOR);
    }
    if let Some(name) = away.and_then(|coordinate| name_of(rest.dynamics.system, coordinate)) {
        return failure(format!("there is no static equilibrium: the forces move `{name}` on and on"), HOLD);
    }
    let worst = (0..balance.force.len()).max_by(|&i, &j| balance.force[i].abs().total_cmp(&balance.force[j].abs()));
    let name = worst.and_then(|i| rest.dynamics.system.facts().names.v.get(i).cloned()).unwrap_or_default();
    failure(
        format!(
            "no static equilibrium was found; at the start a force of {} (N, N m) is left on `{}`",
            short(worst.map_or(0.0, |i| balance.force[i].abs())),
            name.trim_end_matches('\'')
        ),
        BEGIN_NEARER,
    )
}
