//! From a state to one beside it, on the same branch.

use super::position::step;
use super::{Metric, holds};
use crate::error::{Error, Result};
use crate::math::largest;
use crate::math::newton::{Limits, Monitor};
use crate::system::MechanicalSystem;
use crate::tolerances::initial as tolerances;

/// Positions on the constraints.
#[derive(Clone, Debug, PartialEq)]
pub struct Followed {
    /// Coordinates, n_q.
    pub q: Vec<f64>,
    /// How near the constraints and what is held are to losing rank: 0 at a singular state.
    pub rank_indicator: f64,
    /// Constraints that depend on the others.
    pub dependent: Vec<usize>,
}

/// Newton's method, in parts of 1 m or rad and the largest coordinate, to round-off, also near a singular state. Where
/// its changes contract so from the second on, there is one solution around the guess, and it is the continuation of
/// the state from which the guess was taken; other solutions are attracted to less steeply (P. Deuflhard, Newton
/// Methods for Nonlinear Problems, 2011, section 5.1).
const LIMITS: Limits = Limits {
    most: tolerances::FOLLOWING_ITERATIONS,
    round_off: tolerances::FOLLOWED,
    contraction: tolerances::UNIQUE_CONTRACTION,
    ..Limits::NONE
};

/// Closes the joints from a guess near by; `None` where Newton's method does not contract from its first step on, so
/// that it may lead to another branch or nowhere. Rows named in `dependent` are left out and checked at the end.
///
/// # Errors
/// Constraints that are infinite at the guess or on the way, names in `hold` that do not exist.
pub fn follow(
    system: &dyn MechanicalSystem,
    t: f64,
    guess: &[f64],
    hold: &[String],
    dependent: &[usize],
) -> Result<Option<Followed>> {
    let mut metric = Metric::new(system, holds::directions(system, hold)?);
    metric.kkt.drop_rows(dependent);
    let (mut q, still) = (guess.to_vec(), vec![0.0; system.dimensions().v]);
    system.normalize(&mut q);
    let mut rate = vec![0.0; q.len()];
    let contracts = Monitor::default().solve(LIMITS, |_| {
        metric.at(t, &q, &still)?;
        let d = step(&mut metric, None)?;
        system.rate(&q, &d, &mut rate);
        q.iter_mut().zip(&rate).for_each(|(q, rate)| *q += rate);
        system.normalize(&mut q);
        Ok::<_, Error>(largest(&d) / largest(&q).max(1.0))
    })?;
    if contracts { end(metric, t, q, &still) } else { Ok(None) }
}

/// What is known of a state, if all its joints are closed.
fn end(mut metric: Metric, t: f64, q: Vec<f64>, still: &[f64]) -> Result<Option<Followed>> {
    metric.at(t, &q, still)?;
    if metric.worst(&metric.terms.phi) > tolerances::CLOSED {
        return Ok(None);
    }
    let rows = metric.kkt.left_out().iter().copied();
    let dependent: Vec<usize> = rows.filter(|row| *row < metric.terms.phi.len()).collect();
    // How near the others are.
    metric.kkt.drop_rows(&dependent);
    metric.at(t, &q, still)?;
    Ok(Some(Followed { q, rank_indicator: metric.kkt.rank_indicator(), dependent }))
}
