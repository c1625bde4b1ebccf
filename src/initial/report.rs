//! The result of an assembly, for the user.

use crate::system::MechanicalSystem;
use serde::Serialize;

/// A consistent start.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Assembly {
    /// Coordinates, n_q.
    #[serde(skip)]
    pub q: Vec<f64>,
    /// Velocities, n_v.
    #[serde(skip)]
    pub v: Vec<f64>,
    /// Accelerations, n_v.
    #[serde(skip)]
    pub vdot: Vec<f64>,
    /// Multipliers, n_c.
    #[serde(skip)]
    pub lambda: Vec<f64>,
    /// Residuals of the guess.
    #[doc(hidden)]
    pub before: LevelResiduals,
    /// Residuals of the start.
    #[doc(hidden)]
    pub after: LevelResiduals,
    /// Coordinates and velocities that changed, largest first.
    #[doc(hidden)]
    pub moves: Vec<Move>,
    /// True if Newton's method comes from the guess to a singular state with open joints, and they closed from beside
    /// the guess: on one of several branches.
    #[serde(skip)]
    pub is_beside: bool,
}

/// Largest residuals, in units of the scene's scale.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub struct LevelResiduals {
    /// max |phi|
    pub phi: f64,
    /// max |phi'|, per second.
    pub phi_dot: f64,
}

/// A coordinate or velocity that assembly changed.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Move {
    /// Name of the coordinate or velocity.
    pub name: String,
    /// Value in the guess.
    pub from: f64,
    /// Value in the consistent start.
    pub to: f64,
}

/// Changes beyond round-off, without the angles that count full turns.
pub(super) fn moves(system: &dyn MechanicalSystem, q0: &[f64], v0: &[f64], q: &[f64], v: &[f64]) -> Vec<Move> {
    let own = system.dimensions().q_without_turns();
    let moved = |(from, to): &(&f64, &f64)| (*to - *from).abs() > 1e-9 * (1.0 + from.abs());
    let pairs = || q0.iter().zip(q).take(own).chain(v0.iter().zip(v));
    if !pairs().any(|pair| moved(&pair)) {
        return Vec::new();
    }
    let names = system.facts().names.clone();
    let names = names.q.into_iter().take(own).chain(names.v);
    let pairs = names.zip(pairs()).filter(|(_, pair)| moved(pair));
    let mut moves: Vec<Move> = pairs.map(|(name, (&from, &to))| Move { name, from, to }).collect();
    moves.sort_by(|a, b| (b.to - b.from).abs().total_cmp(&(a.to - a.from).abs()));
    moves
}
