//! Piecewise smooth functions and the piece on which each is evaluated.
//!
//! A function that changes its form does so where an argument, the switching function, passes a threshold. A step of an
//! integrator keeps every function on the piece of the step's start, beyond its threshold too: the right side is then
//! smooth, and the methods keep their orders. The time loop finds the passage and ends the step there. Source: Hairer,
//! Norsett, Wanner, Solving Ordinary Differential Equations I, II.6 (discontinuous equations).

use super::scalar::Scalar;
use std::f64::consts::TAU;
use std::sync::Arc;

/// A piece of a function with thresholds c_0 < c_1 < ...: 2k between c_{k-1} and c_k, 2k + 1 at c_k itself.
pub type Piece = u32;

/// The piece of an argument among `count` thresholds; `None` for NaN.
pub fn piece_of(argument: f64, count: usize, threshold: impl Fn(usize) -> f64) -> Option<Piece> {
    if argument.is_nan() {
        return None;
    }
    let mut low = 0;
    let mut high = count;
    while low < high {
        let middle = (low + high) / 2;
        if threshold(middle) < argument { low = middle + 1 } else { high = middle }
    }
    let is_at = low < count && threshold(low) == argument;
    Some(2 * low as Piece + Piece::from(is_at))
}

/// The whole numbers that are thresholds are below this.
const MOST_WHOLE: f64 = (1 << 29) as f64;

/// The piece of an argument among the whole numbers, c_k = k - 2^29; `None` for NaN and beyond 2^29.
pub fn piece_of_whole(argument: f64) -> Option<Piece> {
    let below = argument.floor();
    let is_between = Piece::from(below != argument);
    (below.abs() < MOST_WHOLE).then(|| 2 * (below + MOST_WHOLE) as Piece + 1 + is_between)
}

/// The largest whole number that is not above the arguments of a piece.
pub fn whole_below(piece: Piece) -> f64 {
    f64::from(piece.saturating_sub(1) / 2) - MOST_WHOLE
}

/// Number of periods of thresholds that repeat below the given ones, and above.
fn periods_before(knots: &[f64]) -> usize {
    (MOST_WHOLE as usize / knots.len()).max(1)
}

/// The arguments at which a function changes its form, c_0 < c_1 < ...
#[derive(Clone, Debug, PartialEq)]
pub enum Thresholds {
    /// These.
    At(Arc<[f64]>),
    /// These n, again and again with a period: c_{k+n} = c_k + period, with c_0 as many periods below the first one that
    /// all pieces are about 2^30.
    Every {
        /// The thresholds of one period, which are not empty.
        knots: Arc<[f64]>,
        /// Distance of each from its next repetition.
        period: f64,
    },
    /// The whole numbers, see [`piece_of_whole`].
    Whole,
    /// None: the time loop sets the piece, and zero stands for the law itself.
    Held,
}

impl Thresholds {
    /// c_k; `None` beyond the last one.
    pub fn get(&self, k: usize) -> Option<f64> {
        match self {
            Thresholds::At(all) => all.get(k).copied(),
            Thresholds::Every { knots, period } => {
                let before = periods_before(knots);
                let cycle = k / knots.len();
                (cycle < 2 * before).then(|| knots[k % knots.len()] + (cycle as f64 - before as f64) * period)
            }
            Thresholds::Whole => Some(k as f64 - MOST_WHOLE).filter(|whole| *whole < MOST_WHOLE),
            Thresholds::Held => None,
        }
    }

    /// The piece of an argument; `None` where it has none, as for NaN.
    pub fn piece(&self, argument: f64) -> Option<Piece> {
        match self {
            Thresholds::At(all) => piece_of(argument, all.len(), |k| all[k]),
            Thresholds::Every { knots, period } => self.piece_of_period(argument, knots, *period),
            Thresholds::Whole => piece_of_whole(argument),
            Thresholds::Held => Some(0),
        }
    }

    /// The piece of an argument among thresholds that repeat.
    fn piece_of_period(&self, argument: f64, knots: &[f64], period: f64) -> Option<Piece> {
        let cycle = ((argument - knots[0]) / period).floor();
        let before = periods_before(knots);
        if cycle.is_nan() || cycle.abs() >= before as f64 - 1.0 {
            return None;
        }
        let local = knots.partition_point(|knot| *knot <= argument - cycle * period);
        let is_passed = |k: usize| self.get(k).is_some_and(|threshold| threshold <= argument);
        // Number of thresholds at or below the argument; rounding of the period may move it by one.
        let mut below = (cycle + before as f64) as usize * knots.len() + local;
        while below > 0 && !is_passed(below - 1) {
            below -= 1;
        }
        while is_passed(below) {
            below += 1;
        }
        let is_at = below > 0 && self.get(below - 1) == Some(argument);
        Some(2 * below as Piece - Piece::from(is_at))
    }

