//! Signals: measured data as functions of one argument.
//!
//! A signal passes through its points, on a cubic between two of them. Steps, kinks and ends are thresholds of its
//! argument, see [`Thresholds`]: each point of a linear signal and of one that keeps the previous value, both ends of a
//! cubic one. The inner points of a cubic one are none: there the third derivative alone jumps, which is nothing to
//! steps over many points and is left to the estimate of their error. Steps of about the distance of two points end on
//! [them](Signal::point_ahead), without a change of form: else methods of high order would be refused about each point.
//!
//! A lookup takes O(1) where points are about equally apart, O(log n) elsewhere, and allocates nothing.

mod cubic;
mod points;
mod spline;

#[cfg(test)]
mod tests;

pub use points::{Beyond, Interpolation, PointsError};

use super::regime::{Piece, Thresholds};
use super::scalar::Scalar;
use crate::math::array::Each;
use crate::tolerances;
use cubic::{BoundsTree, Cubic, bounds, derived, hull, value};
use std::sync::Arc;

/// Fewer points are a ramp or a pulse that somebody wrote, and meant to be held.
const MEASURED_POINTS: usize = 5;

/// A function of one argument through given points.
#[derive(Clone, Debug, PartialEq)]
pub struct Signal {
    name: String,
    beyond: Beyond,
    is_cubic: bool,
    /// x of the points.
    knots: Arc<[f64]>,
    /// Cubics in the distance from the point to the left.
    cubics: Vec<Cubic>,
    last: f64,
    thresholds: Thresholds,
    /// Bounds on a cubic signal.
    tree: Option<BoundsTree>,
}

impl Signal {
    /// The signal through points (x, y).
    ///
    /// # Errors
    /// See [`PointsError`].
    pub fn new(
        name: &str,
        points: &[[f64; 2]],
        interpolation: Interpolation,
        beyond: Beyond,
    ) -> Result<Self, PointsError> {
        points::check(points)?;
        let is_cubic = interpolation == Interpolation::Cubic;
        let repeats = beyond == Beyond::Repeat;
        if is_cubic && repeats {
            points::check_ends(points)?;
        }
        let cubics = points::cubics(points, interpolation, repeats);
        if !cubics.iter().flatten().all(|coefficient| coefficient.is_finite()) {
            return Err(PointsError::NotFinite);
        }
        let knots: Arc<[f64]> = points.iter().map(|point| point[0]).collect();
        let widths = knots.windows(2).map(|pair| pair[1] - pair[0]);
        let tree = is_cubic.then(|| BoundsTree::new(cubics.iter().copied().zip(widths.collect::<Vec<_>>())));
        let thresholds = points::thresholds(&knots, is_cubic, repeats);
        let last = points[points.len() - 1][1];
        Ok(Signal { name: name.to_string(), beyond, is_cubic, knots, cubics, last, thresholds, tree })
    }

    pub fn name(&self) -> &str {
        &self.name
    }

    /// First and last x of its points.
    pub fn range(&self) -> [f64; 2] {
        [self.knots[0], self.knots[self.knots.len() - 1]]
    }

    /// The arguments at which its form changes.
    pub fn thresholds(&self) -> &Thresholds {
        &self.thresholds
    }

    /// x of its points.
    pub fn knots(&self) -> &[f64] {
        &self.knots
    }

    /// True if points of it are no thresholds, and steps have to be short enough to see what is between them.
    pub fn is_watched(&self) -> bool {
        self.is_cubic && self.knots.len() > 2
    }

    /// The piece of an argument; `None` for NaN, and beyond 2^29 points that repeat.
    #[inline]
    pub fn piece(&self, x: f64) -> Option<Piece> {
        self.thresholds.piece(x)
    }

    /// True if the signal has no value on a piece of its thresholds.
    pub fn is_undefined_on(&self, piece: Piece) -> bool {
        let is_outside = piece == 0 || piece.is_multiple_of(2) && self.thresholds.get(piece as usize / 2).is_none();
        self.beyond == Beyond::Error && is_outside
    }

    /// The value; x itself where it is NaN.
    #[inline]
    pub fn apply<S: Scalar>(&self, x: S) -> S {
        self.piece(x.value()).map_or(x, |piece| self.on(piece, x))
    }

    /// The value on a piece, whatever the argument. At a threshold the slope is that to its right.
    #[inline]
    pub fn on<S: Scalar>(&self, piece: Piece, x: S) -> S {
        // Number of thresholds at or below.
        let below = piece.div_ceil(2) as usize;
        match &self.thresholds {
            Thresholds::At(all) if !all.is_empty() && (below == 0 || below == all.len()) => self.outside(below == 0, x),
            _ if self.is_cubic => self.smooth(x),
            Thresholds::At(_) => self.cubic(below - 1, 0.0, x),
            repeating => {
                let (row, shift) = repeating.at_or_below(piece);
                self.cubic(row, shift, x)
            }
        }
    }

    /// The value beyond the first or the last point.
    fn outside<S: Scalar>(&self, is_before: bool, x: S) -> S {
        let [first, last] = self.range();
        let (end, row, y) =
            if is_before { (first, 0, self.cubics[0][0]) } else { (last, self.cubics.len() - 1, self.last) };
        // Without slope, but for rounding at the end of what is not to be left.
        let is_near = (x.value() - end).abs() <= 8.0 * f64::EPSILON * end.abs().max(last - first);
        match self.beyond {
            Beyond::Error if is_near => self.cubic(row, 0.0, x),
            Beyond::Error => S::constant(f64::NAN),
            _ => S::constant(y),
        }
    }

