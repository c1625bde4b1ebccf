//! Static equilibrium: positions at which the forces balance.
//!
//! ```text
//! f(t, q, 0) - G^T lambda = 0,   phi(q, t) = 0,   t fixed
//! ```
//!
//! States xi take part: their rates r(t, q, 0, xi), which are in f, are zero too.

mod descent;
mod failure;
mod homotopy;
mod judge;
mod newton;
mod stability;
mod system;

pub use stability::Stability;

use super::{Metric, position};
use crate::error::Result;
use crate::math::largest;
use crate::system::{Limited, MechanicalSystem, check_start};
use crate::tolerances;
use descent::DescentEnd;
use judge::Judge;
use newton::{Policy, newton};
use serde::Serialize;
use system::{EquilibriumPoint, EquilibriumSystem};

/// A static equilibrium.
#[derive(Clone, Debug, PartialEq)]
pub struct Equilibrium {
    /// Time at which expressions of t are evaluated, s.
    pub t: f64,
    /// Coordinates, n_q.
    pub q: Vec<f64>,
    /// Velocities, n_v: zero but for the states xi.
    pub v: Vec<f64>,
    /// Multipliers, n_c; of least norm where constraints are redundant.
    pub lambda: Vec<f64>,
    /// The method that found it.
    pub way: Way,
    /// Number of linear systems solved, over all methods tried.
    pub iterations: usize,
    /// Number of steps of the load or of the descent, over all methods tried.
    pub steps: usize,
    /// max |f - G^T lambda|, N or N m.
    pub residual: f64,
    /// max |phi|, in units of the scene's scale.
    pub gap: f64,
    /// Stability of the equilibrium.
    pub stability: Stability,
    /// Coordinates that can move without any restoring force.
    pub free: Vec<String>,
}

/// The method by which an equilibrium was found.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize)]
#[serde(rename_all = "snake_case")]
pub enum Way {
    /// Newton's method from the start.
    Newton,
    /// Newton's method with shortened steps.
    DampedNewton,
    /// Continuation in the load.
    Homotopy,
    /// Descent along the forces, which leads to stable equilibria.
    Descent,
}

/// An equilibrium found by one of the methods.
struct FoundEquilibrium {
    place: EquilibriumPoint,
    way: Way,
    stability: Stability,
    free: Vec<String>,
}

/// The equilibrium at time `t` nearest to a guess (q, v), of which only the states count in v:
///
/// 1. that of Newton's method, if its steps contract from the first: then it is the one around the guess, stable or
///    not;
/// 2. else the first that is not unstable of: Newton's method, plain and damped; load stepping; a descent along the
///    forces, which leads to stable ones;
/// 3. else an unstable one that one of these methods found.
///
/// # Errors
/// Joints that cannot be closed at `t`, a state that cannot be evaluated, equations without K: bad input. No
/// equilibrium found: a failure that names what moves or the largest residual force.
pub fn equilibrium(system: &dyn MechanicalSystem, t: f64, guess: (&[f64], &[f64])) -> Result<Equilibrium> {
    check_start(system, t, guess.0, guess.1)?;
    let mut q = guess.0.to_vec();
    system.normalize(&mut q);
    position::close(&mut Metric::new(system, Vec::new()), t, &mut q)?;
    q.extend(&guess.1[system.dimensions().moving()..]);
    let mut rest = EquilibriumSystem::new(system, t, &q)?;
    let start = rest.balance(&q).ok_or_else(failure::not_finite)?.place;
    let mut search =
        EquilibriumSearch { best: None, steps: 0, away: None, bent: None, judge: Judge::at(&mut rest, &start) };
    if !search.contracts(&mut rest, &start) && !search.grows(&mut rest, &start) {
        search.descends(&mut rest, &start);
    }
    match search.best {
        Some(found) => finish(rest, found, search.steps),
        None => Err(match search.bent {
            Some((beam, turn)) => failure::too_bent(t, &beam, turn),
            None => failure::none_found(&mut rest, &start, search.away),
        }),
    }
}

struct EquilibriumSearch {
    best: Option<FoundEquilibrium>,
    steps: usize,
    /// The coordinate that moves without bound in a descent.
    away: Option<usize>,
    /// The beam with an element that rotates beyond its theory, and the rotation, rad.
    bent: Option<(Limited, f64)>,
    judge: Judge,
}

impl EquilibriumSearch {
    /// Newton's method from the start; true if its result is final.
    fn contracts(&mut self, rest: &mut EquilibriumSystem, start: &EquilibriumPoint) -> bool {
        match newton(rest, start.clone(), None, Policy::FULL) {
            Some((place, contracts)) => self.offer(rest, Some(place), Way::Newton) || contracts,
            None => false,
        }
    }

    /// Damped steps, then load stepping; true if one of their results is good enough.
    fn grows(&mut self, rest: &mut EquilibriumSystem, start: &EquilibriumPoint) -> bool {
        let damped = newton(rest, start.clone(), None, Policy::DAMPED).map(|(place, _)| place);
        if self.offer(rest, damped, Way::DampedNewton) {
            return true;
        }
        let (reached, part, steps) = homotopy::homotopy(rest, start);
        self.steps += steps;
        if part < 1.0 {
            // Extrapolates the rotation to the whole load.
            let bent = Judge::bent(rest, &reached.q).map(|(beam, turn)| (beam, turn / part));
            self.bent = self.bent.take().or(bent);
            return false;
        }
        self.offer(rest, Some(reached), Way::Homotopy)
    }

    fn descends(&mut self, rest: &mut EquilibriumSystem, start: &EquilibriumPoint) {
        let (end, steps) = descent::descend(rest, &start.q);
        self.steps += steps;
        match end {
            DescentEnd::Equilibrium(place) | DescentEnd::Stuck(place) => {
                _ = self.offer(rest, Some(place), Way::Descent)
            }
            DescentEnd::Away(coordinate) => self.away = Some(coordinate),
        }
    }

    /// Records a place if it is better than the present one; true if it is good enough to stop.
    fn offer(&mut self, rest: &mut EquilibriumSystem, place: Option<EquilibriumPoint>, way: Way) -> bool {
        let Some(place) = place else { return false };
        if let Some(bent) = Judge::bent(rest, &place.q) {
            self.bent = Some(bent);
            return false;
        }
        if !self.judge.accepts(rest, &place) {
            return false;
        }
        let (stability, free) = stability::judge(rest, &place);
        if self.best.as_ref().is_none_or(|best| stability > best.stability) {
            self.best = Some(FoundEquilibrium { place, way, stability, free });
        }
        stability >= Stability::Neutral
    }
}

/// The equilibrium with multipliers of least norm, and the residuals of its equations.
fn finish(mut rest: EquilibriumSystem, found: FoundEquilibrium, steps: usize) -> Result<Equilibrium> {
    let FoundEquilibrium { mut place, way, stability, free } = found;
    rest.release();
    if let Some(balance) = rest.balance(&place.q) {
        place.lambda = balance.place.lambda;
    }
    let residual = largest(&rest.force(&place.lambda));
    let gap = rest.gap();
    if gap > tolerances::ROOT_OF_ROUND_OFF {
        return Err(failure::contradiction(rest.t));
    }
    let t = rest.t;
    let iterations = rest.iterations;
    let q = place.q[..rest.coordinates].to_vec();
    let v = rest.still;
    Ok(Equilibrium { t, q, v, lambda: place.lambda, way, iterations, steps, residual, gap, stability, free })
}
