//! Consistent initial values: q, then v, then v' and lambda; static equilibrium.

mod closing;
mod continuation;
mod diagnosis;
mod equilibrium;
mod follow;
mod holds;
mod metric;
mod nearest;
mod position;
mod reach;
mod report;
mod travel;
mod velocity;

pub(crate) use continuation::continuation;
pub use equilibrium::{Equilibrium, Stability, Way, equilibrium};
#[doc(hidden)]
pub use follow::{Followed, follow};
pub use report::{Assembly, LevelResiduals, Move};
pub(crate) use travel::{Travel, TravelEnd};

use crate::error::{Error, Result};
use crate::formulation::{Dynamics, StepError};
use crate::math::Rate;
use crate::math::expression::Switch;
use crate::system::{MechanicalSystem, OperatingPoint, Scratch, check_start};
use metric::Metric;

/// Makes a guess consistent at time `t` by the least change in the mass metric that keeps the coordinates named by
/// `hold`. Flexible bodies in floating frames add their stiffness to the metric.
///
/// # Errors
/// Bad input: a name in `hold` that does not exist, joints that cannot all be closed, velocities that contradict the
/// joints or each other; a start at which the accelerations are not determined, or beyond the range of a signal.
pub fn assemble(system: &dyn MechanicalSystem, t: f64, guess: (&[f64], &[f64]), hold: &[String]) -> Result<Assembly> {
    assemble_held(system, [None; 2], t, guess, hold)
}

/// As [`assemble`]; the coordinates satisfy the constraints of the first of `held`, the velocities those of the second:
/// each is the system with further constraints, if there are any.
///
/// # Errors
/// As [`assemble`].
pub fn assemble_held(
    system: &dyn MechanicalSystem,
    held: [Option<&dyn MechanicalSystem>; 2],
    t: f64,
    guess: (&[f64], &[f64]),
    hold: &[String],
) -> Result<Assembly> {
    let [coordinates, velocities] = held;
    let (q, v) = guess;
    let assembly = consistent(system, coordinates, velocities, t, q, v, hold);
    assembly.map_err(|error| beyond_signal(system, t, q, v).unwrap_or(error))
}

/// The error for a state at which the argument of a signal is where it has no value.
fn beyond_signal(system: &dyn MechanicalSystem, t: f64, q: &[f64], v: &[f64]) -> Option<Error> {
    let switches = system.switches().all;
    let mut arguments = vec![Rate::fixed(0.0); switches.len()];
    let vdot = vec![0.0; v.len()];
    let mut scratch = Scratch::default();
    system.switching(OperatingPoint { t, q, v, vdot: &vdot, lambda: &[] }, &mut arguments, &mut scratch);
    let left = |(number, switch): (usize, &Switch)| {
        let signal = switch.signal.as_ref()?;
        let piece = signal.piece(arguments[number].re)?;
        signal.is_undefined_on(piece).then(|| signal.left_by(system.switches().owner(number)))
    };
    let message = switches.iter().enumerate().find_map(left)?;
    let error = Error::input(format!("at the start, {message}")).under("signals");
    Some(error.hint("start within it, or give the signal \"beyond\": \"hold\" or \"repeat\""))
}

fn consistent(
    system: &dyn MechanicalSystem,
    coordinates: Option<&dyn MechanicalSystem>,
    velocities: Option<&dyn MechanicalSystem>,
    t: f64,
    q: &[f64],
    v: &[f64],
    hold: &[String],
) -> Result<Assembly> {
    check_start(system, t, q, v)?;
    let directions = holds::directions(system, hold)?;
    let mut metric = Metric::new(system, directions.clone());
    let mut assembled = q.to_vec();
    let mut rates = v.to_vec();
    system.normalize(&mut assembled);
    let before = metric.level(t, &assembled, &rates);
    let is_beside = match coordinates {
        None => {
            position::close(&mut metric, t, &mut assembled)?;
            metric.is_beside
        }
        Some(coordinates) => {
            let all = &mut Metric::new(coordinates, directions.clone());
            reach::reach(&mut metric, all, t, &mut assembled)?;
            metric.is_beside || all.is_beside
        }
    };
    match velocities {
        None => velocity::fit(&mut metric, t, &assembled, &mut rates)?,
        Some(velocities) => velocity::fit(&mut Metric::new(velocities, directions), t, &assembled, &mut rates)?,
    }
    let after = metric.level(t, &assembled, &rates);
    let mut dynamics = Dynamics::new(system);
    dynamics.solve(t, &assembled, &rates, |_, _| 0.0).map_err(|halt| {
        let forces = system.feeds(t, &assembled, &rates, &mut Scratch::default());
        let infinite = forces.iter().find(|force| !force.is_finite);
        infinite.map_or_else(|| stuck(&halt), |force| stuck(&halt).element(&force.name))
    })?;
    let moves = report::moves(system, q, v, &assembled, &rates);
    let Dynamics { vdot, lambda, .. } = dynamics;
    Ok(Assembly { q: assembled, v: rates, vdot, lambda, before, after, moves, is_beside })
}

/// Error for a start that is consistent, but has no acceleration.
fn stuck(halt: &StepError) -> Error {
    let error = Error::input(format!("at the start, {halt}"));
    match halt {
        StepError::Term(term) => error
            .under(if term.starts_with("the force") { "forces" } else { "joints" })
            .hint("look for roots and quotients in expressions, for `floor` and `mod` beyond 2^29, and for springs of length zero"),
        StepError::Undetermined(_) => {
            error.under("bodies").hint("give the body mass and inertia, or hold it by joints")
        }
        _ => error.under("bodies").hint("masses, inertias or forces are too large or too small to compute with"),
    }
}
