//! The range of an argument on one piece of a function, and the point at which it is left.

use crate::math::{Piece, Rate, Thresholds};

/// An open interval between two neighbouring thresholds.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct OpenInterval {
    pub low: f64,
    pub high: f64,
}

impl OpenInterval {
    /// Range of a piece; `None` for the piece that is a threshold itself.
    pub fn of(piece: Piece, thresholds: &Thresholds) -> Option<Self> {
        let next = (piece / 2) as usize;
        let low = next.checked_sub(1).and_then(|k| thresholds.get(k));
        let high = thresholds.get(next);
        let range = OpenInterval { low: low.unwrap_or(f64::NEG_INFINITY), high: high.unwrap_or(f64::INFINITY) };
        piece.is_multiple_of(2).then_some(range)
    }

    /// The range with a margin on both sides.
    pub fn widened(&self, margin: f64) -> Self {
        OpenInterval { low: self.low - margin, high: self.high + margin }
    }

    pub fn contains(&self, x: f64) -> bool {
        self.low < x && x < self.high
    }

    /// Distance of an argument from the range; negative inside.
    pub fn beyond(&self, x: f64) -> f64 {
        (self.low - x).max(x - self.high)
    }

    /// Rate at which an argument moves towards its nearest threshold, and beyond.
    pub fn outward(&self, x: Rate) -> f64 {
        if self.nearest(x.re) == self.low { -x.eps[0] } else { x.eps[0] }
    }

    /// The threshold nearest to an argument.
    pub fn nearest(&self, x: f64) -> f64 {
        if self.low - x > x - self.high { self.low } else { self.high }
    }
}

/// The first number, up to round-off, at which `beyond` is not negative, if it has one zero between `from`, where it is
/// not positive, and `to`, where it is not negative. Regula falsi with bisection in every third iteration.
pub fn first_out(mut beyond: impl FnMut(f64) -> f64, mut from: f64, mut to: f64) -> f64 {
    let mut inside = beyond(from).min(0.0);
    let mut outside = beyond(to);
    for round in 1.. {
        let slanted = to - outside * (to - from) / (outside - inside);
        let middle = if round % 3 == 0 || !(from < slanted && slanted < to) { 0.5 * (from + to) } else { slanted };
        if middle <= from || middle >= to {
            break;
        }
        let there = beyond(middle);
        if there < 0.0 { (from, inside) = (middle, there) } else { (to, outside) = (middle, there) }
    }
    to
}

#[cfg(test)]
mod tests {
    use super::{OpenInterval, Thresholds, first_out};

    #[test]
    fn a_piece_lies_between_its_thresholds() {
        let infinite = f64::INFINITY;
        let two = Thresholds::At([1.0, 2.0].into());
        assert_eq!(OpenInterval::of(0, &two), Some(OpenInterval { low: -infinite, high: 1.0 }));
        assert_eq!(OpenInterval::of(2, &two), Some(OpenInterval { low: 1.0, high: 2.0 }));
        assert_eq!(OpenInterval::of(4, &two), Some(OpenInterval { low: 2.0, high: infinite }));
        assert_eq!(OpenInterval::of(3, &two), None);
    }

    #[test]
    fn a_passage_is_found_to_the_last_digit() {
        assert_eq!(first_out(|t| t - 5.0, 0.0, 10.0), 5.0);
        assert_eq!(first_out(|t| t.powi(9) - 1e-9, 0.0, 10.0), 0.1);
        let root = first_out(|t| t.exp() - 2.0, 0.0, 10.0);
        assert!((root - 2f64.ln()).abs() <= f64::EPSILON, "{root}");
    }
}