    /// The cubic to the right of a point, moved by `shift` along x.
    #[inline]
    fn cubic<S: Scalar>(&self, row: usize, shift: f64, x: S) -> S {
        let start = self.knots[row] + shift;
        let cubic = &self.cubics[row];
        x.compose(0, &|order, [low, high]| {
            if low == high {
                [value(&derived(cubic, order), low - start); 2]
            } else {
                bounds(&derived(cubic, order), low - start, high - start)
            }
        })
    }

    /// The spline, or the cubic at one of its ends beyond it.
    #[inline]
    fn smooth<S: Scalar>(&self, x: S) -> S {
        let [low, high] = x.bounds();
        if low == high {
            let (row, shift) = self.place(low);
            self.cubic(row, shift, x)
        } else {
            x.compose(0, &|order, [low, high]| self.derivative_bounds(order, low, high))
        }
    }

    /// The next point for an argument that grows, or falls, and the width of the interval before it; `None` beyond the
    /// points. One that is nearer than `near` of the width counts as passed.
    pub fn point_ahead(&self, x: f64, grows: bool, near: f64) -> Option<(f64, f64)> {
        let (row, shift) = self.place(x);
        let interval = |row: usize| Some([*self.knots.get(row)?, *self.knots.get(row + 1)?].each(|knot| knot + shift));
        let ahead = |row: usize| {
            let [low, high] = interval(row)?;
            let point = if grows { high } else { low };
            Some((point, high - low)).filter(|_| (point - x).abs() > near * (high - low))
        };
        let after = if grows { Some(row + 1) } else { row.checked_sub(1) };
        ahead(row).or_else(|| ahead(after?)).filter(|_| self.is_watched())
    }

    /// The value that it keeps beyond the first (`beyond_last` false) or the last point, where its points look like
    /// measured data that go on: five or more, not in steps, and not level at that end. `None` elsewhere.
    pub fn cut_off(&self, beyond_last: bool) -> Option<f64> {
        let heights = || self.cubics.iter().map(|cubic| cubic[0]).chain([self.last]);
        let is_stepped = self.cubics.iter().all(|cubic| cubic[1..] == [0.0; 3]);
        if self.beyond != Beyond::Hold || self.knots.len() < MEASURED_POINTS || is_stepped {
            return None;
        }
        let (low, high) =
            heights().fold((f64::INFINITY, f64::NEG_INFINITY), |(low, high), y| (low.min(y), high.max(y)));
        let count = self.cubics.len();
        let [end, neighbour] = if beyond_last { [count, count - 1] } else { [0, 1] };
        let height = |row: usize| self.cubics.get(row).map_or(self.last, |cubic| cubic[0]);
        let is_level = (height(end) - height(neighbour)).abs() <= tolerances::UNSEEN * (high - low);
        (!is_level).then(|| height(end))
    }

    /// The message of an element whose argument has left the points.
    pub fn left_by(&self, owner: &str) -> String {
        let ([from, to], name) = (self.range(), &self.name);
        format!("{owner} leaves the range of the signal `{name}`, which goes from {from} to {to}")
    }

    /// Index of the interval of an argument, and how far its period is from the first one.
    #[inline]
    fn place(&self, x: f64) -> (usize, f64) {
        let shift = self.shift(x);
        (self.interval(x - shift), shift)
    }

    /// Whole periods from the points to an argument.
    #[inline]
    fn shift(&self, x: f64) -> f64 {
        let [first, last] = self.range();
        let repeats = self.beyond == Beyond::Repeat;
        if repeats { ((x - first) / (last - first)).floor() * (last - first) } else { 0.0 }
    }

    /// Index of the interval of the points that contains x, or is nearest to it.
    #[inline]
    fn interval(&self, x: f64) -> usize {
        let ([first, last], count) = (self.range(), self.cubics.len());
        // Where points are about equally apart.
        let likely = (((x - first) / (last - first) * count as f64) as usize).min(count - 1);
        if self.knots[likely] <= x && x < self.knots[likely + 1] {
            return likely;
        }
        self.knots.partition_point(|knot| *knot <= x).clamp(1, count) - 1
    }

    /// Bounds on the derivative of order `order` of a cubic signal between two arguments.
    fn derivative_bounds(&self, order: usize, low: f64, high: f64) -> [f64; 2] {
        let ([first, last], shift) = (self.range(), self.shift(low));
        let low = low - shift;
        let high = high - shift;
        if self.beyond != Beyond::Repeat || high <= last {
            return self.bounds_within(order, low, high);
        }
        let period = last - first;
        if high - low >= period {
            return self.bounds_within(order, first, last);
        }
        hull(self.bounds_within(order, low, last), self.bounds_within(order, first, high - period))
    }

    fn bounds_within(&self, order: usize, low: f64, high: f64) -> [f64; 2] {
        let from = self.interval(low);
        let to = self.interval(high);
        let part = |row: usize, low: f64, high: f64| {
            let start = self.knots[row];
            bounds(&derived(&self.cubics[row], order), low - start, high - start)
        };
        if from == to {
            return part(from, low, high);
        }
        let ends = hull(part(from, low, self.knots[from + 1]), part(to, self.knots[to], high));
        self.tree.as_ref().map_or(ends, |tree| hull(ends, tree.over(order, from + 1, to)))
    }
}