    /// Of thresholds that repeat: the index in its period of the threshold at or below the arguments of a piece, and how
    /// far that period is from the first one.
    pub fn at_or_below(&self, piece: Piece) -> (usize, f64) {
        let k = (piece.div_ceil(2) as usize).saturating_sub(1);
        match self {
            Thresholds::Every { knots, period } => {
                (k % knots.len(), ((k / knots.len()) as f64 - periods_before(knots) as f64) * period)
            }
            _ => (k, 0.0),
        }
    }

    /// The number k of the threshold nearest to an argument, and c_k.
    pub fn nearest(&self, argument: f64) -> Option<(usize, f64)> {
        let next = self.piece(argument)? as usize / 2;
        let around = [next.checked_sub(1), Some(next)].into_iter().flatten();
        let known = around.filter_map(|k| Some((k, self.get(k)?)));
        known.min_by(|(_, a), (_, b)| (a - argument).abs().total_cmp(&(b - argument).abs()))
    }
}

/// Discrete state of an evaluation: the piece of each function of a scene, by the number of its switching function, or
/// none, and each takes the piece of its argument; and the values of the counted angles in space, rad, by the number of
/// their [`Turning`](crate::body::Turning).
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Regime<'a> {
    pieces: Option<&'a [Piece]>,
    turned: &'a [f64],
}

impl<'a> Regime<'a> {
    /// Every function on the piece of its argument.
    pub const FREE: Regime<'static> = Regime { pieces: None, turned: &[] };

    /// Every function on the given piece, whatever its argument.
    pub fn held(pieces: &'a [Piece]) -> Self {
        Regime { pieces: Some(pieces), turned: &[] }
    }

    /// The regime with these values of the counted angles, rad.
    #[inline]
    pub fn turned(self, turned: &'a [f64]) -> Self {
        Regime { turned, ..self }
    }

    /// True if every function takes the piece of its argument.
    #[inline]
    pub fn is_free(self) -> bool {
        self.pieces.is_none()
    }

    /// `angle`, known up to full turns, shifted to the value nearest to counted angle `number` or, if that is
    /// not known, to `start`.
    #[inline]
    pub fn angle<S: Scalar>(self, number: usize, angle: S, start: f64) -> S {
        let near = self.turned.get(number).copied().unwrap_or(start);
        angle + ((near - angle.value()) / TAU).round() * TAU
    }

    /// The piece prescribed for switching function `number`, if there is one.
    #[inline]
    pub fn piece(self, number: usize) -> Option<Piece> {
        self.pieces.and_then(|pieces| pieces.get(number).copied())
    }
}

/// The time of an evaluation, over any scalar, with the pieces of the functions: laws without `if`, `abs`, tables and
/// the like read `t` alone.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Time<'a, S> {
    /// Time, s.
    pub t: S,
    /// Piece of each switching function within the step.
    #[doc(hidden)]
    pub regime: Regime<'a>,
}

impl<'a, S: Scalar> Time<'a, S> {
    /// The same instant over another scalar.
    #[inline]
    pub fn map<T>(self, change: impl FnOnce(S) -> T) -> Time<'a, T> {
        Time { t: change(self.t), regime: self.regime }
    }
}

#[cfg(test)]
mod tests {
    use super::{Thresholds, piece_of, piece_of_whole, whole_below};

    #[test]
    fn pieces_are_counted_through_thresholds() {
        let piece = |x| piece_of(x, 2, |k| [0.0, 1.0][k]);
        let found = [-1.0, 0.0, -0.0, 0.5, 1.0, 2.0].map(piece);
        assert_eq!(found, [0, 1, 1, 2, 3, 4].map(Some));
        assert_eq!(piece(f64::NAN), None);
        for x in [-2.5, -2.0, -0.0, 0.0, 0.7, 3.0, 1e8 + 0.5] {
            assert_eq!(piece_of_whole(x).map(whole_below), Some(x.floor()));
        }
        assert_eq!([f64::NAN, 1e9, f64::INFINITY].map(piece_of_whole), [None; 3]);
        let nearest = |x| Thresholds::Whole.nearest(x).map(|(_, threshold)| threshold);
        assert_eq!([1.4, 1.6, -2.0].map(nearest), [1.0, 2.0, -2.0].map(Some));
    }
}
