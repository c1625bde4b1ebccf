//! What a signal is made of: its points, and how it goes on between and beyond them.

use super::cubic::{Cubic, hermite};
use super::spline;
use crate::math::regime::Thresholds;
use schemars::JsonSchema;
use serde::Deserialize;
use std::sync::Arc;

/// How a signal goes on between its points.
#[derive(Deserialize, JsonSchema, Clone, Copy, Debug, Default, PartialEq, Eq)]
#[serde(rename_all = "snake_case")]
pub enum Interpolation {
    /// A spline with continuous first and second derivatives. Its third derivative is continuous at the second and the
    /// last but one point ("not-a-knot"), or the spline is periodic where the signal repeats.
    #[default]
    Cubic,
    /// Straight lines.
    Linear,
    /// The value of the point before, without slope.
    Previous,
}

/// How a signal goes on beyond its points.
#[derive(Deserialize, JsonSchema, Clone, Copy, Debug, Default, PartialEq, Eq)]
#[serde(rename_all = "snake_case")]
pub enum Beyond {
    /// With the value of the first or the last point, without slope.
    #[default]
    Hold,
    /// With the first point in the place of the last one, again and again. A cubic signal then has to end as it begins.
    Repeat,
    /// It has no value there, and a run whose motion comes there fails.
    Error,
}

/// A fault of the points of a signal.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum PointsError {
    /// Fewer than two.
    TooFew,
    /// The x of the point with this index is not above that of the one before.
    NotIncreasing(usize),
    /// A number, or the slope to the next point, is not finite.
    NotFinite,
    /// A cubic signal that repeats begins and ends with different values.
    EndsDiffer,
}

/// Refuses points that are too few, not finite or not in order.
pub fn check(points: &[[f64; 2]]) -> Result<(), PointsError> {
    if points.len() < 2 {
        return Err(PointsError::TooFew);
    }
    if !points.iter().flatten().all(|number| number.is_finite()) {
        return Err(PointsError::NotFinite);
    }
    match points.windows(2).position(|pair| pair[0][0] >= pair[1][0]) {
        Some(i) => Err(PointsError::NotIncreasing(i + 1)),
        None => Ok(()),
    }
}

/// Refuses first and last values that differ.
pub fn check_ends(points: &[[f64; 2]]) -> Result<(), PointsError> {
    let size = points.iter().fold(0.0, |size: f64, point| size.max(point[1].abs()));
    if (points[0][1] - points[points.len() - 1][1]).abs() > 8.0 * f64::EPSILON * size {
        Err(PointsError::EndsDiffer)
    } else {
        Ok(())
    }
}

/// The cubics between the points.
pub fn cubics(points: &[[f64; 2]], interpolation: Interpolation, repeats: bool) -> Vec<Cubic> {
    let slopes = match interpolation {
        Interpolation::Cubic if repeats => spline::periodic(points),
        Interpolation::Cubic => spline::not_a_knot(points),
        _ => Vec::new(),
    };
    let row = |(i, pair): (usize, &[[f64; 2]])| {
        let ([x0, y0], [x1, y1]) = (pair[0], pair[1]);
        match interpolation {
            Interpolation::Cubic => hermite(x1 - x0, y0, y1, slopes[i], slopes[i + 1]),
            Interpolation::Linear => [y0, (y1 - y0) / (x1 - x0), 0.0, 0.0],
            Interpolation::Previous => [y0, 0.0, 0.0, 0.0],
        }
    };
    points.windows(2).enumerate().map(row).collect()
}

/// The arguments at which the form changes.
pub fn thresholds(knots: &Arc<[f64]>, is_cubic: bool, repeats: bool) -> Thresholds {
    let first = knots[0];
    let last = knots[knots.len() - 1];
    match (is_cubic, repeats) {
        (true, true) => Thresholds::At([].into()),
        (true, false) => Thresholds::At([first, last].into()),
        (false, true) => Thresholds::Every { knots: knots[..knots.len() - 1].into(), period: last - first },
        (false, false) => Thresholds::At(knots.clone()),
    }
}
